// libFuzzer's entrance to one target, which the build names.
#include <cstddef>
#include <cstdint>

#include "tests/fuzz/targets.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  scenec::fuzz::SCENEC_FUZZ_TARGET({reinterpret_cast<const char*>(data), size});
  return 0;
}
