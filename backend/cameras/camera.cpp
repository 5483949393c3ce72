#include "backend/cameras/camera.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/elementary.hpp"

namespace scenec::backend {
namespace {

// Half the height of the sensor that `focal` is stated for, metres.
constexpr double half_sensor = 0.012;

double sum_of_sizes(const Point3& p) {
  return std::fabs(p.x) + std::fabs(p.y) + std::fabs(p.z);
}

Vector3 vector_of(const ir::Direction& d) {
  return {d.x, d.y, d.z};
}

}  // namespace

void CameraSampler::set_frame(const ir::CameraFrame& frame) {
  eye_ = {frame.eye.x, frame.eye.y, frame.eye.z};
  Vector3 view{0, 0, -1};
  if (frame.aim)
    view = Point3{frame.aim->x, frame.aim->y, frame.aim->z} - eye_;
  else if (frame.direction)
    view = vector_of(*frame.direction);
  forward_ = normalized(view).vector();
  Vector3 side = cross(forward_, vector_of(frame.up));
  if (!(length_squared(side) > 0)) {
    const Vector3 a = abs(forward_);
    side = cross(forward_, a.x <= a.y && a.x <= a.z ? Vector3{1, 0, 0}
                           : a.y <= a.z             ? Vector3{0, 1, 0}
                                                    : Vector3{0, 0, 1});
  }
  right_ = normalized(side).vector();
  up_ = cross(right_, forward_);
}

void CameraSampler::set_focal(const std::optional<Angle>& fov, const std::optional<Length>& focal) {
  // Kept as (H/2) / tan(fov/2): the course's order of operations.
  if (fov) {
    const double half_tangent = tan(fov->value / 2);
    focal_pixels_ = half_height_ / half_tangent;
    focal_ratio_ = 1 / half_tangent;
  } else if (focal) {
    focal_ratio_ = focal->value / half_sensor;
    focal_pixels_ = half_height_ * focal_ratio_;
  }
}

CameraSampler::CameraSampler(const ir::Camera& camera, ir::ImageSize size, Lens with_lens)
    : half_width_(static_cast<double>(size.width) / 2),
      half_height_(static_cast<double>(size.height) / 2) {
  if (const auto* pinhole = std::get_if<ir::Pinhole>(&camera.kind)) {
    set_frame(*pinhole);
    set_focal(pinhole->fov, pinhole->focal);
  } else if (const auto* lens = std::get_if<ir::ThinLens>(&camera.kind)) {
    set_frame(*lens);
    set_focal(lens->fov, lens->focal);
    const double focal_length = lens->focal ? lens->focal->value : focal_ratio_ * half_sensor;
    lens_radius_ =
        lens->aperture ? lens->aperture->value : focal_length / (2 * lens->f_stop.value_or(8));
    if (with_lens == Lens::left_out) lens_radius_ = 0;
    focus_ = lens->focus.distance.value;
    if (lens->focus.at_aim && lens->aim) {
      focus_ = dot(Point3{lens->aim->x, lens->aim->y, lens->aim->z} - eye_, forward_);
    }
    blades_ = lens->blades;
  } else if (const auto* flat = std::get_if<ir::Orthographic>(&camera.kind)) {
    kind_ = Kind::orthographic;
    set_frame(*flat);
    pixel_size_ = flat->height.value / static_cast<double>(size.height);
  } else if (const auto* round = std::get_if<ir::Panorama>(&camera.kind)) {
    kind_ = Kind::panorama;
    set_frame(*round);
  }
}

Sample2 CameraSampler::lens_point(Sample2 u) const {
  if (blades_ < 3) return sample_concentric_disk(u);
  // A regular polygon in the unit circle: one of its triangles, then a point in it.
  const double count = static_cast<double>(blades_);
  const double scaled = u.u * count;
  const double blade = std::fmin(std::floor(scaled), count - 1);
  const Sample2 b = sample_uniform_triangle({scaled - blade, u.v});
  const SinCos first = sin_cos(2 * pi * blade / count);
  const SinCos second = sin_cos(2 * pi * (blade + 1) / count);
  return {b.u * first.cos + b.v * second.cos, b.u * first.sin + b.v * second.sin};
}

PixelCone CameraSampler::cone() const {
  if (kind_ == Kind::orthographic) return {pixel_size_ / 2, 0};
  if (kind_ == Kind::panorama) return {0, pi / half_width_ / 2};
  return {0, 1 / focal_pixels_ / 2};
}

Ray CameraSampler::ray(double film_x, double film_y, Sample2 lens) const {
  Ray ray = ray_at(film_x, film_y, lens);
  // What lies in the plane of the lens is not before it: at most four roundings a component, of
  // values no larger than the eye's and the origin's.
  ray.t_min = gamma(4) * (sum_of_sizes(eye_) + sum_of_sizes(ray.origin)) +
              std::numeric_limits<double>::denorm_min();
  return ray;
}

Ray CameraSampler::ray_at(double film_x, double film_y, Sample2 lens) const {
  const double x = film_x - half_width_;
  const double y = half_height_ - film_y;
  if (kind_ == Kind::orthographic) {
    return {.origin = eye_ + right_ * (x * pixel_size_) + up_ * (y * pixel_size_),
            .direction = forward_};
  }
  if (kind_ == Kind::panorama) {
    const SinCos azimuth = sin_cos(pi * x / half_width_);
    const SinCos elevation = sin_cos(pi / 2 * y / half_height_);
    const Vector3 d =
        (forward_ * azimuth.cos + right_ * azimuth.sin) * elevation.cos + up_ * elevation.sin;
    return {.origin = eye_, .direction = normalized(d).vector()};
  }
  const Vector3 d = forward_ * focal_pixels_ + right_ * x + up_ * y;
  if (!has_lens()) return {.origin = eye_, .direction = normalized(d).vector()};
  const Sample2 p = lens_point(lens);
  const Vector3 offset = right_ * (p.u * lens_radius_) + up_ * (p.v * lens_radius_);
  // The point of the focal plane that the ray through the lens' centre meets.
  const Vector3 sharp = d * (focus_ / focal_pixels_);
  return {.origin = eye_ + offset, .direction = normalized(sharp - offset).vector()};
}

}  // namespace scenec::backend
