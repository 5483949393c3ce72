// Whether a transform keeps three dimensions well enough to be inverted, and whether it keeps
// shapes.
#pragma once

#include <optional>

#include "base/span.hpp"
#include "frontend/session.hpp"
#include "ir/values.hpp"

namespace scenec::frontend {

inline constexpr double max_condition = 1e12;  // beyond it fewer than four digits survive inversion

// Condition number of the linear part in the Frobenius norm (between one and three times that of
// the 2-norm); infinite when it is singular or not finite.
[[nodiscard]] double condition_number(const ir::Transform& transform);
// From here on a transform is linted: taken back through it, a position keeps no digit of single
// precision.
inline constexpr double flat_condition = 0x1p23;
// Reports a singular or nearly singular transform, with the transform.
bool check_invertible(Session& session, const ir::Transform& transform, Span span);

// The factor s > 0 when the linear part is s times a rotation (or rotation and mirroring), up to
// rounding; nullopt for shear and non-uniform scale.
[[nodiscard]] std::optional<double> uniform_scale(const ir::Transform& transform);

}  // namespace scenec::frontend
