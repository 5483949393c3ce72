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
#include "frontend/session.hpp"
#include "grammar/syntax_tree.hpp"

namespace scenec::frontend {

class Lowering;

class Modules {
 public:
  Modules(Lowering& lowering, Session& session) : lowering_(lowering), session_(session) {}

  // The declarations of the file included as `written`; nullptr (reported at `use`) when it cannot
  // be read or includes itself.
  std::shared_ptr<Scope> load(const std::string& written, grammar::NodeRef use);
  // The expression `text`, the value of the setting; empty (reported) when it is none.
  grammar::NodeRef parse_setting(const ParamSetting& setting, const std::string& text);
  [[nodiscard]] grammar::NodeRef setting_expression(std::string_view name) const;

 private:
  struct Module {
    std::unique_ptr<grammar::SyntaxTree> tree;
    std::shared_ptr<Scope> scope;
    bool loading = true;
  };
  // Where an included text comes from. A library includes its neighbours by relative names.
  struct Place {
    bool in_library = false;
    std::string path;  // `std:NAME.sdl`, or as the file system opens it
    auto operator<=>(const Place&) const = default;
  };
  [[nodiscard]] Place place_of(const std::string& written, FileId from) const;
  std::unique_ptr<grammar::SyntaxTree> read(const Place& place, grammar::NodeRef use);
  std::unique_ptr<grammar::SyntaxTree> read_library(const std::string& path, grammar::NodeRef use);

  Lowering& lowering_;
  Session& session_;
  std::map<Place, Module> modules_;
  std::set<FileId> library_texts_;
  std::vector<Span> open_;  // the includes being loaded, outermost first
  std::map<std::string, std::unique_ptr<grammar::SyntaxTree>, std::less<>> settings_;
};

}  // namespace scenec::frontend
