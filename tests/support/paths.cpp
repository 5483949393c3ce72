#include "tests/support/paths.hpp"

namespace scenec::test {

std::filesystem::path source_directory() {
  return SCENEC_SOURCE_DIR;
}

}  // namespace scenec::test
