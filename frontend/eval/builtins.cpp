#include "frontend/eval/builtins.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <unordered_map>

#include "base/elementary.hpp"
#include "base/text.hpp"
#include "frontend/eval/operators.hpp"

namespace scenec::frontend {

namespace {

std::array<std::span<const Builtin>, 6> all_functions() {
  return {number_functions(), list_functions(),    vector_functions(),
          color_functions(),  texture_functions(), geometry_functions()};
}

constexpr std::array<std::string_view, 4> constants{"pi", "tau", "black", "white"};

}  // namespace

const Builtin* find_builtin(std::string_view name) {
  static const auto by_name = [] {
    std::unordered_map<std::string_view, const Builtin*> index;
    for (const auto functions : all_functions()) {
      for (const Builtin& function : functions) index.emplace(function.name, &function);
    }
    return index;
  }();
  const auto found = by_name.find(name);
  return found == by_name.end() ? nullptr : found->second;
}

std::vector<std::string_view> builtin_names() {
  std::vector<std::string_view> names{"select"};
  for (const auto functions : all_functions()) {
    for (const Builtin& function : functions) names.push_back(function.name);
  }
  std::sort(names.begin(), names.end());
  return names;
}

std::span<const std::string_view> constant_names() {
  return constants;
}

std::optional<Value> find_constant(std::string_view name) {
  if (name == "pi") return make_number(pi);
  if (name == "tau") return make_number(2 * pi);
  if (name == "black") return make_color(0, 0, 0);
  if (name == "white") return make_color(1, 1, 1);
  return std::nullopt;
}

Need Call::need(std::size_t i) const {
  const std::size_t row = std::min(i, parameters.size() - 1);
  return {.subject = parameters[row].name, .function = function, .node = has(i) ? nodes[i] : node};
}

Value Call::outside(std::size_t i, std::string_view needs) const {
  return session.error(
      DiagnosticKind::outside_domain, span(i),
      fmt::format("{} is {}; needs {}", need(i).text(),
                  quantity_text(arguments[i].real(), arguments[i].dimension), needs));
}

namespace {

Value accepted_input(Session& session, const Value& value, bool number_only, const Need& need) {
  const bool plain = value.is_number() && value.dimension.none();
  if (plain || value.is(Type::texture) || (value.is(Type::color) && !number_only)) {
    if (!number_only || plain || value.grey) return value;
    return session.error(
        Diagnostic(DiagnosticKind::type_mismatch, need.span(),
                   fmt::format("{} needs a number; found a texture of colors", need.text()))
            .hint("`.r`, `.g`, `.b` and `.alpha` pick a channel"));
  }
  return type_error(session, need,
                    number_only ? "a number or a texture of numbers" : "a color or a texture",
                    value);
}

Value accepted_vector(Session& session, const Value& value, Accept accept, const Need& need) {
  const bool of_one_size = accept == Accept::vec2 || accept == Accept::offset;
  if (!of_one_size && may_be_vector(value)) return {};
  switch (accept) {
    case Accept::vec2:
      return coerce_vector(session, value, 2, dimension::none, need);
    case Accept::offset:
      return coerce_vector(session, value, 3, dimension::length, need);
    case Accept::vec3:
      return value.is(Type::vec3) ? value : type_error(session, need, "a list of 3 numbers", value);
    default:
      return value.is_vector() ? value
                               : type_error(session, need, "a list of 2 or 3 numbers", value);
  }
}

}  // namespace

Value accepted(Session& session, const Value& value, Accept accept, const Need& need) {
  if (value.poisoned()) return {};
  switch (accept) {
    case Accept::any:
      return value;
    case Accept::plain:
      return value.is(Type::integer) ? value
                                     : coerce_quantity(session, value, dimension::none, need);
    case Accept::angle:
      return coerce_quantity(session, value, dimension::angle, need);
    case Accept::temperature:
      return coerce_quantity(session, value, dimension::temperature, need);
    case Accept::integer:
      return coerce(session, value, integer_type, need);
    case Accept::boolean:
      return value.is(Type::boolean) ? value
                                     : type_error(session, need, "`true` or `false`", value);
    case Accept::string:
      return value.is(Type::string) ? value : type_error(session, need, "a string", value);
    case Accept::choice:
      return value.is(Type::enumeration)
                 ? value
                 : type_error(session, need, "a choice such as `.auto`", value);
    case Accept::list:
      return is_listlike(value) ? value : type_error(session, need, "a list", value);
    case Accept::color:
      return value.is(Type::color) ? value : type_error(session, need, "a color", value);
    case Accept::color_input:
      return accepted_input(session, value, false, need);
    case Accept::number_input:
      return accepted_input(session, value, true, need);
    default:
      return accepted_vector(session, value, accept, need);
  }
}

std::optional<std::size_t> choice_of(Session& session, const Value& value,
                                     std::span<const std::string_view> names, const Need& need) {
  if (value.poisoned()) return std::nullopt;
  if (!value.is(Type::enumeration)) {
    type_error(session, need, fmt::format("a choice such as `.{}`", names.front()), value);
    return std::nullopt;
  }
  if (value.heap == nullptr) return std::nullopt;  // only its type is known
  for (std::size_t i = 0; i < names.size(); ++i) {
    if (names[i] == value.text()) return i;
  }
  std::vector<std::string> written;  // as an author writes them
  for (std::string_view name : names) written.push_back('.' + std::string(name));
  const std::vector<std::string_view> legal(written.begin(), written.end());
  const std::string word = '.' + value.text();
  session.report(unknown_word(DiagnosticKind::unknown_enum_value, need.span(),
                              fmt::format("{} has no choice `{}`", need.text(), printable(word)),
                              word, legal, "choices"));
  return std::nullopt;
}

}  // namespace scenec::frontend
