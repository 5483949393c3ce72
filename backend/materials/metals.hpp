// Indices of refraction of metals as three bands (red, green, blue): approximate, after measured
// spectra (Johnson and Christy 1972; Palik 1985 for the rest) in reductions that renderers commonly
// share. Three bands cannot hold a spectrum: colours are right to a few hundredths of reflectance.
#pragma once

#include "backend/math/color.hpp"
#include "ir/materials.hpp"

namespace scenec::backend {

struct MetalIndices {
  Rgb eta;
  Rgb k;
};

[[nodiscard]] constexpr MetalIndices indices_of(ir::ConductorPreset preset) {
  switch (preset) {
    case ir::ConductorPreset::gold:
      return {{0.1431, 0.3749, 1.4424}, {3.9831, 2.3857, 1.6032}};
    case ir::ConductorPreset::silver:
      return {{0.1552, 0.1167, 0.1383}, {4.8283, 3.1222, 2.1470}};
    case ir::ConductorPreset::copper:
      return {{0.2004, 0.9240, 1.1022}, {3.9129, 2.4528, 2.1421}};
    case ir::ConductorPreset::aluminium:
      return {{1.3456, 0.9654, 0.6172}, {7.4746, 6.3995, 5.3031}};
    case ir::ConductorPreset::iron:
      return {{2.9114, 2.9497, 2.5845}, {3.0893, 2.9318, 2.7670}};
    case ir::ConductorPreset::brass:
      return {{0.4441, 0.5274, 1.0944}, {3.6950, 2.7645, 1.8292}};
    case ir::ConductorPreset::chromium:
      return {{3.1071, 3.1812, 2.3230}, {3.3314, 3.3291, 3.1350}};
    case ir::ConductorPreset::titanium:
      return {{2.7407, 2.5418, 2.2370}, {3.8143, 3.4345, 3.0235}};
  }
  return {};
}

}  // namespace scenec::backend
