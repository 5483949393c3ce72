// Functions of numbers: trigonometry, roots, bounds, rounding, and the pure random ones.
#include <fmt/format.h>

#include <array>
#include <cmath>
#include <limits>

#include "frontend/eval/builtins.hpp"
#include "frontend/eval/math.hpp"
#include "frontend/eval/noise.hpp"
#include "frontend/eval/operators.hpp"

namespace scenec::frontend {

namespace {

Value plain_result(Call& call, double (*compute)(double), Dimension dimension = {}) {
  if (!call.known) return make_unknown(Type::number, dimension);
  return finite_number(call.session, compute(call[0].real()), dimension, call.span(),
                       call.function);
}

// Beyond the limit neighbouring numbers are further apart than a turn can be told from another.
bool too_far_round(const Call& call) {
  return call.known && !(std::fabs(call[0].real()) <= angle_limit);
}
Value trigonometric(Call& call, double (*compute)(double)) {
  if (too_far_round(call)) return call.outside(0, "an angle of at most 2^48 rad");
  return plain_result(call, compute);
}
Value run_sin(Call& call) {
  return trigonometric(call, math::sine);
}
Value run_cos(Call& call) {
  return trigonometric(call, math::cosine);
}

Value run_tan(Call& call) {
  if (!call.known) return make_unknown(Type::number);
  const auto quarters = math::quarter_turns(call[0].real());
  if (quarters && *quarters % 2 != 0)
    return call.outside(0, "an angle other than 90 deg and its odd multiples");
  return quarters ? make_number(0) : trigonometric(call, tan);
}

Value inverse(Call& call, double (*compute)(double)) {
  if (call.known && !(std::fabs(call[0].real()) <= 1))
    return call.outside(0, "a value from -1 to 1");
  return plain_result(call, compute, dimension::angle);
}
Value run_asin(Call& call) {
  return inverse(call, asin);
}
Value run_acos(Call& call) {
  return inverse(call, acos);
}
Value run_atan(Call& call) {
  return plain_result(call, [](double x) { return atan2(x, 1); }, dimension::angle);
}

// The common dimension of all arguments; numbers only. nullopt: reported.
std::optional<Dimension> common(Call& call) {
  Value pattern = make_number(0);
  for (std::size_t i = 0; i < call.arguments.size(); ++i) {
    const Value& value = call[i];
    if (!call.has(i)) continue;
    if (!value.is_number()) {
      type_error(call.session, call.need(i), "a number", value);
      return std::nullopt;
    }
    // The first argument sets the pattern; a plain one later gives way to a quantity.
    const auto dimension =
        i == 0 ? std::optional(value.dimension) : common_dimension(pattern, value);
    if (!dimension) {
      mixed_dimensions(call.session, call.span(), call.function, pattern, value, {}, call.nodes[i]);
      return std::nullopt;
    }
    pattern = make_unknown(Type::number, *dimension);
    pattern.literal_zero = i == 0 && value.literal_zero;
  }
  return pattern.dimension;
}

bool all_integers(const Call& call) {
  for (const Value& value : call.arguments) {
    if (!value.is(Type::integer)) return false;
  }
  return true;
}

Value run_atan2(Call& call) {
  if (!common(call)) return {};
  if (!call.known) return make_unknown(Type::number, dimension::angle);
  if (call[0].real() == 0 && call[1].real() == 0) return call.outside(0, "`y` or `x` other than 0");
  return make_number(atan2(call[0].real(), call[1].real()), dimension::angle);
}

Value run_sqrt(Call& call) {
  Dimension dimension = call[0].dimension;
  for (auto exponent : {&Dimension::length, &Dimension::angle, &Dimension::time, &Dimension::power,
                        &Dimension::temperature}) {
    if (dimension.*exponent % 2 != 0) {
      return call.session.error(
          DiagnosticKind::dimension_mismatch, call.span(0),
          fmt::format("there is no square root of {}", with_article(call[0].dimension)));
    }
    dimension.*exponent = static_cast<std::int8_t>(dimension.*exponent / 2);
  }
  if (!call.known) return make_unknown(Type::number, dimension);
  if (call[0].real() < 0) return call.outside(0, "a value of at least 0");
  return make_number(std::sqrt(call[0].real()), dimension);
}

Value run_pow(Call& call) {
  Dimension dimension = call[0].dimension;
  if (!dimension.none()) {
    if (!call[1].is(Type::integer))
      return type_error(call.session, call.need(1), "an integer beside a quantity", call[1]);
    if (!call[1].known) return {};  // its dimension is not known before the call is expanded
    const std::int64_t power = call[1].integer;
    if (power < -20 || power > 20)
      return call.outside(1, "an exponent from -20 to 20 beside a quantity");
    for (auto exponent : {&Dimension::length, &Dimension::angle, &Dimension::time,
                          &Dimension::power, &Dimension::temperature}) {
      const std::int64_t raised = dimension.*exponent * power;
      if (raised < -100 || raised > 100) return call.outside(1, "a smaller exponent");
      dimension.*exponent = static_cast<std::int8_t>(raised);
    }
  }
  if (!call.known) return make_unknown(Type::number, dimension);
  const double base = call[0].real(), exponent = call[1].real();
  if (base == 0 && exponent < 0)
    return call.outside(0, "a value other than 0 for a negative exponent");
  if (base < 0 && exponent != std::floor(exponent))
    return call.outside(0, "a value of at least 0 for a broken exponent");
  return finite_number(call.session, pow(base, exponent), dimension, call.span(), call.function);
}

Value run_exp(Call& call) {
  return plain_result(call, exp);
}
Value run_log(Call& call) {
  if (call.known && !(call[0].real() > 0)) return call.outside(0, "a value above 0");
  return plain_result(call, log);
}

Value run_abs(Call& call) {
  const Value& x = call[0];
  if (!x.is_number()) return type_error(call.session, call.need(0), "a number", x);
  if (!x.known) return make_unknown(x.type, x.dimension);
  if (!x.is(Type::integer)) return make_number(std::fabs(x.real()), x.dimension);
  return x.integer < 0 ? negated(call.session, x, call.span()) : make_int(x.integer);
}

Value extreme(Call& call, bool smallest) {
  const auto dimension = common(call);
  if (!dimension) return {};
  const bool integers = all_integers(call);
  if (!call.known) return make_unknown(integers ? Type::integer : Type::number, *dimension);
  Value best = call[0];
  for (const Value& value : call.arguments) {
    const bool below = integers ? value.integer < best.integer : value.real() < best.real();
    const bool above = integers ? value.integer > best.integer : value.real() > best.real();
    if (smallest ? below : above) best = value;
  }
  return integers ? make_int(best.integer) : make_number(best.real(), *dimension);
}
Value run_min(Call& call) {
  return extreme(call, true);
}
Value run_max(Call& call) {
  return extreme(call, false);
}

Value run_clamp(Call& call) {
  const auto dimension = common(call);
  if (!dimension) return {};
  const bool integers = all_integers(call);
  if (!call.known) return make_unknown(integers ? Type::integer : Type::number, *dimension);
  if (call[1].real() > call[2].real()) return call.outside(1, "a value of at most `hi`");
  const Value& bound = call[0].real() < call[1].real()   ? call[1]
                       : call[0].real() > call[2].real() ? call[2]
                                                         : call[0];
  return integers ? make_int(bound.integer) : make_number(bound.real(), *dimension);
}

Value run_smoothstep(Call& call) {
  if (!common(call)) return {};
  if (!call.known) return make_unknown(Type::number);
  const double lo = call[0].real(), hi = call[1].real();
  if (!(lo < hi)) return call.outside(0, "a value below `hi`");
  const double t = std::fmin(1.0, std::fmax(0.0, (call[2].real() - lo) / (hi - lo)));
  return make_number(t * t * (3 - 2 * t));
}

Value rounded(Call& call, double (*compute)(double)) {
  if (!call.known) return make_unknown(Type::integer);
  if (call[0].is(Type::integer)) return make_int(call[0].integer);
  const double result = compute(call[0].real());
  constexpr double limit = 0x1p63;
  if (result >= -limit && result < limit) return make_int(static_cast<std::int64_t>(result));
  return call.session.error(DiagnosticKind::integer_overflow, call.span(),
                            "the result does not fit into a 64-bit integer");
}
Value run_floor(Call& call) {
  return rounded(call, std::floor);
}
Value run_ceil(Call& call) {
  return rounded(call, std::ceil);
}
Value run_round(Call& call) {
  return rounded(call, std::round);
}

Value run_hash(Call& call) {
  if (!call.known) return make_unknown(Type::integer);
  std::uint64_t state = 0;
  for (const Value& value : call.arguments)
    state = mixed_bits(state, static_cast<std::uint64_t>(value.integer));
  return make_int(static_cast<std::int64_t>(state >> 1));
}

Value run_random(Call& call) {
  if (!call.known) return make_unknown(Type::number);
  const auto seed = static_cast<std::uint64_t>(call[0].integer);
  return make_number(
      unit_interval(mixed_bits(mixed_bits(0, seed), static_cast<std::uint64_t>(call[1].integer))));
}

Value run_noise(Call& call) {
  const Value& p = call[0];
  if (!p.is_number() && !p.is_vector())
    return type_error(call.session, call.need(0), "a number or a list of 2 or 3 numbers", p);
  if (!p.dimension.none()) {
    return call.session.error(
        Diagnostic(DiagnosticKind::dimension_mismatch, call.span(0),
                   fmt::format("`p` of `noise` needs plain numbers; found {}", described(p)))
            .hint("divide by the size of a cell, such as `p / 0.1m`"));
  }
  if (!p.known) return make_unknown(Type::number);
  const std::array<double, 3> at = p.is_vector() ? p.n : std::array<double, 3>{p.real(), 0, 0};
  return make_number(gradient_noise(at));
}

constexpr std::array<Parameter, 1> angle_a{{{"a", Accept::angle}}};
constexpr std::array<Parameter, 1> plain_x{{{"x", Accept::plain}}};
constexpr std::array<Parameter, 1> any_x{{{"x"}}};
constexpr std::array<Parameter, 2> y_x{{{"y"}, {"x"}}};
constexpr std::array<Parameter, 2> x_y{{{"x"}, {"y", Accept::plain}}};
constexpr std::array<Parameter, 3> x_lo_hi{{{"x"}, {"lo"}, {"hi"}}};
constexpr std::array<Parameter, 3> lo_hi_x{{{"lo"}, {"hi"}, {"x"}}};
constexpr std::array<Parameter, 1> integer_x{{{"x", Accept::integer}}};
constexpr std::array<Parameter, 2> seed_i{{{"seed", Accept::integer}, {"i", Accept::integer}}};
constexpr std::array<Parameter, 1> any_p{{{"p"}}};

Value run_sqrt_checked(Call& call) {
  return call[0].is_number() ? run_sqrt(call)
                             : type_error(call.session, call.need(0), "a number", call[0]);
}
Value run_pow_checked(Call& call) {
  return call[0].is_number() ? run_pow(call)
                             : type_error(call.session, call.need(0), "a number", call[0]);
}

constexpr std::array<Builtin, 22> rows{{
    {"sin", angle_a, run_sin},      {"cos", angle_a, run_cos},
    {"tan", angle_a, run_tan},      {"asin", plain_x, run_asin},
    {"acos", plain_x, run_acos},    {"atan", plain_x, run_atan},
    {"atan2", y_x, run_atan2},      {"sqrt", any_x, run_sqrt_checked},
    {"pow", x_y, run_pow_checked},  {"exp", plain_x, run_exp},
    {"log", plain_x, run_log},      {"abs", any_x, run_abs},
    {"min", any_x, run_min, true},  {"max", any_x, run_max, true},
    {"clamp", x_lo_hi, run_clamp},  {"smoothstep", lo_hi_x, run_smoothstep},
    {"floor", plain_x, run_floor},  {"ceil", plain_x, run_ceil},
    {"round", plain_x, run_round},  {"hash", integer_x, run_hash, true},
    {"random", seed_i, run_random}, {"noise", any_p, run_noise},
}};

}  // namespace

std::span<const Builtin> number_functions() {
  return rows;
}

}  // namespace scenec::frontend
