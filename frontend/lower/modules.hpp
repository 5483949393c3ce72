// Included files and the values of `-D`: texts besides the scene's own, each parsed once and kept
// alive as long as names refer to them.
#pragma once

#include <map>
#include <memory>
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

  // The declarations of an included file; nullptr (reported at `use`) when it cannot be read or
  // includes itself.
  std::shared_ptr<Scope> load(const std::string& path, grammar::NodeRef use);
  // The expression behind `-D name=`; empty (reported) when it is none.
  grammar::NodeRef parse_setting(const ParamSetting& setting);
  [[nodiscard]] grammar::NodeRef setting_expression(std::string_view name) const;

 private:
  struct Module {
    std::unique_ptr<grammar::SyntaxTree> tree;
    std::shared_ptr<Scope> scope;
    bool loading = true;
  };
  std::unique_ptr<grammar::SyntaxTree> read(const std::string& path, grammar::NodeRef use);

  Lowering& lowering_;
  Session& session_;
  std::map<std::string, Module> modules_;
  std::vector<Span> open_;  // the includes being loaded, outermost first
  std::map<std::string, std::unique_ptr<grammar::SyntaxTree>, std::less<>> settings_;
};

}  // namespace scenec::frontend
