// Pictures as files: exposure and transfer curve for 8 bits, linear floats for EXR.
#include <algorithm>
#include <cmath>
#include <cstdint>

#include "backend/backend.hpp"
#include "backend/image/tone.hpp"
#include "backend/image/write_image.hpp"
#include "base/assert.hpp"
#include "base/elementary.hpp"

namespace scenec::backend {
namespace {

// 2^stops, exact for whole stops.
double exposure_factor(double stops) {
  const double whole = std::floor(std::clamp(stops, -1000.0, 1000.0));
  return std::ldexp(pow(2, std::clamp(stops, -1000.0, 1000.0) - whole), static_cast<int>(whole));
}

std::uint8_t linear8_of(double c) {
  return static_cast<std::uint8_t>(std::floor(std::fmin(std::fmax(c, 0), 1) * 255 + 0.5));
}

std::vector<std::uint8_t> bytes_of(const Picture& picture, const ir::RenderSettings& settings) {
  const double factor = exposure_factor(settings.exposure);
  std::vector<std::uint8_t> bytes(picture.rgb.size());
  for (std::size_t i = 0; i < bytes.size(); ++i) {
    const double value = static_cast<double>(picture.rgb[i]) * factor;
    if (settings.film == ir::FilmKind::course)
      bytes[i] = course8_of(static_cast<float>(value));
    else
      bytes[i] = settings.tonemap == ir::Tonemap::srgb ? srgb8_of(value) : linear8_of(value);
  }
  return bytes;
}

std::string encode_floats(const Picture& picture, const EncodeOptions& options) {
  const ExrDepth depth = options.half ? ExrDepth::half : ExrDepth::float32;
  std::vector<ExrChannel> channels;
  const std::span<const float> rgb(picture.rgb);
  const char* names[3] = {"R", "G", "B"};
  for (std::size_t c = 0; c < 3; ++c) channels.push_back({names[c], rgb.subspan(c), 3, depth});
  channels.push_back({"A", picture.alpha, 1, depth});
  for (const auto& [name, samples] : picture.layers)
    channels.push_back({name, samples, 1, ExrDepth::float32});
  std::vector<ExrAttribute> attributes{{"chromaticities", Chromaticities{}}};
  for (const auto& [name, value] : options.metadata) attributes.push_back({name, value});
  auto bytes = encode_exr(static_cast<std::uint32_t>(picture.width),
                          static_cast<std::uint32_t>(picture.height), channels, attributes);
  SCENEC_ASSERT(bytes.ok());
  return std::move(bytes).value();
}

}  // namespace

std::optional<ImageFormat> image_format_of(const std::string& path) {
  const std::string extension = extension_of(path);
  if (extension == ".png") return ImageFormat::png;
  if (extension == ".exr") return ImageFormat::exr;
  if (extension == ".bmp") return ImageFormat::bmp;
  return std::nullopt;
}

std::string encode(const Picture& picture, const ir::RenderSettings& settings, ImageFormat format,
                   const EncodeOptions& options) {
  if (format == ImageFormat::exr) return encode_floats(picture, options);
  const std::vector<std::uint8_t> bytes = bytes_of(picture, settings);
  const Rgb8View view{static_cast<std::uint32_t>(picture.width),
                      static_cast<std::uint32_t>(picture.height), bytes};
  auto file = format == ImageFormat::png ? encode_png(view, options.metadata) : encode_bmp(view);
  SCENEC_ASSERT(file.ok());
  return std::move(file).value();
}

}  // namespace scenec::backend
