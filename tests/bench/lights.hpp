// `scenec-bench lights`: see lights.cpp.
#pragma once

namespace scenec::bench {

// The words after `lights`; the exit code.
[[nodiscard]] int run_lights(int count, char** words);

}  // namespace scenec::bench
