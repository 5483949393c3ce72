// Rays of every camera, in world space, for places on the film in pixels from the top left.
//
// Domain:     cameras valid in the IR's sense; any place on the film.
// Method:     one focal length for both axes (square pixels); the lens is the unit disk, or a
//             regular polygon, times the aperture, and rays through it meet in the focal plane.
// Error:      directions to 4 ulp; not normalised except for `.course` rules' sake.
// Degenerate: `up` along the view is replaced by the axis least along it.
// Proof:      tests/unit/backend/cameras/camera_test.cpp (C01-C05).
#pragma once

#include "backend/cameras/pixel_cone.hpp"
#include "backend/geometry/kernel.hpp"
#include "backend/math/sampling.hpp"
#include "ir/cameras.hpp"
#include "ir/render_settings.hpp"

namespace scenec::backend {

class CameraSampler {
 public:
  enum class Lens : std::uint8_t { simulated, left_out };
  CameraSampler(const ir::Camera& camera, ir::ImageSize size, Lens lens = Lens::simulated);

  // Whether `lens` numbers are read.
  [[nodiscard]] bool has_lens() const { return lens_radius_ > 0; }
  // What a pixel sees in the middle of the film.
  [[nodiscard]] PixelCone cone() const;
  // The ray's direction is unit.
  // It begins behind the rounding of its origin: a wall in which the camera stands hides nothing.
  [[nodiscard]] Ray ray(double film_x, double film_y, Sample2 lens) const;

 private:
  [[nodiscard]] Ray ray_at(double film_x, double film_y, Sample2 lens) const;
  enum class Kind : std::uint8_t { perspective, orthographic, panorama };
  void set_frame(const ir::CameraFrame& frame);
  void set_focal(const std::optional<Angle>& fov, const std::optional<Length>& focal);
  [[nodiscard]] Sample2 lens_point(Sample2 u) const;

  Kind kind_ = Kind::perspective;
  Point3 eye_;
  Vector3 forward_{0, 0, -1}, right_{1, 0, 0}, up_{0, 1, 0};
  double half_width_ = 0, half_height_ = 0;  // of the film in pixels
  double focal_pixels_ = 1;
  double focal_ratio_ = 1;  // focal length over half the sensor's height
  double lens_radius_ = 0;
  double focus_ = 1;
  std::int64_t blades_ = 0;
  double pixel_size_ = 1;  // orthographic
};

}  // namespace scenec::backend
