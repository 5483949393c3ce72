// Expressions to values. Recursion follows nesting, which the grammar bounds; chains and lists of
// any length are loops. One mistake, one diagnostic: what depends on a mistake is poison.
#pragma once

#include <functional>
#include <optional>
#include <string_view>
#include <vector>

#include "frontend/ast/sdl_ast.hpp"
#include "frontend/eval/builtins.hpp"
#include "frontend/eval/coerce.hpp"
#include "frontend/eval/scope.hpp"
#include "frontend/eval/site_memo.hpp"
#include "frontend/eval/value.hpp"
#include "frontend/session.hpp"
#include "grammar/syntax_tree.hpp"

namespace scenec::frontend {

class Evaluator {
 public:
  explicit Evaluator(Session& session) : session_(session) {}

  [[nodiscard]] Value evaluate(grammar::NodeRef node, Scope& scope);

  // Arguments of a call, evaluated and coerced, in the order of the parameters, declared in `into`.
  // False when one is wrong (reported).
  bool bind_arguments(grammar::NodeRef parameters, grammar::NodeRef arguments,
                      grammar::NodeRef call, std::string_view callee, Scope& caller, Scope& into);
  // The defaults of the parameters against their own ranges, called or not.
  void check_defaults(grammar::NodeRef parameters, Scope& scope);
  // Every parameter with nothing but its type known.
  void bind_unknown_parameters(grammar::NodeRef parameters, Scope& into);
  // Value against the `in` range behind a param or parameter; poison (reported) outside of it.
  Value in_range(const Value& value, grammar::NodeRef range, Scope& scope, std::string_view subject,
                 Span span);

  // Runs `body(scope)` for each round of a loop, the variables declared in `scope`; stops when it
  // returns false. When only types are known it runs once.
  void loop(const ast::Loop& parts, Scope& scope, const std::function<bool(Scope&)>& body);

  // The declaration a use refers to; nullptr (reported) when there is none.
  Scope::Found resolve(grammar::NodeRef name, Scope& scope);
  // `ns` of `ns.name`: the scope of an included file, nullptr when that could not be read
  // (reported); nullopt when the name is no namespace.
  [[nodiscard]] std::optional<Scope*> name_space(grammar::NodeRef name, Scope& scope);
  Scope::Found resolve_in(Scope& name_space, grammar::NodeRef space, grammar::NodeRef name);
  // Lints a name about to be declared in `scope` that hides one further out or a built-in one.
  void lint_hiding(grammar::NodeRef name, Scope& scope);
  // Whether a function or macro is being run already; a call from inside is recursion.
  [[nodiscard]] bool is_active(grammar::NodeRef declaration) const;
  struct Activating {
    Activating(Evaluator& owner, grammar::NodeRef declaration) : evaluator(owner) {
      owner.active_.push_back(declaration);
    }
    ~Activating() { evaluator.active_.pop_back(); }
    Activating(const Activating&) = delete;
    Activating& operator=(const Activating&) = delete;
    Evaluator& evaluator;
  };
  Value recursion(grammar::NodeRef call, std::string_view name, grammar::NodeRef declaration);
  // A function's body, checked with its parameters' types; what it returns, as far as types say.
  Value check_function(grammar::NodeRef function, Scope& scope);
  // False (reported at `call`) when calls are nested too deeply for one more.
  [[nodiscard]] bool may_go_deeper(grammar::NodeRef call) {
    return session_.deep_enough(active_.size(), call.span());
  }

 private:
  Value number_literal(grammar::NodeRef node);
  Value read_number(grammar::NodeRef node);
  Value name_value(grammar::NodeRef node, Scope& scope);
  Value binding_value(Binding& binding, grammar::NodeRef node);
  Value unary(grammar::NodeRef node, Scope& scope);
  Value chain(grammar::NodeRef node, Scope& scope);
  Value compare(grammar::NodeRef node, Scope& scope);
  Value logical_chain(grammar::NodeRef node, Scope& scope);
  Value list(grammar::NodeRef node, Scope& scope);
  Value comprehension(grammar::NodeRef node, Scope& scope);
  Value postfix(grammar::NodeRef node, Scope& scope);
  Value member(const Value& value, grammar::NodeRef node);
  Value index(const Value& value, grammar::NodeRef node, Scope& scope);
  Value call(grammar::NodeRef node, grammar::NodeRef callee, Scope& scope);
  Value call_binding(grammar::NodeRef node, grammar::NodeRef callee, Scope::Found found,
                     Scope& scope);
  Value call_builtin(grammar::NodeRef node, const Builtin& function, Scope& scope);
  Value select(grammar::NodeRef node, Scope& scope);
  bool bind_builtin(Call& call, const Builtin& function, const ast::Arguments& given, Scope& scope);
  void unknown_name(grammar::NodeRef name, Scope& scope);
  [[nodiscard]] std::optional<Span> declared_later(grammar::NodeRef name) const;
  void loop_over_range(const ast::Loop& parts, Scope& scope,
                       const std::function<bool(Scope&)>& body);
  void loop_over_list(const ast::Loop& parts, Scope& scope,
                      const std::function<bool(Scope&)>& body);
  void declare_variables(const ast::Loop& parts, Scope& round);
  bool run_round(const ast::Loop& parts, Scope& round, Value index, Value element,
                 const std::function<bool(Scope&)>& body);

  Session& session_;
  std::vector<grammar::NodeRef> active_;  // functions and macros being run
  std::size_t unknown_names_ = 0;
  SiteMemo<Value, 64> numerals_;
  SiteMemo<const Builtin*, 64> builtins_;
};

[[nodiscard]] std::string decoded_string(std::string_view quoted);

}  // namespace scenec::frontend
