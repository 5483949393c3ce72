#include "backend/film/filter.hpp"

#include <algorithm>
#include <cmath>

#include "base/elementary.hpp"

namespace scenec::backend {
namespace {

constexpr std::size_t table_steps = 1024;

// Mitchell and Netravali 1988, B = C = 1/3, over [-2, 2].
double mitchell(double x) {
  constexpr double b = 1.0 / 3;
  constexpr double c = 1.0 / 3;
  x = std::fabs(x);
  if (x >= 2) return 0;
  if (x >= 1)
    return ((-b - 6 * c) * x * x * x + (6 * b + 30 * c) * x * x + (-12 * b - 48 * c) * x + 8 * b +
            24 * c) /
           6;
  return ((12 - 9 * b - 6 * c) * x * x * x + (-18 + 12 * b + 6 * c) * x * x + 6 - 2 * b) / 6;
}

// Harris 1978, the 4-term window, over [-1, 1].
double blackman_harris(double x) {
  const double a = pi * (x + 1);
  return 0.35875 - 0.48829 * cos(a) + 0.14128 * cos(2 * a) - 0.01168 * cos(3 * a);
}

}  // namespace

double filter_value(const ir::PixelFilter& filter, double x) {
  const double scaled = x / filter.radius;
  if (!(std::fabs(scaled) < 1)) return 0;
  switch (filter.kind) {
    case ir::FilterKind::tent:
      return 1 - std::fabs(scaled);
    case ir::FilterKind::box:
      return 1;
    case ir::FilterKind::gaussian: {
      // Standard deviation a third of the radius, lowered to meet zero at the edge.
      const double edge = exp(-4.5);
      return exp(-4.5 * scaled * scaled) - edge;
    }
    case ir::FilterKind::mitchell:
      return mitchell(2 * scaled);
    case ir::FilterKind::blackman_harris:
      return blackman_harris(scaled);
  }
  return 0;
}

FilterSampler::FilterSampler(const ir::PixelFilter& filter) : filter_(filter) {
  if (filter.kind == ir::FilterKind::tent || filter.kind == ir::FilterKind::box) return;
  cumulative_.resize(table_steps + 1);
  signs_.resize(table_steps);
  double sum = 0;
  for (std::size_t i = 0; i < table_steps; ++i) {
    const double x = ((static_cast<double>(i) + 0.5) / table_steps * 2 - 1) * filter.radius;
    const double value = filter_value(filter, x);
    signs_[i] = value < 0 ? -1 : 1;
    sum += std::fabs(value);
    cumulative_[i + 1] = sum;
  }
  for (double& value : cumulative_) value /= sum;
  cumulative_.back() = 1;
}

FilterSampler::Offset FilterSampler::offset(double u) const {
  if (filter_.kind == ir::FilterKind::box) return {(2 * u - 1) * filter_.radius, 1};
  if (filter_.kind == ir::FilterKind::tent) {
    const double d = u < 0.5 ? std::sqrt(2 * u) - 1 : 1 - std::sqrt(2 - 2 * u);
    return {d * filter_.radius, 1};
  }
  const auto above = std::upper_bound(cumulative_.begin() + 1, cumulative_.end() - 1, u);
  const auto step = static_cast<std::size_t>(above - cumulative_.begin()) - 1;
  const double low = cumulative_[step];
  const double width = cumulative_[step + 1] - low;
  const double within = width > 0 ? (u - low) / width : 0.5;
  return {((static_cast<double>(step) + within) / table_steps * 2 - 1) * filter_.radius,
          signs_[step]};
}

FilterSample FilterSampler::sample(Sample2 u) const {
  const Offset x = offset(u.u);
  const Offset y = offset(u.v);
  return {x.d, y.d, x.sign * y.sign};
}

}  // namespace scenec::backend
