#include "frontend/eval/lists.hpp"

#include <fmt/format.h>

#include "frontend/eval/coerce.hpp"

namespace scenec::frontend {

using grammar::NodeRef;

namespace {

bool same_family(const Value& a, const Value& b) {
  if (a.is_number() && b.is_number()) return true;
  if (is_listlike(a) && is_listlike(b)) return true;  // lists of any lengths: faces, ramps
  const auto colored = [](const Value& v) { return v.is(Type::color) || v.is(Type::texture); };
  return a.type == b.type || (colored(a) && colored(b));
}

// Gives plain numbers (and vectors of them) the dimension of the first sibling that has one.
bool unify(Session& session, ValueList& elements, NodeRef list, std::span<const NodeRef> nodes) {
  std::size_t pattern = 0;
  while (pattern < elements.size() && elements[pattern].dimension.none()) ++pattern;
  if (pattern == elements.size()) return true;
  const Dimension wanted = elements[pattern].dimension;
  for (std::size_t i = 0; i < elements.size(); ++i) {
    Value& element = elements[i];
    if (element.dimension == wanted) continue;
    if (!element.is_number() && !element.is_vector()) continue;
    if (!common_dimension(element, elements[pattern])) {
      const NodeRef here = nodes.empty() ? NodeRef{} : nodes[i];
      mixed_dimensions(session, here ? here.span() : list.span(), "[ ]", elements[pattern], element,
                       nodes.empty() ? NodeRef{} : nodes[pattern], here);
      return false;
    }
    if (element.is(Type::integer)) {
      const bool known = element.known;
      element = make_number(element.real(), wanted);
      element.known = known;
    }
    element.dimension = wanted;
    element.whole = false;
  }
  return true;
}

}  // namespace

Value checked_list(Session& session, ValueList elements, NodeRef list,
                   std::span<const NodeRef> nodes) {
  bool known = !session.checking_only();
  for (std::size_t i = 0; i < elements.size(); ++i) {
    if (elements[i].poisoned()) return {};
    known = known && elements[i].known;
    const NodeRef here = nodes.empty() ? list : nodes[i];
    if (!same_family(elements[0], elements[i]) && !is_ramp_stop(elements)) {
      Diagnostic diagnostic(DiagnosticKind::mixed_list, here.span(),
                            fmt::format("a list that starts with {} cannot hold {}",
                                        described(elements[0]), described(elements[i])));
      return session.error(std::move(diagnostic));
    }
    if (coerce_named(session, elements[i], {.subject = "[ ]", .node = here}).poisoned()) return {};
  }
  if (!unify(session, elements, list, nodes)) return {};
  Value result = make_list(std::move(elements));
  result.known = known;
  return result;
}

}  // namespace scenec::frontend
