// Reading pictures from bytes: PNG, JPEG, EXR, Radiance HDR, BMP, TGA and PNM. The content decides
// the format, the name only where a format has no mark of its own (TGA). Sizes are checked against
// the limits and the bytes at hand before anything is allocated; damaged and cut-off files are
// errors, never half pictures. Embedded colour profiles and gamma are not applied.
#pragma once

#include <string_view>

#include "backend/image/image.hpp"
#include "base/asset_problem.hpp"
#include "base/result.hpp"

namespace scenec::backend {

// `extension_hint`: the file name's ending, with or without its dot; may be empty.
[[nodiscard]] Result<DecodedImage, AssetProblem> read_image(std::string_view bytes,
                                                            std::string_view extension_hint,
                                                            const ImageLimits& limits = {});

}  // namespace scenec::backend
