// What one process keeps between compilations (a watch daemon, a language server): the trees of
// texts and what included files declare. Both are known by content: a file that is saved without a
// change is not parsed again, and one that includes nothing changed either is not evaluated again.
// Work that is spared does not count against the budget of steps. One compilation at a time.
#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <list>
#include <memory>
#include <string_view>
#include <unordered_map>
#include <vector>

#include "base/diagnostic.hpp"
#include "base/hash.hpp"
#include "frontend/eval/scope.hpp"
#include "frontend/eval/value.hpp"
#include "frontend/param_info.hpp"
#include "grammar/parse.hpp"
#include "ir/builder.hpp"

namespace scenec::frontend {

struct CompileOptions;

// What an included file declares, its values in terms of the cache's own scene. Only of files that
// gave no diagnostic and read no asset.
struct KeptModule {
  struct Include {
    std::uint32_t node = 0;  // of the path
    Hash128 content;         // of what it led to
  };
  struct Declaration {
    std::uint32_t begin = 0;  // of the name
    std::uint32_t end = 0;
    BindingKind kind = BindingKind::let;
    bool lint_unused = true;
    std::uint32_t node = 0;  // of functions, macros and params; 0: none
    Value value;
  };
  std::vector<Include> includes;
  std::vector<Declaration> declarations;
  Hash128 content;  // of its place and text, and of all it includes
  bool emission = false;
};

class FrontendCache {
 public:
  // Keeps about `byte_budget` bytes of trees, and as much of modules unless told otherwise; what
  // was used longest ago goes first. A tree that `unused_for` compilations did without goes in any
  // case, and all modules go when most of them are of that kind: under ten thousand edits nothing
  // grows.
  explicit FrontendCache(std::size_t byte_budget = std::size_t{256} << 20)
      : FrontendCache(byte_budget, byte_budget, std::numeric_limits<std::uint64_t>::max()) {}
  FrontendCache(std::size_t byte_budget, std::size_t module_budget, std::uint64_t unused_for)
      : byte_budget_(byte_budget), module_budget_(module_budget), unused_for_(unused_for) {}

  struct Counters {
    std::uint64_t files_parsed = 0;
    std::uint64_t files_reused = 0;
    std::uint64_t files_forgotten = 0;
    std::uint64_t modules_evaluated = 0;
    std::uint64_t modules_reused = 0;
  };
  [[nodiscard]] const Counters& counters() const { return counters_; }
  [[nodiscard]] std::size_t bytes() const { return bytes_; }
  [[nodiscard]] std::size_t module_count() const { return modules_.size(); }

  // The tree of the text, parsed now or earlier. What parsing reports is reported either way.
  [[nodiscard]] grammar::SyntaxTree tree_of(grammar::Dialect dialect, FileId file,
                                            std::string_view text, DiagnosticSink& sink);

  // ---- for the compilation that uses the cache (frontend/lower/modules.hpp)
  // Before anything else: what has become too much is forgotten.
  void begin_compilation();
  // `key`: hash of a file's place and text.
  [[nodiscard]] std::shared_ptr<const KeptModule> find_module(Hash128 key);
  void keep_module(Hash128 key, KeptModule module);
  // A param of the scene itself.
  void note_param(ParamInfo info) { params_.push_back(std::move(info)); }
  // Those of the last compilation, as far as it got.
  [[nodiscard]] const std::vector<ParamInfo>& params() const { return params_; }
  // A number for the file, the same each time.
  [[nodiscard]] FileId file_number(Hash128 key);
  [[nodiscard]] ir::SceneBuilder& rows() { return rows_; }
  void count_module(bool reused) {
    ++(reused ? counters_.modules_reused : counters_.modules_evaluated);
  }

 private:
  struct Key {
    Hash128 hash;
    std::size_t size = 0;
    grammar::Dialect dialect = grammar::Dialect::sdl;
    friend bool operator==(const Key&, const Key&) = default;
  };
  struct KeyHash {
    std::size_t operator()(const Key& key) const { return std::hash<Hash128>{}(key.hash); }
  };
  struct Entry {
    Key key;
    grammar::SyntaxTree tree;  // without its text
    std::vector<Diagnostic> found;
    std::size_t bytes = 0;
    std::uint64_t last_used = 0;  // in which compilation
  };
  struct ModuleEntry {
    std::shared_ptr<const KeptModule> module;
    std::uint64_t last_used = 0;
  };
  void forget_down_to(std::size_t budget);
  // Most of the modules are of texts that are gone; they share tables, so they go together.
  [[nodiscard]] bool has_stale_modules() const;
  [[nodiscard]] std::size_t module_bytes() const;

  void forget_oldest();

  std::size_t byte_budget_;
  std::size_t module_budget_;
  std::uint64_t unused_for_;
  std::uint64_t compilations_ = 0;
  std::size_t bytes_ = 0;
  Counters counters_;
  std::list<Entry> entries_;  // the one used last first
  std::unordered_map<Key, std::list<Entry>::iterator, KeyHash> index_;
  std::unordered_map<Hash128, ModuleEntry> modules_;
  std::unordered_map<Hash128, FileId> file_numbers_;
  ir::SceneBuilder rows_;  // what the values of modules refer to
  std::size_t declaration_count_ = 0;
  std::vector<ParamInfo> params_;
};

// Parses the text, or takes its tree from the cache of the options.
[[nodiscard]] grammar::SyntaxTree parsed_text(const CompileOptions& options,
                                              grammar::Dialect dialect, FileId file,
                                              std::string_view text, DiagnosticSink& sink);

}  // namespace scenec::frontend
