#include "frontend/lower/placement.hpp"

#include <fmt/format.h>

#include <cmath>
#include <optional>

#include "base/elementary.hpp"
#include "frontend/check/invertible.hpp"

namespace scenec::frontend {

namespace {

void unsuitable(Session& session, Span span, std::string_view subject, std::string_view needs) {
  session.error(
      DiagnosticKind::unsuitable_transform, span,
      fmt::format("{} cannot take this transform of its group; needs {}", subject, needs));
}

void normalise_zero(double& value) {
  value += 0.0;
}

ir::Point3 moved(const ir::Transform& transform, const ir::Point3& point) {
  ir::Point3 result = ir::apply(transform, point);
  normalise_zero(result.x), normalise_zero(result.y), normalise_zero(result.z);
  return result;
}
template <class V>
V turned(const ir::Transform& transform, const V& v) {
  const ir::Vec3 result = ir::apply_linear(transform, {v.x, v.y, v.z});
  return {result.x + 0.0, result.y + 0.0, result.z + 0.0};
}

// The angle of a rotation about +y (with uniform scale), or nullopt.
std::optional<double> turn_about_y(const ir::Transform& transform) {
  const auto& m = transform.m;
  if (m[1] != 0 || m[4] != 0 || m[6] != 0 || m[9] != 0 || !(m[5] > 0)) return std::nullopt;
  if (!uniform_scale(transform) || ir::determinant(transform) < 0) return std::nullopt;
  return atan2(m[2], m[0]);
}

// One overload a kind: moves it, or says what it needs.
using Problem = std::optional<std::string_view>;
constexpr std::string_view similarity = "moves, rotations and uniform scaling";

Problem bake_kind(const ir::Transform& t, ir::PointLight& light) {
  light.position = moved(t, light.position);
  return {};
}
Problem bake_kind(const ir::Transform& t, ir::SpotLight& light) {
  if (!uniform_scale(t)) return similarity;
  light.position = moved(t, light.position);
  light.direction = turned(t, light.direction);
  return {};
}
Problem bake_kind(const ir::Transform& t, ir::DirectionalLight& light) {
  light.direction = turned(t, light.direction);
  return {};
}
Problem bake_kind(const ir::Transform& t, ir::SphereLight& light) {
  const auto scale = uniform_scale(t);
  if (!scale) return similarity;
  light.center = moved(t, light.center);
  light.radius.value *= *scale;
  return {};
}
Problem bake_kind(const ir::Transform& t, ir::QuadLight& light) {
  light.corner = moved(t, light.corner);
  light.edge_u = turned(t, light.edge_u);
  light.edge_v = turned(t, light.edge_v);
  // Mirrored edges would turn the emitting side (edge_u x edge_v) round.
  if (ir::determinant(t) < 0) std::swap(light.edge_u, light.edge_v);
  return {};
}
Problem bake_kind(const ir::Transform& t, ir::DiskLight& light) {
  const auto scale = uniform_scale(t);
  if (!scale) return similarity;
  light.center = moved(t, light.center);
  light.normal = turned(t, light.normal);
  light.radius.value *= *scale;
  return {};
}
Problem bake_kind(const ir::Transform& t, ir::EnvironmentLight& light) {
  const auto turn = turn_about_y(t);
  if (!turn) return "rotations about the y axis";
  light.rotation.value += *turn;
  return {};
}

void scale_lens(double, ir::Pinhole&) {}
void scale_lens(double, ir::Panorama&) {}
void scale_lens(double scale, ir::Orthographic& camera) {
  camera.height.value *= scale;
}
void scale_lens(double scale, ir::ThinLens& camera) {
  camera.focus.distance.value *= scale;
  if (camera.aperture) camera.aperture->value *= scale;
  if (camera.f_stop)
    *camera.f_stop /= scale;  // the lens grows with the scene, the angle of view does not
}

}  // namespace

bool bake(Session& session, const ir::Transform& transform, ir::LightKind& light, Span span) {
  if (transform.is_identity()) return true;
  const Problem problem = std::visit([&](auto& kind) { return bake_kind(transform, kind); }, light);
  if (problem) unsuitable(session, span, "this light", *problem);
  return !problem;
}

bool bake(Session& session, const ir::Transform& transform, ir::CameraKind& camera, Span span) {
  if (transform.is_identity()) return true;
  const auto scale = uniform_scale(transform);
  if (!scale || ir::determinant(transform) < 0) {
    unsuitable(session, span, "a camera", "moves, rotations and uniform scaling without mirroring");
    return false;
  }
  std::visit(
      [&](auto& kind) {
        kind.eye = moved(transform, kind.eye);
        if (kind.aim) kind.aim = moved(transform, *kind.aim);
        if (kind.direction) kind.direction = turned(transform, *kind.direction);
        kind.up = turned(transform, kind.up);
        scale_lens(*scale, kind);
      },
      camera);
  return true;
}

}  // namespace scenec::frontend
