// The invariants of a Scene, stated as code: ids in range, numbers finite, transforms affine and
// invertible, ranges of every Schema kept, references acyclic.
#pragma once

#include <string>
#include <vector>

#include "ir/scene.hpp"

namespace scenec::ir {

// What does not hold, one line each; empty for a valid scene.
[[nodiscard]] std::vector<std::string> find_violations(const Scene& scene);

}  // namespace scenec::ir
