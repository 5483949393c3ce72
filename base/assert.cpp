#include "base/assert.hpp"

#include <cstdio>
#include <cstdlib>

namespace scenec {

void assertion_failed(const char* condition, const char* file, int line) {
  std::fprintf(stderr, "scenec: internal failure at %s:%d: `%s` does not hold\n", file, line,
               condition);
  std::fflush(stderr);
#ifdef NDEBUG
  std::_Exit(5);  // the exit code of an internal failure
#else
  std::abort();  // debuggers, sanitizers and fuzzers want to see the place
#endif
}

}  // namespace scenec
