// Reading OpenEXR pictures with all their channels. One part of flat scan lines or tiles; anything
// else is refused by name.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "backend/image/image.hpp"
#include "backend/image/write_image.hpp"
#include "base/asset_problem.hpp"
#include "base/result.hpp"

namespace scenec::backend {

struct ExrPlane {
  std::string name;
  ExrDepth depth = ExrDepth::float32;  // in the file; 32-bit integers count as float32
  std::vector<float> samples;          // rows from the top
};

struct ExrImage {
  std::uint32_t width = 0;
  std::uint32_t height = 0;
  std::vector<ExrPlane> planes;          // in the file's order, which is by name
  std::vector<ExrAttribute> attributes;  // those of the kinds we write, by name
};

[[nodiscard]] Result<ExrImage, AssetProblem> read_exr(std::string_view bytes,
                                                      const ImageLimits& limits = {});

}  // namespace scenec::backend
