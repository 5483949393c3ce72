// What the parts of Lowering share among their translation units.
#pragma once

#include "frontend/lower/lowering.hpp"

namespace scenec::frontend {

// A Fields for one block, given back at the end.
struct Lowering::FieldsLease {
  explicit FieldsLease(Lowering& lowering) : owner(lowering) {
    if (owner.field_depth_ == owner.field_pool_.size()) owner.field_pool_.emplace_back();
    fields = &owner.field_pool_[owner.field_depth_++];
    fields->clear();
  }
  ~FieldsLease() { --owner.field_depth_; }
  FieldsLease(const FieldsLease&) = delete;
  FieldsLease& operator=(const FieldsLease&) = delete;
  Lowering& owner;
  Fields* fields = nullptr;
};

template <class Checked, class First, class... Rest>
bool Lowering::read_block(NodeRef block, Span head, Scope& scope, const Checked& checked,
                          First& first, Rest&... rest) {
  const FieldsLease lease(*this);
  Scope inside(&scope);
  collect(block, inside, *lease.fields);
  BlockChecker checker(session_, evaluator_, *this, inside, *lease.fields, ir::Schema<First>::name,
                       head);
  checker.read(first);
  (checker.read(rest), ...);
  checker.template finish<First, Rest...>();
  const bool sound = checker.sound();
  if (sound && !session_.checking_only()) checked(checker);
  close(inside);
  return sound;
}

// Calls f.operator()<T>() for the T of a variant or type list whose schema has the name; false when
// there is none.
template <class List>
struct KindDispatch;
template <template <class...> class List, class... Ts>
struct KindDispatch<List<Ts...>> {
  template <class F>
  static bool call(std::string_view name, F&& f) {
    return ((ir::Schema<Ts>::name == name ? (f.template operator()<Ts>(), true) : false) || ...);
  }
  static std::vector<std::string_view> names() { return {ir::Schema<Ts>::name...}; }
};

void report_unknown_kind(Session& session, grammar::NodeRef kind, std::string_view family,
                         std::span<const std::string_view> legal);

}  // namespace scenec::frontend
