// Pixel filters, sampled in proportion to their magnitude: a sample belongs to one pixel and
// carries only the sign of the filter as its weight.
//
// Domain:     radius > 0; numbers in [0, 1).
// Method:     tent and box by their inverse integrals; the others by a table of 1024 steps of
//             |f| in one dimension (the filters are products), linear within a step.
// Error:      table: the step's density is that of its middle, relative 2^-10.
// Degenerate: none; negative lobes (mitchell) give weight -1.
// Proof:      tests/unit/backend/film/film_test.cpp.
#pragma once

#include <cstdint>
#include <vector>

#include "backend/math/sampling.hpp"
#include "ir/render_settings.hpp"

namespace scenec::backend {

struct FilterSample {
  double dx = 0;  // from the pixel's centre
  double dy = 0;
  int weight = 1;
};

class FilterSampler {
 public:
  explicit FilterSampler(const ir::PixelFilter& filter);
  [[nodiscard]] FilterSample sample(Sample2 u) const;

 private:
  struct Offset {
    double d;
    int sign;
  };
  [[nodiscard]] Offset offset(double u) const;

  ir::PixelFilter filter_;
  std::vector<double> cumulative_;  // of |f|, from 0 to 1; empty for tent and box
  std::vector<std::int8_t> signs_;
};

// The filter itself in one dimension, not normalised.
[[nodiscard]] double filter_value(const ir::PixelFilter& filter, double x);

}  // namespace scenec::backend
