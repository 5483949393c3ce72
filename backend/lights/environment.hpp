// Light from infinitely far away: constant, or a latitude-longitude picture chosen from by
// brightness. The middle of the picture lies towards -z, its right towards +x, its top towards +y.
//
// Domain:     pictures of any size; any unit direction.
// Method:     a table of rows and one a row of columns, by the largest luminance of a texel and its
//             neighbours (so bilinear lookups are covered) times the sine of the row.
// Error:      densities to 8 ulp of the table's step.
// Degenerate: a black picture is never chosen; at the poles the density is 0.
// Proof:      tests/unit/backend/lights/lights_test.cpp.
#pragma once

#include <memory>
#include <vector>

#include "backend/image/image.hpp"
#include "backend/math/color.hpp"
#include "backend/math/sampling.hpp"
#include "ir/lights.hpp"

namespace scenec::backend {

class Environment {
 public:
  Environment(const ir::EnvironmentLight& light, std::shared_ptr<const DecodedImage> image);

  [[nodiscard]] bool is_constant() const { return !image_; }
  [[nodiscard]] Rgb radiance(const Vector3& direction) const;
  // Mean radiance over all directions.
  [[nodiscard]] Rgb mean() const { return mean_; }

  struct Choice {
    UnitVector3 wi;
    double pdf = 0;  // 0: nothing chosen
  };
  [[nodiscard]] Choice sample(Sample2 u) const;
  [[nodiscard]] double pdf(const Vector3& direction) const;

  // Bytes of its tables; the image is an asset.
  [[nodiscard]] std::uint64_t memory() const {
    return (rows_.capacity() + columns_.capacity()) * sizeof(double);
  }

 private:
  [[nodiscard]] Sample2 uv_of(const Vector3& direction) const;
  void build_tables();

  std::shared_ptr<const DecodedImage> image_;
  bool srgb_ = false;
  Rgb factor_;
  Rgb mean_;
  double turn_sin_ = 0, turn_cos_ = 1;
  std::size_t width_ = 0, height_ = 0;
  std::vector<double> rows_;     // cumulative, height + 1
  std::vector<double> columns_;  // cumulative, a row: width + 1
};

}  // namespace scenec::backend
