// Changes that mean nothing leave the IR alone: for every scene of the project, comments and blanks
// anywhere, other names, fields and declarations in another order give the same content hash. The
// changes are random; the seed is printed, and SCENEC_METAMORPHIC_SEED repeats a run.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <iostream>
#include <map>
#include <optional>
#include <random>
#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "base/source_map.hpp"
#include "frontend/ast/sdl_ast.hpp"
#include "frontend/compile.hpp"
#include "frontend/eval/builtins.hpp"
#include "grammar/parse.hpp"
#include "tests/support/overlay_file_system.hpp"
#include "tests/support/scenes.hpp"

namespace {

namespace fs = std::filesystem;
using namespace scenec;
using grammar::NodeRef;
using grammar::SyntaxKind;
using Random = std::mt19937_64;

std::size_t below(Random& random, std::size_t count) {
  return std::uniform_int_distribution<std::size_t>(0, count - 1)(random);
}

class Text {
 public:
  explicit Text(std::string text) {
    const FileId file = sources_.add("scene.sdl", std::move(text));
    tree_ = grammar::parse_sdl(file, sources_.text(file), sink_);
  }
  [[nodiscard]] const grammar::SyntaxTree& tree() const { return tree_; }
  [[nodiscard]] std::string text() const { return std::string(tree_.text()); }
  [[nodiscard]] std::vector<NodeRef> nodes() const {
    std::vector<NodeRef> result;
    for (std::uint32_t i = 0; i < tree_.nodes().size(); ++i) result.emplace_back(&tree_, i);
    return result;
  }

 private:
  SourceMap sources_;
  DiagnosticSink sink_;
  grammar::SyntaxTree tree_;
};

struct Edit {
  std::uint32_t begin;
  std::uint32_t end;
  std::string text;
};
std::string edited(std::string text, std::vector<Edit> edits) {
  std::sort(edits.begin(), edits.end(),
            [](const Edit& a, const Edit& b) { return a.begin > b.begin; });
  for (const Edit& edit : edits) text.replace(edit.begin, edit.end - edit.begin, edit.text);
  return text;
}

// ---- blanks and comments ------------------------------------------------------------------------

std::string with_other_trivia(const std::string& source, Random& random) {
  const Text text(source);
  static constexpr const char* pieces[] = {" ",         "\n",   "\r\n",       "\t ",
                                           " /* c */ ", "\n\n", " // it's\n", " /* /// \n m */\n"};
  std::vector<Edit> edits;
  for (const NodeRef node : text.nodes()) {
    if (!grammar::is_token(node.kind()) || below(random, 3) != 0) continue;
    const auto end = static_cast<std::uint32_t>(node.span().end);
    edits.push_back({end, end, pieces[below(random, std::size(pieces))]});
  }
  return edited(source, std::move(edits));
}

// ---- names --------------------------------------------------------------------------------------

// Names of declarations in the text that nothing outside of it knows by another role.
std::set<std::string, std::less<>> free_names(const Text& text) {
  std::set<std::string, std::less<>> declared;
  std::set<std::string, std::less<>> taken;
  for (const std::string_view name : frontend::builtin_names()) taken.emplace(name);
  for (const std::string_view name : frontend::constant_names()) taken.emplace(name);
  for (const NodeRef node : text.nodes()) {
    switch (node.kind()) {
      case SyntaxKind::let:
      case SyntaxKind::param:
      case SyntaxKind::fn:
      case SyntaxKind::macro:
      case SyntaxKind::proto:
      case SyntaxKind::material:
      case SyntaxKind::camera:
      case SyntaxKind::include:
        if (const NodeRef name = frontend::ast::item_of(node).name) declared.emplace(name.text());
        break;
      case SyntaxKind::parameter:
        if (const NodeRef name = node.find_child(SyntaxKind::name)) taken.emplace(name.text());
        break;
      case SyntaxKind::argument:
        if (const NodeRef name = node.find_child(SyntaxKind::name)) taken.emplace(name.text());
        break;
      case SyntaxKind::member:
        for (const NodeRef child : node.children()) {
          if (child.is(SyntaxKind::name)) taken.emplace(child.text());
        }
        break;
      default:
        break;
    }
  }
  for (const std::string& name : taken) declared.erase(name);
  return declared;
}

// The name tokens that stand for a declaration: not keys, kinds, types, members and annotations.
bool refers_to_declaration(NodeRef parent, NodeRef name) {
  switch (parent.kind()) {
    case SyntaxKind::name_ref:
    case SyntaxKind::qualified_name:
      return true;
    case SyntaxKind::let:
    case SyntaxKind::param:
    case SyntaxKind::fn:
    case SyntaxKind::macro:
    case SyntaxKind::proto:
    case SyntaxKind::material:
    case SyntaxKind::camera:
    case SyntaxKind::include:
      return frontend::ast::item_of(parent).name == name;
    default:
      return false;
  }
}

std::string with_other_names(const std::string& source, Random& random) {
  const Text text(source);
  std::map<std::string, std::string, std::less<>> other;
  for (const std::string& name : free_names(text)) {
    if (below(random, 4) != 0) other[name] = "renamed_" + name + std::to_string(random() % 1000);
  }
  std::vector<Edit> edits;
  for (const NodeRef parent : text.nodes()) {
    if (grammar::is_token(parent.kind())) continue;
    bool is_first = true;
    for (const NodeRef child : parent.children()) {
      if (!child.is(SyntaxKind::name)) continue;
      const bool is_member = parent.is(SyntaxKind::qualified_name) && !is_first;
      is_first = false;
      const auto found = other.find(child.text());
      if (found == other.end() || is_member || !refers_to_declaration(parent, child)) continue;
      edits.push_back({child.span().begin, child.span().end, found->second});
    }
  }
  return edited(source, std::move(edits));
}

// ---- order --------------------------------------------------------------------------------------

std::string piece_of(const std::string& source, NodeRef node) {
  return source.substr(node.span().begin, node.span().end - node.span().begin);
}

// Fields of every block change places among each other.
std::string with_shuffled_fields(const std::string& source, Random& random) {
  const Text text(source);
  std::vector<Edit> edits;
  for (const NodeRef block : text.nodes()) {
    if (!block.is(SyntaxKind::block)) continue;
    std::vector<NodeRef> fields;
    bool has_let = false;
    for (const NodeRef child : block.children()) {
      if (child.is(SyntaxKind::field)) fields.push_back(child);
      has_let = has_let || child.is(SyntaxKind::let);  // a value may use it: it stays above
    }
    if (has_let) continue;
    std::vector<NodeRef> shuffled = fields;
    std::shuffle(shuffled.begin(), shuffled.end(), random);
    for (std::size_t i = 0; i < fields.size(); ++i) {
      edits.push_back(
          {fields[i].span().begin, fields[i].span().end, piece_of(source, shuffled[i])});
    }
  }
  return edited(source, std::move(edits));
}

bool is_declaration(SyntaxKind kind) {
  switch (kind) {
    case SyntaxKind::let:
    case SyntaxKind::param:
    case SyntaxKind::fn:
    case SyntaxKind::macro:
    case SyntaxKind::proto:
    case SyntaxKind::material:
    case SyntaxKind::camera:
    case SyntaxKind::include:
    case SyntaxKind::render:
      return true;
    default:
      return false;
  }
}

bool mentions(NodeRef node, std::string_view name) {
  const auto& nodes = node.tree().nodes();
  for (std::uint32_t i = node.index(); i < nodes[node.index()].next; ++i) {
    const NodeRef one(&node.tree(), i);
    if (one.is(SyntaxKind::name) && one.text() == name) return true;
  }
  return false;
}

// Whether what stands second may as well stand first.
bool may_swap(NodeRef first, NodeRef second) {
  if (!is_declaration(first.kind()) && !is_declaration(second.kind())) return false;
  const auto name = [](NodeRef node) {
    return is_declaration(node.kind()) ? frontend::ast::item_of(node).name : NodeRef();
  };
  const NodeRef first_name = name(first);
  const NodeRef second_name = name(second);
  if (first_name && mentions(second, first_name.text())) return false;
  return !second_name || !mentions(first, second_name.text());
}

// Neighbours at the top of the file swap places, many times.
std::string with_moved_declarations(std::string source, Random& random) {
  for (int round = 0; round < 12; ++round) {
    const Text text(source);
    std::vector<NodeRef> items;
    for (const NodeRef child : text.tree().root().children()) {
      if (!grammar::is_token(child.kind()) && !child.is(SyntaxKind::edition))
        items.push_back(child);
    }
    if (items.size() < 2) return source;
    std::vector<Edit> edits;
    for (std::size_t i = below(random, 2); i + 1 < items.size(); i += 2) {
      if (!may_swap(items[i], items[i + 1]) || below(random, 3) == 0) continue;
      for (const std::size_t k : {i, i + 1}) {
        const std::size_t other = k == i ? i + 1 : i;
        edits.push_back(
            {items[k].span().begin, items[k].span().end, piece_of(source, items[other])});
      }
    }
    source = edited(source, std::move(edits));
  }
  return source;
}

// ---- the test -----------------------------------------------------------------------------------

struct Scene {
  fs::path path;
  std::string text;
  std::string hash;
};

// The hash of the scene with this text in the place of its file; nothing with an error.
std::optional<std::string> hash_of(const fs::path& path, const std::string& text,
                                   std::string* messages = nullptr) {
  fs::current_path(path.parent_path());
  const std::string name = path.filename().string();
  test::OverlayFileSystem files(name, text);
  SourceMap sources;
  DiagnosticSink sink;
  const auto scene = frontend::compile(name, {}, files, sources, sink);
  if (messages != nullptr) {
    for (const Diagnostic& diagnostic : sink.sorted()) *messages += diagnostic.message + "\n";
  }
  if (!scene) return std::nullopt;
  return scene->hash.hex();
}

const std::vector<Scene>& scenes() {
  static const std::vector<Scene> all = [] {
    std::vector<Scene> result;
    for (const fs::path& path : test::scenes_beneath({"stdlib-scenes", "tests"})) {
      if (path.extension() != ".sdl") continue;
      std::string text = test::text_of_file(path);
      if (text.size() > 100'000) continue;
      const auto hash = hash_of(path, text);
      if (hash) result.push_back({path, std::move(text), *hash});
    }
    return result;
  }();
  return all;
}

std::uint64_t seed() {
  const char* const given = std::getenv("SCENEC_METAMORPHIC_SEED");
  return given != nullptr ? std::stoull(given) : std::random_device{}();
}

using Change = std::string (*)(const std::string&, Random&);

void expect_same_scene(Change change) {
  const std::uint64_t start = seed();
  std::cout << "seed " << start << ", " << scenes().size() << " scenes\n";
  int changed = 0;
  for (const Scene& scene : scenes()) {
    Random random(start);
    for (int variant = 0; variant < 3; ++variant) {
      const std::string other = change(scene.text, random);
      changed += other == scene.text ? 0 : 1;
      std::string messages;
      ASSERT_EQ(hash_of(scene.path, other, &messages), scene.hash)
          << scene.path << " with SCENEC_METAMORPHIC_SEED=" << start << "\n"
          << messages << other;
    }
  }
  EXPECT_GT(changed, static_cast<int>(scenes().size()));
}

TEST(Metamorphic, BlanksAndCommentsMeanNothing) {
  expect_same_scene(with_other_trivia);
}

TEST(Metamorphic, NamesMeanNothing) {
  expect_same_scene(with_other_names);
}

TEST(Metamorphic, TheOrderOfFieldsMeansNothing) {
  expect_same_scene(with_shuffled_fields);
}

TEST(Metamorphic, TheOrderOfDeclarationsMeansNothing) {
  expect_same_scene([](const std::string& text, Random& random) {
    return with_moved_declarations(text, random);
  });
}

TEST(Metamorphic, AllOfItTogetherMeansNothing) {
  expect_same_scene([](const std::string& text, Random& random) {
    return with_other_trivia(
        with_other_names(with_shuffled_fields(with_moved_declarations(text, random), random),
                         random),
        random);
  });
}

// The counterproof: what does mean something changes the hash.
TEST(Metamorphic, TheOrderOfPlacedItemsCounts) {
  const std::string head =
      "sdl 1;\nmaterial m: diffuse { color = white; }\nlight: point { position = [0, 3, 0]; power "
      "= 60W; }\ncamera c: pinhole { eye = [0, 0, 5]; aim = [0, 0, 0]; fov = 40deg; }\n";
  const std::string a = "sphere { material = m; }\n";
  const std::string b = "sphere { center = [1, 0, 0]; material = m; }\n";
  const fs::path path = test::source_directory() / "none.sdl";
  EXPECT_NE(hash_of(path, head + a + b), hash_of(path, head + b + a));
}

}  // namespace
