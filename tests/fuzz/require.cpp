#include "tests/fuzz/require.hpp"

#include <cstdio>
#include <cstdlib>

namespace scenec::fuzz {

void require(bool holds, std::string_view broken, std::string_view detail) {
  if (holds) return;
  std::fprintf(stderr, "broken: %.*s\n%.*s\n", static_cast<int>(broken.size()), broken.data(),
               static_cast<int>(detail.size()), detail.data());
  std::abort();
}

}  // namespace scenec::fuzz
