// Pictures to bytes in memory: PNG, BMP, EXR. Equal input gives equal bytes: no dates, no host,
// nothing but what is passed in. Writing the file is base/atomic_file.hpp's part.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "base/asset_problem.hpp"
#include "base/result.hpp"

namespace scenec::backend {

// 8-bit RGB, rows from the top. Precondition: width and height at least 1, rgb.size() = 3 w h.
struct Rgb8View {
  std::uint32_t width = 0;
  std::uint32_t height = 0;
  std::span<const std::uint8_t> rgb;
};

// Keys of 1 to 79 printable ASCII characters, values of UTF-8 without NUL; written in order.
using PngText = std::vector<std::pair<std::string, std::string>>;

// Declares the samples as sRGB.
[[nodiscard]] Result<std::string, AssetProblem> encode_png(const Rgb8View& image,
                                                           const PngText& text = {});
// 24 bits, bottom row first, 54 bytes of header: the layout of the course's programs.
[[nodiscard]] Result<std::string, AssetProblem> encode_bmp(const Rgb8View& image);

enum class ExrDepth : std::uint8_t { float32, half };

// Sample (x, y), y from the top, is samples[(y * width + x) * stride].
struct ExrChannel {
  std::string name;  // "R", "albedo.G", ...
  std::span<const float> samples;
  std::size_t stride = 1;
  ExrDepth depth = ExrDepth::float32;  // half: rounded to nearest, above 65504 infinite
};

// The values as a file with `half` channels holds them.
void round_to_half(std::vector<float>& values);

// CIE x, y of red, green, blue and white.
struct Chromaticities {
  std::array<float, 8> xy{0.64f, 0.33f, 0.30f, 0.60f, 0.15f, 0.06f, 0.3127f, 0.3290f};  // Rec. 709
  friend bool operator==(const Chromaticities&, const Chromaticities&) = default;
};

struct ExrAttribute {
  std::string name;
  std::variant<std::string, std::int32_t, float, Chromaticities> value;
};

// One part, scan lines, ZIP.
[[nodiscard]] Result<std::string, AssetProblem> encode_exr(
    std::uint32_t width, std::uint32_t height, std::span<const ExrChannel> channels,
    std::span<const ExrAttribute> attributes);

}  // namespace scenec::backend
