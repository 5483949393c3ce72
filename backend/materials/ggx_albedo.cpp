#include "backend/materials/ggx_albedo.hpp"

#include <algorithm>
#include <cmath>

#include "backend/materials/fresnel.hpp"
#include "backend/materials/microfacet.hpp"

namespace scenec::backend {
namespace {

GgxAlbedo::Terms integrate(double mu, double alpha) {
  constexpr int steps = 16;
  const double s = std::sqrt(std::fmax(0, 1 - mu * mu));
  const Vector3 wo{s, 0, mu};
  double full = 0;
  double share = 0;
  for (int i = 0; i < steps; ++i) {
    for (int j = 0; j < steps; ++j) {
      const Vector3 m = sample_ggx_normal(wo, alpha, {(i + 0.5) / steps, (j + 0.5) / steps});
      const Vector3 wi = reflected(wo, m);
      if (!(wi.z > 0)) continue;
      const double weight = ggx_visible_both(wo, wi, alpha) / ggx_visible(wo, alpha);
      full += weight;
      share += weight * schlick_share(std::fmin(1, dot(wo, m)));
    }
  }
  constexpr double count = steps * steps;
  return {(full - share) / count, share / count};
}

GgxAlbedo::Terms lerp(const GgxAlbedo::Terms& a, const GgxAlbedo::Terms& b, double t) {
  return {a.base + t * (b.base - a.base), a.share + t * (b.share - a.share)};
}

struct Cell {
  int low;
  int high;
  double t;
};
Cell cell_of(double x, int count) {
  const double scaled = std::clamp(x, 0.0, 1.0) * (count - 1);
  const int low = std::min(static_cast<int>(scaled), count - 2);
  return {low, low + 1, scaled - low};
}

}  // namespace

GgxAlbedo::GgxAlbedo() {
  for (int r = 0; r < roughnesses; ++r) {
    const double roughness = static_cast<double>(r) / (roughnesses - 1);
    const double alpha = roughness * roughness;
    auto& row = table_[static_cast<std::size_t>(r)];
    for (int c = 0; c < cosines; ++c) {
      // The cosine is at least half a step: a surface is never looked at from within itself.
      const double mu = std::fmax(static_cast<double>(c), 0.125) / (cosines - 1);
      if (alpha < specular_alpha) {
        const double share = schlick_share(mu);
        row[static_cast<std::size_t>(c)] = {1 - share, share};
      } else {
        row[static_cast<std::size_t>(c)] = integrate(mu, alpha);
      }
    }
    // Integral of 2 mu E(mu), E linear between the nodes: exact for that interpolant.
    Terms sum{0, 0};
    for (int c = 0; c + 1 < cosines; ++c) {
      const double a = static_cast<double>(c) / (cosines - 1);
      const double h = 1.0 / (cosines - 1);
      const Terms& low = row[static_cast<std::size_t>(c)];
      const Terms& high = row[static_cast<std::size_t>(c) + 1];
      const double wl = 2 * h * (a / 2 + h / 6);
      const double wh = 2 * h * (a / 2 + h / 3);
      sum.base += wl * low.base + wh * high.base;
      sum.share += wl * low.share + wh * high.share;
    }
    average_[static_cast<std::size_t>(r)] = sum;
  }
}

GgxAlbedo::Terms GgxAlbedo::directional(double mu, double alpha) const {
  const Cell r = cell_of(std::sqrt(alpha), roughnesses);
  const Cell c = cell_of(mu, cosines);
  const auto at = [&](int row, int column) {
    return table_[static_cast<std::size_t>(row)][static_cast<std::size_t>(column)];
  };
  return lerp(lerp(at(r.low, c.low), at(r.low, c.high), c.t),
              lerp(at(r.high, c.low), at(r.high, c.high), c.t), r.t);
}

GgxAlbedo::Terms GgxAlbedo::average(double alpha) const {
  const Cell r = cell_of(std::sqrt(alpha), roughnesses);
  return lerp(average_[static_cast<std::size_t>(r.low)], average_[static_cast<std::size_t>(r.high)],
              r.t);
}

}  // namespace scenec::backend
