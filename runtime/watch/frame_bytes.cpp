#include "runtime/watch/frame_bytes.hpp"

#include <bit>
#include <cstddef>

namespace scenec::runtime {

namespace {

void put_word(std::string& bytes, std::int64_t value) {
  for (int shift = 0; shift < 32; shift += 8)
    bytes += static_cast<char>(static_cast<std::uint32_t>(value) >> shift & 0xff);
}

}  // namespace

std::uint16_t half_of(float value) {
  const auto bits = std::bit_cast<std::uint32_t>(value);
  const std::uint32_t sign = bits >> 16 & 0x8000;
  const std::uint32_t magnitude = bits & 0x7fffffff;
  constexpr std::uint32_t too_large = 0x477ff000;  // 65520, halfway to what would be 65536
  constexpr std::uint32_t smallest_normal = 0x38800000;
  if (!(magnitude < too_large)) return static_cast<std::uint16_t>(sign | 0x7bff);
  if (magnitude < smallest_normal) {
    // Subnormal: adding 0.5 leaves the rounded multiple of 2^-24 in the low bits.
    const float shifted = std::bit_cast<float>(magnitude) + 0.5f;
    return static_cast<std::uint16_t>(sign | (std::bit_cast<std::uint32_t>(shifted) & 0x7ff));
  }
  const std::uint32_t odd = magnitude >> 13 & 1;
  const std::uint32_t rounded = magnitude - 0x38000000 + 0xfff + odd;  // to nearest, ties to even
  return static_cast<std::uint16_t>(sign | rounded >> 13);
}

std::string frame_bytes(const backend::Picture& picture, const FrameInfo& info) {
  std::string bytes = "SCF1";
  bytes.reserve(48 + picture.rgb.size() * 2);
  for (const std::int64_t word :
       {std::int64_t{info.generation}, info.size.width, info.size.height, std::int64_t{info.step},
        info.region.x0, info.region.y0, info.region.x1, info.region.y1, std::int64_t{picture.width},
        std::int64_t{picture.height}, picture.samples}) {
    put_word(bytes, word);
  }
  const std::size_t head = bytes.size();
  bytes.resize(head + picture.rgb.size() * 2);
  char* out = bytes.data() + head;
  for (const float value : picture.rgb) {
    const std::uint16_t half = half_of(value);
    *out++ = static_cast<char>(half & 0xff);
    *out++ = static_cast<char>(half >> 8);
  }
  return bytes;
}

}  // namespace scenec::runtime
