// Functions of vectors.
#include <fmt/format.h>

#include <array>
#include <cmath>

#include "frontend/eval/builtins.hpp"
#include "frontend/eval/math.hpp"
#include "frontend/eval/operators.hpp"

namespace scenec::frontend {

namespace {

double length_of(const Value& v) {
  return math::length({v.n[0], v.n[1], v.is(Type::vec3) ? v.n[2] : 0.0});
}

Value run_length(Call& call) {
  if (!call.known) return make_unknown(Type::number, call[0].dimension);
  return finite_number(call.session, length_of(call[0]), call[0].dimension, call.span(),
                       call.function);
}

Value run_normalize(Call& call) {
  const Value& v = call[0];
  if (!v.known) return make_unknown(v.type);
  const double length = length_of(v);
  if (length == 0 || !std::isfinite(length)) {
    return call.session.error(
        DiagnosticKind::outside_domain, call.span(0),
        length == 0 ? "a zero vector has no direction" : "the vector is too long to be normalised");
  }
  return make_vector(v.vector_size(), {v.n[0] / length, v.n[1] / length, v.n[2] / length});
}

// The dimension of a product of components, as the operator `*` finds it.
Value component_product(Call& call) {
  const Value a = make_unknown(Type::number, call[0].dimension);
  const Value b = make_unknown(Type::number, call[1].dimension);
  return arithmetic(call.session, a, b, {.op = "*", .span = call.span(), .left = {}, .right = {}});
}

Value run_dot(Call& call) {
  const Value &a = call[0], &b = call[1];
  if (a.type != b.type) return type_error(call.session, call.need(1), "a vector as long as `a`", b);
  const Value product = component_product(call);
  if (!call.known || product.poisoned()) return product;
  const double sum = a.n[0] * b.n[0] + a.n[1] * b.n[1] + (a.is(Type::vec3) ? a.n[2] * b.n[2] : 0.0);
  return finite_number(call.session, sum, product.dimension, call.span(), call.function);
}

Value run_cross(Call& call) {
  const Value &a = call[0], &b = call[1];
  const Value product = component_product(call);
  if (product.poisoned()) return {};
  if (!call.known) return make_unknown(Type::vec3, product.dimension);
  const std::array<double, 3> n{a.n[1] * b.n[2] - a.n[2] * b.n[1],
                                a.n[2] * b.n[0] - a.n[0] * b.n[2],
                                a.n[0] * b.n[1] - a.n[1] * b.n[0]};
  for (double component : n) {
    if (!std::isfinite(component))
      return finite_number(call.session, component, {}, call.span(), call.function);
  }
  return make_vector(3, n, product.dimension);
}

constexpr std::array<Parameter, 1> one{{{"v", Accept::vector}}};
constexpr std::array<Parameter, 2> two{{{"a", Accept::vector}, {"b", Accept::vector}}};
constexpr std::array<Parameter, 2> two_vec3{{{"a", Accept::vec3}, {"b", Accept::vec3}}};

constexpr std::array<Builtin, 4> rows{{
    {"length", one, run_length},
    {"normalize", one, run_normalize},
    {"dot", two, run_dot},
    {"cross", two_vec3, run_cross},
}};

}  // namespace

std::span<const Builtin> vector_functions() {
  return rows;
}

}  // namespace scenec::frontend
