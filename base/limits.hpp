// The limits a user can raise, and the option that raises each. What is within them is bounded by
// memory only; what is beyond is one located error that names the option.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

namespace scenec {

struct Limits {
#define SCENEC_LIMIT(member, option, value, lowest, highest, unit, what) \
  std::uint64_t member = value;
#include "base/limits.def"
#undef SCENEC_LIMIT
};

namespace limit_option {
#define SCENEC_LIMIT(member, option, value, lowest, highest, unit, what) \
  inline constexpr std::string_view member = option;
#include "base/limits.def"
#undef SCENEC_LIMIT
}  // namespace limit_option

// The hint of an error about a limit.
[[nodiscard]] inline std::string sets_the_limit(std::string_view option) {
  return "`" + std::string(option) + "` sets the limit";
}

}  // namespace scenec
