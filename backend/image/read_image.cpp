#include "backend/image/read_image.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <new>
#include <string>

#include "backend/image/decoders.hpp"
#include "base/text.hpp"

namespace scenec::backend {
namespace {

using namespace std::string_view_literals;

using Decoder = DecodeResult (*)(std::string_view, const ImageLimits&);

bool names_tga(std::string_view hint) {
  if (hint.starts_with('.')) hint.remove_prefix(1);
  return std::ranges::equal(hint, "tga"sv, [](char a, char b) {
    return (a >= 'A' && a <= 'Z' ? static_cast<char>(a - 'A' + 'a') : a) == b;
  });
}

Decoder find_decoder(std::string_view bytes, std::string_view hint) {
  if (bytes.starts_with("\x89PNG\r\n\x1a\n"sv)) return decode_png;
  if (bytes.starts_with("\xFF\xD8\xFF"sv)) return decode_jpeg;
  if (bytes.starts_with("\x76\x2F\x31\x01"sv)) return decode_exr;
  if (bytes.starts_with("#?RADIANCE"sv) || bytes.starts_with("#?RGBE"sv)) return decode_hdr;
  if (bytes.starts_with("BM"sv)) return decode_bmp;
  if (bytes.size() > 2 && bytes[0] == 'P' && bytes[1] >= '1' && bytes[1] <= '6') return decode_pnm;
  if (names_tga(hint) || bytes.ends_with("TRUEVISION-XFILE.\0"sv)) return decode_tga;
  return nullptr;
}

}  // namespace

std::optional<AssetProblem> find_size_problem(std::uint64_t width, std::uint64_t height,
                                              std::uint64_t bytes_per_pixel,
                                              const ImageLimits& limits) {
  if (width == 0 || height == 0) {
    return AssetProblem{0, fmt::format("declared size {} x {} has no pixels", width, height)};
  }
  if (width > limits.side || height > limits.side) {
    return AssetProblem{0,
                        fmt::format("declared size {} x {}; at most {} pixels a side are allowed",
                                    width, height, limits.side),
                        limit_option::image_side};
  }
  if (width * height > limits.decoded_bytes / bytes_per_pixel) {
    return AssetProblem{0,
                        fmt::format("{} x {} pixels take {} bytes; at most {} are allowed", width,
                                    height, width * height * bytes_per_pixel, limits.decoded_bytes),
                        limit_option::image_memory};
  }
  return std::nullopt;
}

Result<DecodedImage, AssetProblem> read_image(std::string_view bytes,
                                              std::string_view extension_hint,
                                              const ImageLimits& limits) {
  if (bytes.empty()) return Failure{AssetProblem{0, "file is empty"}};
  if (bytes.size() > limits.file_bytes) {
    return Failure{AssetProblem{
        0,
        fmt::format("file has {} bytes; at most {} are allowed", bytes.size(), limits.file_bytes),
        limit_option::image_bytes}};
  }
  const Decoder decoder = find_decoder(bytes, extension_hint);
  if (decoder == nullptr) {
    return Failure{AssetProblem{
        0, fmt::format("no known picture format begins with `{}`; needs PNG, JPEG, EXR, HDR, BMP, "
                       "TGA or PNM",
                       printable(bytes.substr(0, 8)))}};
  }
  try {
    return decoder(bytes, limits);
  } catch (const std::bad_alloc&) {
    return Failure{AssetProblem{0, "not enough memory for the picture"}};
  }
}

}  // namespace scenec::backend
