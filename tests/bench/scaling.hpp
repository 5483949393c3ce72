// `scenec-bench scaling`: see scaling.cpp.
#pragma once

namespace scenec::bench {

// The words after `scaling`; the exit code.
[[nodiscard]] int run_scaling(int count, char** words);

}  // namespace scenec::bench
