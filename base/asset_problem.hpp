// Why an asset (mesh, material library, picture) could not be read or written. The reader knows
// bytes only; whoever asked for the asset turns this into a diagnostic with its own place.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

namespace scenec {

struct AssetProblem {
  std::uint64_t line = 0;  // 1-based line of the asset; 0: the file as a whole, or a binary file
  std::string message;
  std::string_view limit_option = {};  // base/limits.hpp: the one that would let it pass
};

}  // namespace scenec
