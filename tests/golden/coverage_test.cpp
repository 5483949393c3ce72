// Nothing of the languages is without a golden case: every kind and every key of every schema,
// every choice, every function, constant, type, unit and annotation appears in a scene of
// tests/golden/lower that compiles and has its expected text.
// (Grammar rules: tests/unit/grammar/grammar_check_test.cpp. Diagnostics: tests/diagnostics.)
#include <gtest/gtest.h>

#include <filesystem>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "base/source_map.hpp"
#include "base/units.hpp"
#include "frontend/ast/sdl_ast.hpp"
#include "frontend/compile.hpp"
#include "frontend/eval/builtins.hpp"
#include "frontend/eval/coerce.hpp"
#include "ir/describe.hpp"
#include "tests/golden/runner.hpp"
#include "tests/support/paths.hpp"

namespace {

namespace fs = std::filesystem;
using namespace scenec;
using grammar::NodeRef;
using grammar::SyntaxKind;
using Names = std::set<std::string, std::less<>>;

// What stands in the scenes, by role. Keys are "kind.key", choices ".name".
struct Seen {
  Names kinds;
  Names keys;
  Names choices;
  Names calls;
  Names names;
  Names types;
  Names units;
  Names annotations;
};

std::string unit_of(std::string_view numeral) {
  const std::size_t digits = numeral.find_first_not_of("0123456789.");
  if (digits == std::string_view::npos) return "";
  std::string_view rest = numeral.substr(digits);
  const bool has_exponent =
      rest.size() > 1 && rest[0] == 'e' &&
      std::string_view("+-0123456789").find(rest[1]) != std::string_view::npos;
  if (has_exponent) {
    const std::size_t end = rest.find_first_not_of("+-0123456789", 1);
    rest = end == std::string_view::npos ? "" : rest.substr(end);
  }
  return std::string(rest);
}

std::string kind_of_block(NodeRef node) {
  switch (node.kind()) {
    case SyntaxKind::render:
      return "render";
    case SyntaxKind::group:
      return "group";
    case SyntaxKind::instance:
      return "instance";
    case SyntaxKind::shape:
    case SyntaxKind::material:
    case SyntaxKind::light:
    case SyntaxKind::camera: {
      const NodeRef kind = frontend::ast::item_of(node).kind;
      const std::string family = node.is(SyntaxKind::light)    ? "light "
                                 : node.is(SyntaxKind::camera) ? "camera "
                                                               : "";
      return kind ? family + std::string(kind.text()) : "";
    }
    default:
      return "";
  }
}

void see_block(NodeRef node, Seen& seen) {
  const std::string kind = kind_of_block(node);
  if (kind.empty()) return;
  seen.kinds.insert(kind);
  const NodeRef block = frontend::ast::item_of(node).block;
  if (!block) return;
  for (const NodeRef item : block.children()) {
    if (item.is(SyntaxKind::field)) {
      const NodeRef name = frontend::ast::field_of(item).name;
      if (name) seen.keys.insert(kind + "." + std::string(name.text()));
    } else if (item.is(SyntaxKind::shape)) {  // `stop { }` and `effects { }` are keys of render
      seen.keys.insert(kind + "." + std::string(frontend::ast::item_of(item).kind.text()));
    }
  }
}

void see_node(NodeRef node, Seen& seen) {
  see_block(node, seen);
  const auto first_name = [&] { return node.find_child(SyntaxKind::name); };
  switch (node.kind()) {
    case SyntaxKind::call:
      if (const NodeRef callee = node.find_child(SyntaxKind::name_ref)) {
        seen.calls.emplace(callee.text());
      }
      break;
    case SyntaxKind::name_ref:
      seen.names.emplace(node.text());
      break;
    case SyntaxKind::enum_literal:
      seen.choices.emplace(node.text());
      break;
    case SyntaxKind::type:
      if (const NodeRef name = first_name()) seen.types.emplace(name.text());
      break;
    case SyntaxKind::number:
      seen.units.insert(unit_of(node.text()));
      break;
    case SyntaxKind::annotation:
      if (const NodeRef name = first_name()) seen.annotations.emplace(name.text());
      break;
    default:
      break;
  }
}

// The scenes of tests/golden/FOLDER, which must compile (a library too).
void see_folder(const std::string& folder, Seen& seen) {
  const fs::path root = test::source_directory() / "tests" / "golden" / folder;
  for (const fs::path& path : test::files_in(root, {".sdl", ".txt"})) {
    fs::current_path(root);
    RealFileSystem files;
    SourceMap sources;
    DiagnosticSink sink;
    frontend::CompileOptions options;
    options.library = true;
    const auto loaded = frontend::load(path.filename(), options, files, sources, sink);
    ASSERT_TRUE(loaded) << path;
    ASSERT_TRUE(frontend::compile(*loaded, options, files, sources, sink)) << path;
    ASSERT_TRUE(fs::exists(path.string() + ".expected")) << path;
    const auto count = static_cast<std::uint32_t>(loaded->tree.nodes().size());
    for (std::uint32_t i = 0; i < count; ++i) see_node(NodeRef(&loaded->tree, i), seen);
  }
}

const Seen& golden_scenes() {
  static const Seen seen = [] {
    Seen all;
    see_folder("lower", all);
    return all;
  }();
  return seen;
}

// The wanted names that were not seen, in one line; empty: all were.
std::string missing(const std::vector<std::string>& wanted, const Names& seen) {
  std::string result;
  for (const std::string& name : std::set<std::string>(wanted.begin(), wanted.end())) {
    if (!seen.contains(name)) result += (result.empty() ? "" : ", ") + name;
  }
  return result;
}
template <class Range>
std::vector<std::string> texts_of(const Range& range) {
  return {range.begin(), range.end()};
}

// Lights and cameras share names with shapes.
std::string full_name(const ir::KindDescription& kind) {
  const bool named_by_family = kind.family == "light" || kind.family == "camera";
  return (named_by_family ? std::string(kind.family) + " " : "") + std::string(kind.name);
}
// Keys that every kind of a family has, and what stands in a block of its own, in no kind's table.
bool is_kind(const ir::KindDescription& kind) {
  return kind.family != "item" && kind.family != "material_common";
}
std::vector<std::string> keys_of(const ir::KindDescription& kind) {
  std::vector<std::string> owners{full_name(kind)};
  if (kind.family == "item") owners = {"group", "instance", "sphere"};
  if (kind.family == "material_common") owners = {"diffuse"};
  std::vector<std::string> keys;
  for (const std::string& owner : owners) {
    for (const ir::KeyDescription& key : kind.keys) {
      keys.push_back(owner + "." + std::string(key.name));
    }
  }
  return keys;
}

TEST(Coverage, EveryKind) {
  std::vector<std::string> kinds;
  for (const ir::KindDescription& kind : ir::all_kinds()) {
    if (is_kind(kind)) kinds.push_back(full_name(kind));
  }
  EXPECT_EQ(missing(kinds, golden_scenes().kinds), "");
}

TEST(Coverage, EveryKey) {
  std::vector<std::string> keys;
  for (const ir::KindDescription& kind : ir::all_kinds()) {
    const std::vector<std::string> of_kind = keys_of(kind);
    keys.insert(keys.end(), of_kind.begin(), of_kind.end());
  }
  EXPECT_EQ(missing(keys, golden_scenes().keys), "");
}

TEST(Coverage, EveryChoice) {
  std::vector<std::string> choices;
  for (const ir::KindDescription& kind : ir::all_kinds()) {
    for (const ir::KeyDescription& key : kind.keys) {
      for (const std::string_view value : key.legal_values)
        choices.push_back("." + std::string(value));
    }
  }
  EXPECT_EQ(missing(choices, golden_scenes().choices), "");
}

TEST(Coverage, EveryFunctionAndConstant) {
  EXPECT_EQ(missing(texts_of(frontend::builtin_names()), golden_scenes().calls), "");
  EXPECT_EQ(missing(texts_of(frontend::constant_names()), golden_scenes().names), "");
}

TEST(Coverage, EveryTypeUnitAndAnnotation) {
  EXPECT_EQ(missing(texts_of(frontend::type_names()), golden_scenes().types), "");
  std::vector<std::string> units;
  for (const Unit& unit : all_units()) units.emplace_back(unit.suffix);
  EXPECT_EQ(missing(units, golden_scenes().units), "");
  EXPECT_EQ(missing({"allow", "clock"}, golden_scenes().annotations), "");
}

}  // namespace
