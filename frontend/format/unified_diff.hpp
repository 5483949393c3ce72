// The difference of two texts in the form `patch` reads.
#pragma once

#include <string>
#include <string_view>

namespace scenec::frontend {

// Empty when the texts are equal; three lines of context. Time and memory are bounded: texts that
// differ in more than about a thousand lines may be shown with larger replaced stretches than
// needed.
[[nodiscard]] std::string unified_diff(std::string_view before, std::string_view after,
                                       std::string_view before_name, std::string_view after_name);

}  // namespace scenec::frontend
