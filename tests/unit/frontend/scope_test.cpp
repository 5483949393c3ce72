#include "frontend/eval/scope.hpp"

#include <gtest/gtest.h>

#include <string>
#include <vector>

namespace scenec::frontend {
namespace {

constexpr FileId file(0);

Binding binding(std::string_view name, std::uint32_t offset, std::int64_t value) {
  Binding result;
  result.name = name;
  result.span = {file, offset, offset + 1};
  result.value = make_int(value);
  return result;
}
Span use_at(std::uint32_t offset) {
  return {file, offset, offset + 1};
}

TEST(Scope, inner_names_hide_outer_ones) {
  Scope outer;
  outer.add(binding("a", 10, 1));
  Scope inner(&outer);
  inner.add(binding("a", 20, 2));
  EXPECT_EQ(inner.find("a", use_at(30)).binding->value.integer, 2);
  EXPECT_EQ(outer.find("a", use_at(30)).binding->value.integer, 1);
  EXPECT_EQ(inner.find("b", use_at(30)).binding, nullptr);
}

TEST(Scope, names_are_visible_behind_their_declaration_only) {
  Scope outer;
  outer.add(binding("a", 10, 1));
  Scope inner(&outer);
  inner.add(binding("a", 20, 2));
  EXPECT_EQ(inner.find("a", use_at(15)).binding->value.integer, 1);
  EXPECT_EQ(inner.find("a", use_at(5)).binding, nullptr);
  EXPECT_EQ(inner.find("a", {FileId(1), 0, 1}).binding->value.integer, 2);  // from another file
}

TEST(Scope, many_names_are_found_as_few_are) {
  std::vector<std::string> names;
  for (int i = 0; i < 1000; ++i) names.push_back("name" + std::to_string(i));
  Scope scope;
  for (std::uint32_t i = 0; i < 1000; ++i) {
    ASSERT_EQ(scope.find_here(names[i]), nullptr);
    scope.add(binding(names[i], i, i));
    ASSERT_EQ(scope.find_here(names[i / 2])->value.integer, i / 2);
  }
}

}  // namespace
}  // namespace scenec::frontend
