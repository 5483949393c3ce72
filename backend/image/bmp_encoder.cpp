#include <fmt/format.h>

#include "backend/image/write_image.hpp"
#include "base/assert.hpp"

namespace scenec::backend {
namespace {

constexpr std::uint32_t header_size = 54;

void put16(std::string& bytes, std::uint32_t value) {
  bytes.push_back(static_cast<char>(value & 0xFF));
  bytes.push_back(static_cast<char>(value >> 8 & 0xFF));
}

void put32(std::string& bytes, std::uint32_t value) {
  put16(bytes, value & 0xFFFF);
  put16(bytes, value >> 16);
}

}  // namespace

Result<std::string, AssetProblem> encode_bmp(const Rgb8View& image) {
  SCENEC_ASSERT(image.width > 0 && image.height > 0);
  SCENEC_ASSERT(image.rgb.size() == std::size_t{3} * image.width * image.height);
  const std::uint64_t row_size = (std::uint64_t{image.width} * 3 + 3) / 4 * 4;
  const std::uint64_t pixel_size = row_size * image.height;
  if (pixel_size > 0x7FFF'FFFF - header_size) {
    return Failure{AssetProblem{
        0, fmt::format("{} x {} pixels do not fit a BMP file", image.width, image.height)}};
  }
  std::string bytes;
  bytes.reserve(header_size + pixel_size);
  bytes += "BM";
  put32(bytes, header_size + static_cast<std::uint32_t>(pixel_size));
  put32(bytes, 0);
  put32(bytes, header_size);
  put32(bytes, 40);  // size of the rest of the header
  put32(bytes, image.width);
  put32(bytes, image.height);
  put16(bytes, 1);   // planes
  put16(bytes, 24);  // bits a pixel
  put32(bytes, 0);   // not compressed
  put32(bytes, static_cast<std::uint32_t>(pixel_size));
  for (int i = 0; i < 4; ++i) put32(bytes, 0);  // resolution and palette
  for (std::size_t row = image.height; row-- > 0;) {
    const std::uint8_t* source = image.rgb.data() + row * image.width * 3;
    for (std::size_t x = 0; x < image.width; ++x, source += 3) {
      const char bgr[] = {static_cast<char>(source[2]), static_cast<char>(source[1]),
                          static_cast<char>(source[0])};
      bytes.append(bgr, 3);
    }
    bytes.append(row_size - std::size_t{image.width} * 3, '\0');
  }
  return bytes;
}

}  // namespace scenec::backend
