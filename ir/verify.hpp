// The invariants of a Scene, stated as code: ids in range, numbers finite, transforms affine and
// invertible, ranges of every Schema kept, references acyclic.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "ir/scene.hpp"

namespace scenec::ir {

// A picture has at most so many pixels: 16384 x 16384.
inline constexpr std::int64_t largest_pixel_count = std::int64_t{1} << 28;

// What does not hold, one line each; empty for a valid scene.
[[nodiscard]] std::vector<std::string> find_violations(const Scene& scene);

}  // namespace scenec::ir
