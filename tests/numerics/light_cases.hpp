// The cases of light, sampling, camera, film and statistics by their ids, each with the tests that
// hold it. The tests live elsewhere; here it is seen to that none is missing.
#pragma once

#include <string>

namespace scenec::numerics {

// The table of docs/numerics.md.
[[nodiscard]] std::string light_case_table();

}  // namespace scenec::numerics
