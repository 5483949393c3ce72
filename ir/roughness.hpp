// Where a rough surface counts as smooth: a rule of the language, used by analysis and kernels.
#pragma once

namespace scenec::ir {

// Roughness whose square (alpha) is below this is exactly specular.
inline constexpr double specular_alpha = 1e-3;

}  // namespace scenec::ir
