// Transforms, profile curves and pixel filters.
#include <fmt/format.h>

#include <array>
#include <cmath>

#include "frontend/eval/builtins.hpp"
#include "frontend/eval/math.hpp"
#include "ir/render_settings.hpp"

namespace scenec::frontend {

namespace {

using Vector = std::array<double, 3>;

double dot(const Vector& a, const Vector& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}
Vector cross(const Vector& a, const Vector& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}
Vector scaled(const Vector& v, double factor) {
  return {v[0] * factor, v[1] * factor, v[2] * factor};
}

// The unit vector, or nullopt (reported) of a zero one. Scaling first keeps the squares in range.
std::optional<Vector> unit(Call& call, std::size_t i, const Vector& v) {
  const double largest = std::fmax(std::fabs(v[0]), std::fmax(std::fabs(v[1]), std::fabs(v[2])));
  if (largest == 0) {
    call.session.error(DiagnosticKind::zero_direction, call.span(i),
                       fmt::format("{} is zero; needs a direction", call.need(i).text()));
    return std::nullopt;
  }
  const Vector near_one = scaled(v, 1 / largest);
  return scaled(near_one, 1 / std::sqrt(dot(near_one, near_one)));
}

ir::Transform from_columns(const Vector& x, const Vector& y, const Vector& z,
                           const Vector& origin) {
  return {{x[0], y[0], z[0], origin[0], x[1], y[1], z[1], origin[1], x[2], y[2], z[2], origin[2], 0,
           0, 0, 1}};
}

Value run_move(Call& call) {
  if (!call.known) return make_unknown(Type::transform);
  return make_transform(from_columns({1, 0, 0}, {0, 1, 0}, {0, 0, 1}, call[0].n));
}

Value run_scale(Call& call) {
  const Value& s = call[0];
  const bool fits = (s.is_number() || s.is(Type::vec3)) && s.dimension.none();
  if (!fits) return type_error(call.session, call.need(0), "a number or a list of 3 numbers", s);
  if (!s.known) return make_unknown(Type::transform);
  const Vector f = s.is_number() ? Vector{s.real(), s.real(), s.real()} : s.n;
  if (f[0] == 0 || f[1] == 0 || f[2] == 0) {
    return call.session.error(DiagnosticKind::singular_transform, call.span(0),
                              "a scale of 0 cannot be inverted");
  }
  return make_transform(from_columns({f[0], 0, 0}, {0, f[1], 0}, {0, 0, f[2]}, {0, 0, 0}));
}

// Rotation about a unit axis (Rodrigues).
ir::Transform rotation(const Vector& axis, double angle) {
  const double c = math::cosine(angle), s = math::sine(angle);
  const auto column = [&](const Vector& e) {
    const Vector turned = cross(axis, e);
    const double along = dot(axis, e) * (1 - c);
    return Vector{e[0] * c + turned[0] * s + axis[0] * along + 0.0,
                  e[1] * c + turned[1] * s + axis[1] * along + 0.0,
                  e[2] * c + turned[2] * s + axis[2] * along + 0.0};
  };
  return from_columns(column({1, 0, 0}), column({0, 1, 0}), column({0, 0, 1}), {0, 0, 0});
}

Value turned(Call& call, const Vector& axis) {
  if (!call.known) return make_unknown(Type::transform);
  return make_transform(rotation(axis, call[0].real()));
}
Value run_rotate_x(Call& call) {
  return turned(call, {1, 0, 0});
}
Value run_rotate_y(Call& call) {
  return turned(call, {0, 1, 0});
}
Value run_rotate_z(Call& call) {
  return turned(call, {0, 0, 1});
}

Value run_rotate(Call& call) {
  if (!call.known) return make_unknown(Type::transform);
  const auto axis = unit(call, 0, call[0].n);
  return axis ? make_transform(rotation(*axis, call[1].real())) : Value{};
}

// Moves the origin to `from` and turns -z towards `to`, y towards `up`: how a camera would stand.
Value run_look(Call& call) {
  if (!call.known) return make_unknown(Type::transform);
  const Vector &from = call[0].n, &to = call[1].n;
  const auto back = unit(call, 1, {from[0] - to[0], from[1] - to[1], from[2] - to[2]});
  const auto up = unit(call, 2, call.has(2) ? call[2].n : Vector{0, 1, 0});
  if (!back || !up) return {};
  const Vector side = cross(*up, *back);
  constexpr double parallel = 0x1p-40;  // sine below which rounding decides the sideways direction
  if (dot(side, side) < parallel * parallel) {
    return call.session.error(DiagnosticKind::outside_domain, call.span(2),
                              "`up` of `look` is parallel to the direction of view");
  }
  const Vector right = *unit(call, 2, side);
  return make_transform(from_columns(right, cross(*back, right), *back, from));
}

Value run_matrix(Call& call) {
  const Value& list = call[0];
  if (!call.known && (list.heap == nullptr || list.elements().size() != 16))
    return make_unknown(Type::transform);
  if (element_count(list) != 16)
    return type_error(call.session, call.need(0), "16 numbers, row by row", list);
  ir::Transform transform;
  for (std::size_t i = 0; i < 16; ++i) {
    const Value element = element_of(list, i);
    if (!element.is_number() || !element.dimension.none()) {
      return type_error(call.session, call.need(0), "16 plain numbers, row by row", list);
    }
    transform.m[i] = element.real();
  }
  if (!call.known) return make_unknown(Type::transform);
  if (transform.m[12] != 0 || transform.m[13] != 0 || transform.m[14] != 0 ||
      transform.m[15] != 1) {
    return call.session.error(DiagnosticKind::matrix_not_affine, call.span(0),
                              "the last row of the matrix must be 0, 0, 0, 1");
  }
  return make_transform(transform);
}

// ---- curves

Value curve(Call& call, ir::CurveKind kind, bool (*fits)(std::size_t), std::string_view wanted) {
  ir::Curve result;
  result.kind = kind;
  result.clamped = !call.has(1) || call[1].boolean();
  const Value& list = call[0];
  for (std::size_t i = 0; i < element_count(list); ++i) {
    const Value point =
        coerce_vector(call.session, element_of(list, i), 2, dimension::length, call.need(0));
    if (point.poisoned()) return {};
    result.points.push_back({point.n[0], point.n[1]});
  }
  if (!call.known) return make_unknown(Type::curve);
  if (!fits(result.points.size())) {
    return call.session.error(
        DiagnosticKind::curve_points, call.span(0),
        fmt::format("`{}` needs {} points; found {}", call.function, wanted, result.points.size()));
  }
  return make_curve(std::move(result));
}

Value run_polyline(Call& call) {
  return curve(call, ir::CurveKind::polyline, [](std::size_t n) { return n >= 2; }, "at least 2");
}
Value run_bezier(Call& call) {
  return curve(
      call, ir::CurveKind::bezier, [](std::size_t n) { return n >= 2 && n <= 16; }, "2 to 16");
}
Value run_beziers(Call& call) {
  return curve(
      call, ir::CurveKind::beziers, [](std::size_t n) { return n >= 4 && n % 3 == 1; },
      "3k + 1 (4, 7, 10 and so on)");
}
Value run_bspline(Call& call) {
  return curve(call, ir::CurveKind::bspline, [](std::size_t n) { return n >= 4; }, "at least 4");
}

// ---- pixel filters: each name of the enumeration is a function of the radius

Value filter(Call& call, ir::FilterKind kind) {
  if (!call.known) return make_unknown(Type::filter);
  constexpr double widest = 32;  // pixels; wider is a blur of the whole picture
  const double radius = call.has(0) ? call[0].real() : ir::usual_radius(kind);
  if (!(radius > 0 && radius <= widest))
    return call.outside(0, "a radius above 0 and of at most 32 pixels");
  return make_filter(static_cast<std::int64_t>(kind), radius);
}
template <ir::FilterKind kind>
Value run_filter(Call& call) {
  return filter(call, kind);
}

constexpr std::array<Parameter, 1> offset_v{{{"v", Accept::offset}}};
constexpr std::array<Parameter, 1> any_s{{{"s"}}};
constexpr std::array<Parameter, 1> angle_a{{{"a", Accept::angle}}};
constexpr std::array<Parameter, 2> axis_a{{{"axis", Accept::vec3}, {"a", Accept::angle}}};
constexpr std::array<Parameter, 3> look{
    {{"from", Accept::offset}, {"to", Accept::offset}, {"up", Accept::vec3, false}}};
constexpr std::array<Parameter, 1> rows16{{{"rows", Accept::list}}};
constexpr std::array<Parameter, 1> points{{{"points", Accept::list}}};
constexpr std::array<Parameter, 2> points_clamped{
    {{"points", Accept::list}, {"clamped", Accept::boolean, false}}};
constexpr std::array<Parameter, 1> radius{{{"radius", Accept::plain, false}}};
constexpr auto filter_names = ir::EnumNames<ir::FilterKind>::names;

constexpr std::array<Builtin, 17> rows{{
    {"move", offset_v, run_move},
    {"scale", any_s, run_scale},
    {"rotate_x", angle_a, run_rotate_x},
    {"rotate_y", angle_a, run_rotate_y},
    {"rotate_z", angle_a, run_rotate_z},
    {"rotate", axis_a, run_rotate},
    {"look", look, run_look},
    {"matrix", rows16, run_matrix},
    {"polyline", points, run_polyline},
    {"bezier", points, run_bezier},
    {"beziers", points, run_beziers},
    {"bspline", points_clamped, run_bspline},
    {filter_names[0], radius, run_filter<ir::FilterKind::tent>},
    {filter_names[1], radius, run_filter<ir::FilterKind::box>},
    {filter_names[2], radius, run_filter<ir::FilterKind::gaussian>},
    {filter_names[3], radius, run_filter<ir::FilterKind::mitchell>},
    {filter_names[4], radius, run_filter<ir::FilterKind::blackman_harris>},
}};

}  // namespace

std::span<const Builtin> geometry_functions() {
  return rows;
}

}  // namespace scenec::frontend
