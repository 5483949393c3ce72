#include "backend/lights/emitter.hpp"

#include <cmath>

#include "backend/math/frame.hpp"
#include "base/elementary.hpp"

namespace scenec::backend {
namespace {

// Coordinates of a point made of `origin` and three terms carry a few roundings of their largest.
Vector3 point_error(const Emitter& e) {
  return (abs(as_vector(e.origin)) + abs(e.a) + abs(e.b) + abs(e.c) +
          Vector3{e.radius, e.radius, e.radius}) *
         gamma(8);
}

struct AreaPoint {
  Point3 point;
  Vector3 normal;  // not unit
  double pdf = 0;  // per area
};

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

AreaPoint area_point(const Emitter& e, Sample2 u) {
  switch (e.shape) {
    case EmitterShape::sphere: {
      const Vector3 w = sample_uniform_sphere(u).vector();
      return {e.origin + w * e.radius, w, 1 / e.area};
    }
    case EmitterShape::ellipsoid:
      return ellipsoid_point(e, u);
    case EmitterShape::tube:
      return tube_point(e, u);
    default:  // flat shapes are sampled in the header
      return {};
  }
}

// The density per area at a point the emitter was hit at.
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
  return 1 / e.area;
}

double solid_angle_pdf(double area_density, const Vector3& way, const UnitVector3& normal) {
  const double distance = length(way);
  return emitter_detail::solid_angle_pdf(area_density, distance,
                                         std::fabs(dot(way, normal)) / distance);
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
      e.area = 4 * pi * e.radius * e.radius;
      break;
    case EmitterShape::ellipsoid:
    case EmitterShape::tube: {
      // Only weighs the choice between lights: the mean over a fixed grid will do.
      double sum = 0;
      for (int i = 0; i < 64; ++i) {
        const AreaPoint p = area_point(e, {(i % 8 + 0.5) / 8, (i / 8 + 0.5) / 8});
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
  if (e.shape == EmitterShape::sphere) {
    if (const auto sin2 = cone_of(e, from)) {
      out = cone_sample(e, from, *sin2, u);
      out.error = e.error;
      return true;
    }
  }
  const AreaPoint p = area_point(e, u);
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
  if (e.shape == EmitterShape::sphere) {
    if (const auto sin2 = cone_of(e, from)) return pdf_uniform_cone(*sin2);
  }
  return backend::solid_angle_pdf(area_pdf(e, point, normal), point - from, normal);
}

}  // namespace emitter_detail

}  // namespace scenec::backend
