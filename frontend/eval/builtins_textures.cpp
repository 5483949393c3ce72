// Textures: each call adds a node to the scene's table of textures.
#include <fmt/format.h>

#include <array>

#include "frontend/eval/builtins.hpp"
#include "frontend/eval/operators.hpp"

namespace scenec::frontend {

namespace {

Value added(Call& call, ir::TextureKind kind, bool grey) {
  return make_texture(call.session.builder.add_texture({std::move(kind), grey}), grey);
}

Value unknown_texture(bool grey) {
  Value value = make_unknown(Type::texture);
  value.grey = grey;
  return value;
}

template <ir::NamedEnum E>
bool choose(Call& call, std::size_t i, E& out) {
  if (!call.has(i) || !call[i].known) return true;
  const auto index = choice_of(call.session, call[i], ir::EnumNames<E>::names, call.need(i));
  if (index) out = static_cast<E>(*index);
  return index.has_value();
}

// Number i, or its default; nullopt (reported) outside of (0, inf).
bool positive(Call& call, std::size_t i, double& out) {
  if (!call.has(i) || !call[i].known) return true;
  out = call[i].real();
  if (out > 0) return true;
  call.outside(i, "a value above 0");
  return false;
}

Value run_image(Call& call) {
  ir::ImageTexture image;
  const bool wrap = choose(call, 1, image.wrap), filter = choose(call, 2, image.filter),
             encoding = choose(call, 3, image.encoding);
  if (!wrap || !filter || !encoding) return {};
  if (!call.known || call.session.checking_only()) return unknown_texture(false);
  const Value& file = call[0];
  image.file = call.session.asset(file.text(), file.id<SourceFile>(), call.span(0));
  if (!image.file.valid()) return {};
  if (call.has(4)) image.scale = {call[4].n[0], call[4].n[1]};
  return added(call, image, false);
}

Value run_checker(Call& call) {
  const bool grey = is_grey(call[0]) && is_grey(call[1]);
  ir::CheckerTexture checker;
  if (!positive(call, 2, checker.scale)) return {};
  if (!call.known) return unknown_texture(grey);
  checker.a = color_input(call[0]);
  checker.b = color_input(call[1]);
  return added(call, checker, grey);
}

Value run_fractal(Call& call) {
  const bool grey = (!call.has(2) || is_grey(call[2])) && (!call.has(3) || is_grey(call[3]));
  ir::FractalTexture fractal;
  if (!positive(call, 0, fractal.scale)) return {};
  if (!call.known) return unknown_texture(grey);
  constexpr std::int64_t most_octaves = 32;  // 2^32 finer than the coarsest: below any pixel
  if (call.has(1)) fractal.octaves = call[1].integer;
  if (fractal.octaves < 1 || fractal.octaves > most_octaves) return call.outside(1, "1 to 32");
  if (call.has(2)) fractal.a = color_input(call[2]);
  if (call.has(3)) fractal.b = color_input(call[3]);
  return added(call, fractal, grey);
}

// One stop `[position, colour]`; a grey one is written as a number.
bool add_stop(Call& call, const Value& stop, ir::RampTexture& ramp, bool& grey) {
  const bool numbers = stop.is(Type::vec2) && stop.dimension.none();
  const bool pair = stop.is(Type::list) && element_count(stop) == 2 &&
                    element_of(stop, 0).is_number() && element_of(stop, 0).dimension.none() &&
                    element_of(stop, 1).is(Type::color);
  if (!numbers && !pair) {
    type_error(call.session, call.need(1), "stops such as `[0.5, white]`", stop);
    return false;
  }
  const Value color = element_of(stop, 1);
  ramp.stops.emplace_back(element_of(stop, 0).real(), color_input(color).value);
  grey = grey && numbers;
  return true;
}

Value run_ramp(Call& call) {
  ir::RampTexture ramp;
  bool grey = true;
  const std::size_t count = element_count(call[1]);
  // Two or three stops of numbers are a list of vectors; a lone vec2 would be one number each.
  for (std::size_t i = 0; i < count && call[1].is(Type::list); ++i) {
    if (element_of(call[1], i).poisoned()) return {};
    if (!add_stop(call, element_of(call[1], i), ramp, grey)) return {};
  }
  if (!call.known) return unknown_texture(grey);
  bool ascending = !ramp.stops.empty();
  for (std::size_t i = 1; i < ramp.stops.size(); ++i)
    ascending = ascending && ramp.stops[i - 1].first < ramp.stops[i].first;
  if (!ascending) {
    return call.session.error(DiagnosticKind::ramp_stops, call.span(1),
                              ramp.stops.empty()
                                  ? "`ramp` needs at least one stop such as `[0, white]`"
                                  : "the positions of the stops of `ramp` must ascend");
  }
  ramp.t = number_input(call[0]);
  return added(call, ramp, grey);
}

Value run_grid(Call& call) {
  const bool grey = is_grey(call[0]) && is_grey(call[1]);
  ir::GridTexture grid;
  if (!positive(call, 2, grid.scale) || !positive(call, 3, grid.width)) return {};
  if (grid.width > 1) return call.outside(3, "a value of at most 1 (one cell)");
  if (!call.known) return unknown_texture(grey);
  grid.line = color_input(call[0]);
  grid.fill = color_input(call[1]);
  return added(call, grid, grey);
}

constexpr std::array<Parameter, 5> image{{{"file", Accept::string},
                                          {"wrap", Accept::choice, false},
                                          {"filter", Accept::choice, false},
                                          {"encoding", Accept::choice, false},
                                          {"scale", Accept::vec2, false}}};
constexpr std::array<Parameter, 3> checker{
    {{"a", Accept::color_input}, {"b", Accept::color_input}, {"scale", Accept::plain, false}}};
constexpr std::array<Parameter, 4> fractal{{{"scale", Accept::plain},
                                            {"octaves", Accept::integer, false},
                                            {"a", Accept::color_input, false},
                                            {"b", Accept::color_input, false}}};
constexpr std::array<Parameter, 2> ramp{{{"t", Accept::number_input}, {"stops", Accept::list}}};
constexpr std::array<Parameter, 4> grid{{{"line", Accept::color_input},
                                         {"fill", Accept::color_input},
                                         {"scale", Accept::plain, false},
                                         {"width", Accept::plain, false}}};

constexpr std::array<Builtin, 5> rows{{
    {"image", image, run_image},
    {"checker", checker, run_checker},
    {"fractal", fractal, run_fractal},
    {"ramp", ramp, run_ramp},
    {"grid", grid, run_grid},
}};

}  // namespace

std::span<const Builtin> texture_functions() {
  return rows;
}

}  // namespace scenec::frontend
