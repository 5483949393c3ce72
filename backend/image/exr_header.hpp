// A look at an EXR header before OpenEXR sees the file: OpenEXR allocates by what the header says,
// so what it says is checked first, against the limits and against the bytes at hand.
#pragma once

#include <optional>
#include <string_view>

#include "backend/image/image.hpp"
#include "base/asset_problem.hpp"

namespace scenec::backend {

// Promises for a file that passes: one flat part, data window within the limits, every attribute
// lies within the file and has the size of its type, chunk table within the file, all decoded
// channels together within the byte limit.
[[nodiscard]] std::optional<AssetProblem> find_exr_header_problem(std::string_view bytes,
                                                                  const ImageLimits& limits);

}  // namespace scenec::backend
