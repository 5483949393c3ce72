// What `--precision double` changes and costs: pictures of six scenes with vertices in float where
// that is faithful, and all in double. As a Markdown table; times are no bits, so it is not part of
// the generated page.
#pragma once

#include <string>

namespace scenec::numerics {

[[nodiscard]] std::string precision_table();

}  // namespace scenec::numerics
