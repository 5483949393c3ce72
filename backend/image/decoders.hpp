// One decoder a format, for read_image only: bytes are known to begin with the format's mark.
#pragma once

#include <cstdint>
#include <optional>
#include <string_view>

#include "backend/image/image.hpp"
#include "base/asset_problem.hpp"
#include "base/result.hpp"

namespace scenec::backend {

using DecodeResult = Result<DecodedImage, AssetProblem>;

// What is wrong with a declared size: none, too large a side, too many bytes decoded.
[[nodiscard]] std::optional<AssetProblem> find_size_problem(std::uint64_t width,
                                                            std::uint64_t height,
                                                            std::uint64_t bytes_per_pixel,
                                                            const ImageLimits& limits);

[[nodiscard]] DecodeResult decode_png(std::string_view bytes, const ImageLimits& limits);
[[nodiscard]] DecodeResult decode_jpeg(std::string_view bytes, const ImageLimits& limits);
[[nodiscard]] DecodeResult decode_exr(std::string_view bytes, const ImageLimits& limits);
[[nodiscard]] DecodeResult decode_pnm(std::string_view bytes, const ImageLimits& limits);
[[nodiscard]] DecodeResult decode_bmp(std::string_view bytes, const ImageLimits& limits);
[[nodiscard]] DecodeResult decode_tga(std::string_view bytes, const ImageLimits& limits);
[[nodiscard]] DecodeResult decode_hdr(std::string_view bytes, const ImageLimits& limits);

}  // namespace scenec::backend
