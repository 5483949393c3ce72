// `SCENEC_ASSERT(condition)`: a broken promise between programmers. It stays on in every build,
// prints the place and ends the process; user mistakes are diagnostics, never assertions.
#pragma once

namespace scenec {

[[noreturn]] void assertion_failed(const char* condition, const char* file, int line);

}  // namespace scenec

#define SCENEC_ASSERT(condition)          \
  (static_cast<bool>(condition) ? void(0) \
                                : ::scenec::assertion_failed(#condition, __FILE__, __LINE__))
