// Small plots as SVG: curves on logarithmic axes, and bars. They carry their own light background,
// so that they read the same on a dark page. The same figures give the same bytes.
#pragma once

#include <string>
#include <vector>

#include "tests/numerics/catalog.hpp"
#include "tests/numerics/finding.hpp"

namespace scenec::numerics {

[[nodiscard]] std::string svg_of(const Plot& plot, const std::vector<Series>& series);

}  // namespace scenec::numerics
