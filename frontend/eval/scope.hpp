// Names in force at one place: a chain of blocks, innermost first. A name is visible only behind
// its declaration in the same file, which is also what keeps a function's body from seeing what was
// declared after it.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

#include "base/span.hpp"
#include "frontend/eval/value.hpp"
#include "grammar/syntax_tree.hpp"

namespace scenec::frontend {

enum class BindingKind : std::uint8_t {
  let,
  param,
  loop_variable,
  parameter,
  material,
  proto,
  function,
  macro,
  name_space
};
[[nodiscard]] std::string_view text_of(BindingKind kind);

class Scope;

struct Binding {
  std::string_view name;
  Span span;  // of the name where it is declared
  BindingKind kind = BindingKind::let;
  bool used = false;
  bool lint_unused = true;  // false: allowed, or no author's declaration
  bool checked = false;     // a function whose result `value` is the type of
  Value value;              // of kinds with a value
  grammar::NodeRef node;    // the declaration: functions and macros are run from it
};

class Scope {
 public:
  explicit Scope(Scope* parent_scope = nullptr) : parent_(parent_scope) {}
  Scope(const Scope&) = delete;
  Scope& operator=(const Scope&) = delete;

  [[nodiscard]] Scope* parent() const { return parent_; }
  // The binding of this very block, or nullptr.
  [[nodiscard]] Binding* find_here(std::string_view name);
  // The innermost visible binding at a place, with the scope that holds it.
  struct Found {
    Binding* binding = nullptr;
    Scope* scope = nullptr;
  };
  [[nodiscard]] Found find(std::string_view name, Span use);
  // Precondition: find_here(name) is nullptr. References stay valid until the next add.
  Binding& add(Binding binding);
  [[nodiscard]] std::vector<Binding>& bindings() { return bindings_; }
  // Every visible name from here outwards, for "did you mean".
  [[nodiscard]] std::vector<std::string_view> visible_names(Span use) const;
  // The scope of an included file: `ns.name` looks here, and nowhere further out.
  [[nodiscard]] const std::shared_ptr<Scope>& name_space(std::string_view name) const;
  void add_name_space(std::string_view name, std::shared_ptr<Scope> scope);

 private:
  Scope* parent_;
  std::vector<Binding> bindings_;
  // What few scopes have, so that the many small ones cost nothing to make.
  struct Extras {
    std::unordered_map<std::string_view, std::uint32_t> index;  // only of blocks with many names
    std::unordered_map<std::string_view, std::shared_ptr<Scope>> name_spaces;
  };
  Extras& extras();
  std::unique_ptr<Extras> extras_;
};

}  // namespace scenec::frontend
