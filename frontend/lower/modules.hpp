// Included files and the values of `-D` and `--params`: texts besides the scene's own, each parsed
// once and kept alive as long as names refer to them.
#pragma once

#include <map>
#include <memory>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "frontend/compile.hpp"
#include "frontend/eval/scope.hpp"
#include "frontend/frontend_cache.hpp"
#include "frontend/scene_copy.hpp"
#include "frontend/session.hpp"
#include "grammar/syntax_tree.hpp"

namespace scenec::frontend {

class Lowering;

class Modules {
 public:
  Modules(Lowering& lowering, Session& session);

  // The scene's own file: including it again is a cycle, and its text counts.
  void open_scene(FileId file, FileIdentity identity);

  // The declarations of the file included as `written`; nullptr (reported at `use`) when it cannot
  // be read or includes itself, by this name or another.
  std::shared_ptr<Scope> load(const std::string& written, grammar::NodeRef use);
  // The expression `text`, the value of the setting; empty (reported) when it is none.
  grammar::NodeRef parse_setting(const ParamSetting& setting, const std::string& text);
  [[nodiscard]] grammar::NodeRef setting_expression(std::string_view name) const;

 private:
  struct Module {
    std::unique_ptr<grammar::SyntaxTree> tree;
    std::shared_ptr<Scope> scope;  // nullptr: it could not be read, or is being loaded
    Hash128 key;                   // of its place and text
    Hash128 content;               // and of all it includes
    bool kept = false;             // in the cache
  };
  // Where an included text comes from. A library includes its neighbours by relative names.
  struct Place {
    bool in_library = false;
    std::string path;  // `std:NAME.sdl`, or as the file system opens it
    auto operator<=>(const Place&) const = default;
  };
  [[nodiscard]] Place place_of(const std::string& written, FileId from) const;
  // A file being loaded, and where it is included.
  struct Open {
    std::string path;
    FileIdentity identity;
    Span use;
  };
  [[nodiscard]] bool read(const Place& place, grammar::NodeRef use, Module& module);
  [[nodiscard]] bool read_library(const std::string& path, grammar::NodeRef use, Module& module);
  [[nodiscard]] bool parse(FileId file, std::string_view text, grammar::NodeRef use,
                           Module& module);
  [[nodiscard]] bool check_limits(grammar::NodeRef use);
  // True (reported) when the file is among those being loaded.
  [[nodiscard]] bool is_cycle(const std::string& path, FileIdentity identity, grammar::NodeRef use);

  // From one compilation to the next (module_results.cpp); nothing happens without a cache.
  struct Traces {
    std::size_t diagnostics = 0;
    std::size_t lints = 0;
    bool emission = false;
  };
  [[nodiscard]] Traces traces() const;
  void evaluate(Module& module, const Traces& before);
  [[nodiscard]] bool reuse(Module& module);
  [[nodiscard]] bool keep(Module& module, const Traces& before);
  [[nodiscard]] bool keep_scope(Module& module, KeptModule& kept);
  [[nodiscard]] Module* find_included(grammar::NodeRef path);

  Lowering& lowering_;
  Session& session_;
  RowMap kept_of_here_, here_of_kept_;
  std::map<FileId, FileId> kept_files_, here_files_;
  std::map<Place, Module> modules_;
  std::set<FileId> library_texts_;
  std::vector<Open> open_;  // outermost first: the scene, then the includes being loaded
  std::uint64_t source_bytes_ = 0;
  std::map<std::string, std::unique_ptr<grammar::SyntaxTree>, std::less<>> settings_;
};

}  // namespace scenec::frontend
