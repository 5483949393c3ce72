// Pictures in memory. Samples are interleaved, rows from the top; nothing here knows a file format.
#pragma once

#include <cstddef>
#include <cstdint>
#include <variant>
#include <vector>

#include "base/limits.hpp"

namespace scenec::backend {

enum class SampleEncoding : std::uint8_t {
  srgb,  // colour channels carry the sRGB curve; alpha never does
  linear,
};

// A decoded picture as its file stores it. Channels: 1 gray, 2 gray alpha, 3 RGB, 4 RGBA.
struct DecodedImage {
  std::uint32_t width = 0;
  std::uint32_t height = 0;
  std::uint32_t channels = 0;
  SampleEncoding encoding = SampleEncoding::srgb;
  std::variant<std::vector<std::uint8_t>, std::vector<std::uint16_t>, std::vector<float>> samples;
  std::uint64_t replaced_samples = 0;  // not-a-number and infinite floats, stored as 0
};

[[nodiscard]] std::uint64_t memory_of(const DecodedImage& image);  // bytes

struct FloatImage {
  std::uint32_t width = 0;
  std::uint32_t height = 0;
  std::uint32_t channels = 0;
  std::vector<float> samples;
};

// Linear values; whole numbers are divided by their largest, sRGB colour channels decoded.
[[nodiscard]] FloatImage linear_image_of(const DecodedImage& image);

// What of the limits concerns one picture.
struct ImageLimits {
  ImageLimits() : ImageLimits(Limits{}) {}
  explicit ImageLimits(const Limits& limits)
      : side(static_cast<std::uint32_t>(limits.image_side)),
        decoded_bytes(limits.image_memory),
        file_bytes(limits.image_bytes) {}

  std::uint32_t side;
  std::uint64_t decoded_bytes;
  std::uint64_t file_bytes;
};

}  // namespace scenec::backend
