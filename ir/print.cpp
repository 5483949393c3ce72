#include "ir/print.hpp"

#include <fmt/format.h>

#include <cmath>

#include "base/text.hpp"

namespace scenec::ir {

std::string value_text(bool value) {
  return value ? "true" : "false";
}
std::string value_text(std::int64_t value) {
  return fmt::format("{}", value);
}
std::string value_text(std::uint32_t value) {
  return fmt::format("{}", value);
}

std::string value_text(double value) {
  // Every integer below 2^53 is exact as a double; above it the exponent form is the shorter one.
  constexpr double exact_integers = 9007199254740992.0;
  if (std::trunc(value) == value && std::abs(value) < exact_integers) {
    return fmt::format("{}", static_cast<std::int64_t>(value));
  }
  return number_text(value);
}

std::string value_text(const std::string& value) {
  return quoted_string(value);
}

std::string value_text(Angle value) {
  return value_text(value.value) + "rad";
}

namespace {
std::string triple(const char* open, double a, double b, double c, const char* close) {
  return fmt::format("{}{}, {}, {}{}", open, value_text(a), value_text(b), value_text(c), close);
}
}  // namespace

std::string value_text(const Vec2& v) {
  return fmt::format("[{}, {}]", value_text(v.x), value_text(v.y));
}
std::string value_text(const Vec3& v) {
  return triple("[", v.x, v.y, v.z, "]");
}
std::string value_text(const Direction& v) {
  return triple("[", v.x, v.y, v.z, "]");
}
std::string value_text(const Point3& v) {
  return triple("[", v.x, v.y, v.z, "]");
}
std::string value_text(const Color& c) {
  return triple("rgb(", c.r, c.g, c.b, ")");
}

std::string value_text(const Transform& t) {
  return "matrix(" + list_text(t.m) + ")";
}

std::string value_text(const Curve& c) {
  static constexpr std::array<std::string_view, 4> functions{"polyline", "bezier", "beziers",
                                                             "bspline"};
  std::string text(functions[static_cast<std::size_t>(c.kind)]);
  text += "(" + list_text(c.points);
  if (c.kind == CurveKind::bspline && !c.clamped) text += ", clamped = false";
  return text + ")";
}

std::string value_text(const MeshNormals& n) {
  return n.list.empty() ? value_text(n.mode) : list_text(n.list);
}

std::string value_text(const FocusDistance& f) {
  return f.at_aim ? ".aim" : value_text(f.distance);
}

std::string value_text(const PixelFilter& f) {
  return fmt::format("{}({})", EnumNames<FilterKind>::names[static_cast<std::size_t>(f.kind)],
                     value_text(f.radius));
}

std::string value_text(const ImageSize& s) {
  return fmt::format("[{}, {}]", s.width, s.height);
}
std::string value_text(const Region& r) {
  return fmt::format("[{}, {}, {}, {}]", r.x0, r.y0, r.x1, r.y1);
}

}  // namespace scenec::ir
