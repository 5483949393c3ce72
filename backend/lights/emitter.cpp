#include "backend/lights/emitter.hpp"

#include <cmath>

#include "backend/math/frame.hpp"
#include "base/elementary.hpp"

namespace scenec::backend {
namespace {

// A cap is sampled by area, as its parts look much alike from everywhere; of deeper ones much would
// be turned away.
constexpr double deepest_cap = 0.5;  // of the radius

double sphere_area(double radius) {
  return 4 * pi * radius * radius;
}
bool is_sphere(const Emitter& e) {
  return e.shape == EmitterShape::sphere || e.shape == EmitterShape::cut_sphere;
}

// Coordinates of a point made of `origin` and three terms carry a few roundings of their largest.
Vector3 point_error(const Emitter& e) {
  return (abs(as_vector(e.origin)) + abs(e.a) + abs(e.b) + abs(e.c) +
          Vector3{e.radius, e.radius, e.radius}) *
         gamma(8);
}

AreaPoint ellipsoid_point(const Emitter& e, Sample2 u) {
  const UnitVector3 w = sample_uniform_sphere(u);
  const Vector3 n = cross(e.b, e.c) * w.x() + cross(e.c, e.a) * w.y() + cross(e.a, e.b) * w.z();
  // dA = |cofactor(M) w| dw.
  const double jacobian = length(n);
  return {e.origin + (e.a * w.x() + e.b * w.y() + e.c * w.z()), n,
          jacobian > 0 ? pdf_uniform_sphere() / jacobian : 0};
}

AreaPoint tube_point(const Emitter& e, Sample2 u) {
  const SinCos angle = sin_cos_of_turns(u.u);
  const Vector3 tangent = e.b * angle.cos - e.a * angle.sin;
  const Vector3 n = cross(tangent, e.c);
  const double jacobian = 2 * pi * length(n);
  return {e.origin + (e.a * angle.cos + e.b * angle.sin + e.c * u.v), n,
          jacobian > 0 ? 1 / jacobian : 0};
}

double solid_angle_pdf(double area_density, const Vector3& way, const UnitVector3& normal) {
  const double distance = length(way);
  return emitter_detail::solid_angle_pdf(area_density, distance,
                                         std::fabs(dot(way, normal)) / distance);
}

// Whether only the cap can be seen from there: beyond doubt, as a place on the plane itself may
// belong to either side.
bool sees_cap_only(const Emitter& e, const Point3& from) {
  if (e.shape != EmitterShape::cut_sphere) return false;
  const Vector3 p = as_vector(from);
  const double doubt = gamma(32) * (dot(abs(e.a), abs(p)) + std::fabs(e.b.y));
  return dot(e.a, p) - e.b.y > doubt;
}

// A sphere's area is that of the cylinder round it (Archimedes): a point of the cap lies as deep
// below its top as the square of a uniform point of the disk is far from the middle.
AreaPoint cap_point(const Emitter& e, Sample2 u) {
  const Sample2 disk = sample_concentric_disk(u);
  const double height = e.b.x;
  const double depth = height * (disk.u * disk.u + disk.v * disk.v);
  const double across = std::sqrt(height * (2 * e.radius - depth));
  const Frame frame = frame_about(UnitVector3::assume_unit(e.a));
  const Vector3 w = (frame.x.vector() * (across * disk.u) + frame.y.vector() * (across * disk.v) +
                     frame.z.vector() * (e.radius - depth)) /
                    e.radius;
  return {e.origin + w * e.radius, w, 1 / e.area};
}

AreaPoint sphere_point(const Emitter& e, Sample2 u) {
  const Vector3 w = sample_uniform_sphere(u).vector();
  return {e.origin + w * e.radius, w, 1 / sphere_area(e.radius)};
}

bool is_on_cap(const Emitter& e, const Point3& point) {
  return dot(e.a, point - e.origin) >= e.radius - e.b.x;
}

// Squared sine of the half angle of the cone a sphere fills; nothing when `from` is not outside.
std::optional<double> cone_of(const Emitter& e, const Point3& from) {
  const double sin2 = e.radius * e.radius / length_squared(e.origin - from);
  if (!(sin2 < 1)) return std::nullopt;
  return sin2;
}

EmitterSample cone_sample(const Emitter& e, const Point3& from, double sin2, Sample2 u) {
  const Vector3 axis = e.origin - from;
  const double distance2 = length_squared(axis);
  const Frame frame = frame_about(normalized(axis));
  const UnitVector3 local = sample_uniform_cone(u, sin2);
  EmitterSample s;
  s.wi = frame.world_of(local);
  const double sine2 = local.x() * local.x() + local.y() * local.y();
  const double along = std::sqrt(distance2) * local.z() -
                       std::sqrt(larger(0, e.radius * e.radius - distance2 * sine2));
  s.normal = normalized(from + s.wi.vector() * along - e.origin, -s.wi);
  s.point = e.origin + s.normal.vector() * e.radius;
  s.pdf = pdf_uniform_cone(sin2);
  return s;
}

}  // namespace

AreaPoint sample_area(const Emitter& e, Sample2 u) {
  switch (e.shape) {
    case EmitterShape::sphere:
      return sphere_point(e, u);
    case EmitterShape::cut_sphere:
      // The rest is left to chance.
      return cap_point(e, u);
    case EmitterShape::ellipsoid:
      return ellipsoid_point(e, u);
    case EmitterShape::tube:
      return tube_point(e, u);
    default:
      if (!(e.area > 0)) return {};
      return {emitter_detail::flat_point(e, u), e.normal, 1 / e.area};
  }
}

double area_pdf(const Emitter& e, const Point3& point, const UnitVector3& normal) {
  if (e.shape == EmitterShape::ellipsoid) {
    // |cofactor(M) w| from the unit normal n = cofactor(M) w / |...|: |M^T n| |cofactor(M) w| =
    // det.
    const double det = std::fabs(dot(cross(e.a, e.b), e.c));
    const Vector3 back{dot(e.a, normal), dot(e.b, normal), dot(e.c, normal)};
    return pdf_uniform_sphere() * length(back) / det;
  }
  if (e.shape == EmitterShape::tube) {
    // The angle of the point in the base's own coordinates.
    const Vector3 n = cross(e.a, e.b);
    const double scale = dot(n, e.c);
    const Vector3 p = point - e.origin;
    const double x = dot(cross(e.b, e.c), p) / scale;
    const double y = dot(cross(e.c, e.a), p) / scale;
    const double r = std::sqrt(x * x + y * y);
    return 1 / (2 * pi * length(cross(e.b * (x / r) - e.a * (y / r), e.c)));
  }
  if (e.shape == EmitterShape::cut_sphere && !is_on_cap(e, point)) return 0;
  return 1 / e.area;
}

void cut_by_plane(Emitter& e, const Vector3& normal, double offset) {
  if (!is_sphere(e)) return;
  const double size = length(normal);
  const double from_center = (offset - dot(normal, as_vector(e.origin))) / size;
  const double away = std::fabs(from_center);
  // Enlarged by what rounding may have taken from it: no light may be left out.
  const double doubt =
      gamma(32) * (max_abs(as_vector(e.origin)) + std::fabs(offset / size) + e.radius);
  const double height = e.radius - away + doubt;
  if (!(height > doubt) || !(height <= deepest_cap * e.radius)) return;
  if (e.shape == EmitterShape::cut_sphere && e.b.x <= height) return;
  const double side = from_center > 0 ? 1 : -1;
  e.shape = EmitterShape::cut_sphere;
  e.a = normalized(normal * side).vector();
  e.b = {height, offset / size * side, 0};
}

void measure(Emitter& e) {
  switch (e.shape) {
    case EmitterShape::triangle:
      e.area = length(cross(e.a, e.b)) / 2;
      break;
    case EmitterShape::parallelogram:
      e.area = length(cross(e.a, e.b));
      break;
    case EmitterShape::ellipse:
      e.area = pi * length(cross(e.a, e.b));
      break;
    case EmitterShape::sphere:
      e.area = sphere_area(e.radius);
      break;
    case EmitterShape::cut_sphere:
      e.area = 2 * pi * e.radius * e.b.x;
      break;
    case EmitterShape::ellipsoid:
    case EmitterShape::tube: {
      // Only weighs the choice between lights: the mean over a fixed grid will do.
      double sum = 0;
      for (int i = 0; i < 64; ++i) {
        const AreaPoint p = sample_area(e, {(i % 8 + 0.5) / 8, (i / 8 + 0.5) / 8});
        if (p.pdf > 0) sum += 1 / p.pdf;
      }
      e.area = sum / 64;
      break;
    }
  }
  if (!std::isfinite(e.area)) e.area = 0;
  e.error = point_error(e);
  if (is_flat(e.shape)) {
    const Vector3 n = cross(e.a, e.b);
    e.normal = normalized(e.flipped ? -n : n);
  }
}

namespace emitter_detail {

bool sample_curved(const Emitter& e, const Point3& from, Sample2 u, EmitterSample& out) {
  const bool cap = sees_cap_only(e, from);
  if (!cap && is_sphere(e)) {
    if (const auto sin2 = cone_of(e, from)) {
      out = cone_sample(e, from, *sin2, u);
      out.error = e.error;
      return true;
    }
  }
  // A cut sphere is a whole one from where more than its cap may be seen.
  const AreaPoint p = !cap && is_sphere(e) ? sphere_point(e, u) : sample_area(e, u);
  const Vector3 way = p.point - from;
  if (!(p.pdf > 0) || !(length_squared(way) > 0)) return false;
  out.point = p.point;
  out.error = e.error;
  out.normal = normalized(e.flipped ? -p.normal : p.normal);
  out.wi = normalized(way);
  out.pdf = backend::solid_angle_pdf(p.pdf, way, out.normal);
  return out.pdf > 0;
}

double pdf_curved(const Emitter& e, const Point3& from, const Point3& point,
                  const UnitVector3& normal) {
  if (sees_cap_only(e, from)) {
    return is_on_cap(e, point) ? backend::solid_angle_pdf(1 / e.area, point - from, normal) : 0;
  }
  if (is_sphere(e)) {
    if (const auto sin2 = cone_of(e, from)) return pdf_uniform_cone(*sin2);
    return backend::solid_angle_pdf(1 / sphere_area(e.radius), point - from, normal);
  }
  return backend::solid_angle_pdf(area_pdf(e, point, normal), point - from, normal);
}

}  // namespace emitter_detail

}  // namespace scenec::backend
