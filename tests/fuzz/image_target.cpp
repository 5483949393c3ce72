// Picture files: whatever the bytes are, a picture that was read has all its samples.
#include <zlib.h>

#include <cmath>
#include <cstdint>
#include <string>
#include <string_view>

#include "backend/image/read_image.hpp"
#include "tests/fuzz/require.hpp"
#include "tests/fuzz/targets.hpp"

namespace scenec::fuzz {

namespace {

constexpr std::string_view png_mark = "\x89PNG\r\n\x1a\n";

std::uint32_t big_endian(std::string_view bytes) {
  std::uint32_t value = 0;
  for (const char c : bytes.substr(0, 4)) value = value << 8 | static_cast<unsigned char>(c);
  return value;
}

// The checksums of a PNG's chunks made right: else no change would ever get past them.
std::string with_right_checksums(std::string_view bytes) {
  std::string repaired(bytes);
  std::size_t at = png_mark.size();
  while (repaired.size() - at >= 12) {
    const std::uint32_t size = big_endian(std::string_view(repaired).substr(at));
    if (size > repaired.size() - at - 12) break;
    const auto* body = reinterpret_cast<const Bytef*>(repaired.data() + at + 4);
    const uLong sum = ::crc32(0, body, size + 4);
    at += 8 + size;
    for (int shift = 24; shift >= 0; shift -= 8) {
      repaired[at++] = static_cast<char>(sum >> shift & 0xFF);
    }
  }
  return repaired;
}

void read(std::string_view bytes, std::string_view hint) {
  backend::ImageLimits limits;
  limits.side = 512;
  limits.decoded_bytes = 1u << 20;
  const auto image = backend::read_image(bytes, hint, limits);
  if (!image) {
    const std::string& message = image.error().message;
    require(!message.empty() && message.size() < 1000, "a message", message);
    return;
  }
  const backend::DecodedImage& read = image.value();
  require(read.width > 0 && read.width <= limits.side && read.height > 0 &&
              read.height <= limits.side && read.channels > 0 && read.channels <= 4,
          "a picture has a size");
  const std::size_t count = std::size_t{read.width} * read.height * read.channels;
  std::visit([&](const auto& samples) { require(samples.size() == count, "every sample"); },
             read.samples);
  if (const auto* floats = std::get_if<std::vector<float>>(&read.samples)) {
    for (const float sample : *floats) require(std::isfinite(sample), "samples are finite");
  }
}

}  // namespace

void fuzz_image(std::string_view bytes) {
  read(bytes, "tga");
  if (bytes.starts_with(png_mark)) read(with_right_checksums(bytes), "");
}

}  // namespace scenec::fuzz
