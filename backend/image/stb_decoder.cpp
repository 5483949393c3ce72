// BMP, TGA and Radiance HDR by stb_image, compiled here and nowhere else. stb does not notice the
// end of its input, so the source tells us when it read on, and the picture is refused.
#include <fmt/format.h>

#include <algorithm>
#include <cstring>
#include <memory>
#include <utility>

#include "backend/image/decoders.hpp"

#define STB_IMAGE_IMPLEMENTATION
#define STB_IMAGE_STATIC
#define STBI_NO_STDIO
#define STBI_ONLY_BMP
#define STBI_ONLY_TGA
#define STBI_ONLY_HDR
#define STBI_MAX_DIMENSIONS 65536
#include <stb_image.h>

namespace scenec::backend {
namespace {

// stb refills its buffer in pieces of this size and then makes do with less.
constexpr int refill_size = 128;

struct Source {
  std::string_view bytes;
  std::size_t at = 0;
  bool overrun = false;
  // While pixels are read: 0xFF forever behind the end. Without it stb's HDR decoder waits there
  // for a run that is not empty; the header readers in turn need a true end.
  bool endless = false;
};

int read_source(void* user, char* data, int size) {
  auto& source = *static_cast<Source*>(user);
  const std::size_t wanted = static_cast<std::size_t>(size);
  const std::size_t count = std::min(wanted, source.bytes.size() - source.at);
  std::memcpy(data, source.bytes.data() + source.at, count);
  source.at += count;
  if (count == wanted || (count > 0 && size == refill_size)) return static_cast<int>(count);
  source.overrun = true;
  if (!source.endless) return static_cast<int>(count);
  std::memset(data + count, 0xFF, wanted - count);
  return size;
}

void skip_source(void* user, int count) {
  auto& source = *static_cast<Source*>(user);
  const std::int64_t target = static_cast<std::int64_t>(source.at) + count;
  const std::int64_t size = static_cast<std::int64_t>(source.bytes.size());
  if (target < 0 || target > size) source.overrun = true;
  source.at = static_cast<std::size_t>(std::clamp<std::int64_t>(target, 0, size));
}

int source_at_end(void* user) {
  const auto& source = *static_cast<const Source*>(user);
  return source.at == source.bytes.size() ? 1 : 0;
}

constexpr stbi_io_callbacks callbacks{read_source, skip_source, source_at_end};

struct FreePixels {
  void operator()(void* pixels) const { stbi_image_free(pixels); }
};

AssetProblem damaged(std::string_view format) {
  const char* reason = stbi_failure_reason();
  return {0, fmt::format("damaged {}: {}", format, reason == nullptr ? "unreadable" : reason)};
}

struct Size {
  int width = 0;
  int height = 0;
  int channels = 0;
};

// Reads and checks the declared size, and makes the source ready for the pixels.
Result<Size, AssetProblem> read_size(Source& source, std::string_view format,
                                     std::uint64_t sample_bytes, const ImageLimits& limits) {
  Size size;
  if (stbi_info_from_callbacks(&callbacks, &source, &size.width, &size.height, &size.channels) ==
      0) {
    return Failure{damaged(format)};
  }
  if (size.width <= 0 || size.height <= 0 || size.channels < 1 || size.channels > 4) {
    return Failure{
        AssetProblem{0, fmt::format("damaged {}: declared size makes no sense", format)}};
  }
  const std::uint64_t pixel_bytes = static_cast<std::uint64_t>(size.channels) * sample_bytes;
  if (auto problem =
          find_size_problem(static_cast<std::uint64_t>(size.width),
                            static_cast<std::uint64_t>(size.height), pixel_bytes, limits)) {
    return Failure{std::move(*problem)};
  }
  source = {source.bytes, 0, false, true};
  return size;
}

std::uint64_t pixel_count(const Size& size) {
  return static_cast<std::uint64_t>(size.width) * static_cast<std::uint64_t>(size.height);
}

std::uint64_t byte_at(std::string_view bytes, std::size_t at) {
  return at < bytes.size() ? static_cast<unsigned char>(bytes[at]) : 0;
}

AssetProblem too_short(std::string_view format, const Size& size) {
  return {
      0, fmt::format("{} file ends too early for {} x {} pixels", format, size.width, size.height)};
}

DecodeResult decode_bytes(Source& source, std::string_view format, Size size) {
  const std::unique_ptr<stbi_uc, FreePixels> pixels(
      stbi_load_from_callbacks(&callbacks, &source, &size.width, &size.height, &size.channels, 0));
  if (pixels == nullptr) return Failure{damaged(format)};
  if (source.overrun) return Failure{too_short(format, size)};
  DecodedImage image;
  image.width = static_cast<std::uint32_t>(size.width);
  image.height = static_cast<std::uint32_t>(size.height);
  image.channels = static_cast<std::uint32_t>(size.channels);
  image.samples = std::vector<std::uint8_t>(
      pixels.get(), pixels.get() + pixel_count(size) * static_cast<std::uint64_t>(size.channels));
  return image;
}

}  // namespace

DecodeResult decode_bmp(std::string_view bytes, const ImageLimits& limits) {
  Source source{bytes};
  const Result<Size, AssetProblem> size = read_size(source, "BMP", 1, limits);
  if (!size) return Failure{size.error()};
  // stb knows no compressed BMP, so the pixels must be there. Old headers (12 bytes) are shorter.
  const std::size_t depth_at = byte_at(bytes, 14) == 12 ? 24 : 28;
  const std::uint64_t bits = byte_at(bytes, depth_at);
  if (pixel_count(size.value()) * bits / 8 > bytes.size()) {
    return Failure{too_short("BMP", size.value())};
  }
  return decode_bytes(source, "BMP", size.value());
}

DecodeResult decode_tga(std::string_view bytes, const ImageLimits& limits) {
  Source source{bytes};
  const Result<Size, AssetProblem> size = read_size(source, "TGA", 1, limits);
  if (!size) return Failure{size.error()};
  const std::uint64_t pixels = pixel_count(size.value());
  const bool run_length = byte_at(bytes, 2) >= 8;
  // A run of at most 128 pixels takes two bytes or more.
  const std::uint64_t least = run_length ? pixels / 64 : pixels * byte_at(bytes, 16) / 8;
  if (least > bytes.size()) return Failure{too_short("TGA", size.value())};
  return decode_bytes(source, "TGA", size.value());
}

namespace {

// Whether a blank line ends the header and a line behind it says the size. stb takes the end of the
// file for both when it asks for the size, and then waits for them for ever.
bool hdr_header_is_whole(std::string_view bytes) {
  std::size_t line = 0;
  for (;;) {
    const std::size_t end = bytes.find('\n', line);
    if (end == std::string_view::npos) return false;
    const bool is_blank = end == line || bytes[line] == '\0';
    line = end + 1;
    if (is_blank) return bytes.find('\n', line) != std::string_view::npos;
  }
}

}  // namespace

DecodeResult decode_hdr(std::string_view bytes, const ImageLimits& limits) {
  if (!hdr_header_is_whole(bytes)) {
    return Failure{AssetProblem{0, "damaged HDR: its header has no end"}};
  }
  Source source{bytes};
  const Result<Size, AssetProblem> read = read_size(source, "HDR", sizeof(float), limits);
  if (!read) return Failure{read.error()};
  Size size = read.value();
  // Four run-length coded planes: at most 127 samples of one plane in two bytes.
  if (pixel_count(size) * 4 / 64 > bytes.size()) return Failure{too_short("HDR", size)};
  const std::unique_ptr<float, FreePixels> pixels(
      stbi_loadf_from_callbacks(&callbacks, &source, &size.width, &size.height, &size.channels, 3));
  if (pixels == nullptr) return Failure{damaged("HDR")};
  if (source.overrun) return Failure{too_short("HDR", size)};
  DecodedImage image;
  image.width = static_cast<std::uint32_t>(size.width);
  image.height = static_cast<std::uint32_t>(size.height);
  image.channels = 3;
  image.encoding = SampleEncoding::linear;
  image.samples = std::vector<float>(pixels.get(), pixels.get() + pixel_count(size) * 3);
  return image;
}

}  // namespace scenec::backend
