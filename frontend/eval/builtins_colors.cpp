// Colours, and `mix`, which blends whatever can be blended.
#include <fmt/format.h>

#include <array>
#include <cmath>

#include "frontend/eval/builtins.hpp"
#include "frontend/eval/color.hpp"
#include "frontend/eval/operators.hpp"

namespace scenec::frontend {

namespace {

Value run_rgb(Call& call) {
  if (!call.known) return make_unknown(Type::color);
  return make_color(call[0].real(), call[1].real(), call[2].real());
}

Value run_srgb(Call& call) {
  if (!call.known) return make_unknown(Type::color);
  std::array<double, 3> linear{};
  for (std::size_t i = 0; i < 3; ++i) {
    const double encoded = call[i].real();
    if (!(encoded >= 0 && encoded <= 1)) return call.outside(i, "a value from 0 to 1");
    linear[i] = srgb_decoded(encoded);
  }
  return make_color(linear[0], linear[1], linear[2]);
}

Value run_gray(Call& call) {
  if (!call.known) return make_unknown(Type::color);
  return make_color(call[0].real(), call[0].real(), call[0].real());
}

Value run_blackbody(Call& call) {
  if (!call.known) return make_unknown(Type::color);
  const double kelvin = call[0].real();
  if (!(kelvin >= blackbody_coldest && kelvin <= blackbody_hottest))
    return call.outside(0, "500 K to 100000 K");
  const ir::Color color = blackbody(kelvin);
  return make_color(color.r, color.g, color.b);
}

bool is_texture_mix(const Call& call) {
  return call[0].is(Type::texture) || call[1].is(Type::texture) || call[2].is(Type::texture);
}

Value mixed_textures(Call& call) {
  for (std::size_t i = 0; i < 3; ++i) {
    const Accept accept = i == 2 ? Accept::number_input : Accept::color_input;
    if (accepted(call.session, call[i], accept, call.need(i)).poisoned()) return {};
  }
  const bool grey = is_grey(call[0]) && is_grey(call[1]);
  Value result = make_unknown(Type::texture);
  result.grey = grey;
  if (!call.known) return result;
  const ir::MixTexture mix{color_input(call[0]), color_input(call[1]), number_input(call[2])};
  return make_texture(call.session.builder.add_texture({mix, grey}), grey);
}

// a (1 - t) + b t, exact at both ends.
Value run_mix(Call& call) {
  if (is_texture_mix(call)) return mixed_textures(call);
  const Value t = coerce_quantity(call.session, call[2], dimension::none, call.need(2));
  if (t.poisoned()) return {};
  Value a = call[0], b = call[1];
  if (!a.is_number() && !a.is_vector() && !a.is(Type::color)) {
    return type_error(call.session, call.need(0), "a number, a vector, a color or a texture", a);
  }
  const Operation blend{
      .op = "+", .span = call.span(), .left = call.nodes[0], .right = call.nodes[1]};
  const Value pattern = arithmetic(call.session, type_of(a), type_of(b), blend);
  if (pattern.poisoned()) return {};
  if (!call.known) return pattern.is(Type::integer) ? make_unknown(Type::number) : pattern;
  const double weight = t.real();
  std::array<double, 3> n{};
  a.n[0] = a.is_number() ? a.real() : a.n[0];
  b.n[0] = b.is_number() ? b.real() : b.n[0];
  for (std::size_t i = 0; i < 3; ++i) {
    n[i] = weight == 1 ? b.n[i] : a.n[i] * (1 - weight) + b.n[i] * weight;
    if (!std::isfinite(n[i]))
      return finite_number(call.session, n[i], {}, call.span(), call.function);
  }
  if (pattern.is(Type::color)) return make_color(n[0], n[1], n[2]);
  if (pattern.is_vector()) return make_vector(pattern.vector_size(), n, pattern.dimension);
  return make_number(n[0], pattern.dimension);
}

constexpr std::array<Parameter, 3> rgb{
    {{"r", Accept::plain}, {"g", Accept::plain}, {"b", Accept::plain}}};
constexpr std::array<Parameter, 1> value{{{"v", Accept::plain}}};
constexpr std::array<Parameter, 1> temperature{{{"t", Accept::temperature}}};
constexpr std::array<Parameter, 3> a_b_t{{{"a"}, {"b"}, {"t"}}};

constexpr std::array<Builtin, 5> rows{{
    {"rgb", rgb, run_rgb},
    {"srgb", rgb, run_srgb},
    {"gray", value, run_gray},
    {"blackbody", temperature, run_blackbody},
    {"mix", a_b_t, run_mix},
}};

}  // namespace

std::span<const Builtin> color_functions() {
  return rows;
}

}  // namespace scenec::frontend
