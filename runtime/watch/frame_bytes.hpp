// A picture as pages take it: linear light in half floats, so that a page can change exposure by
// itself and nothing is spent on compression between two processes of one machine.
//
// Layout, little-endian: "SCF1", then 32-bit words generation, width, height (of the picture),
// step (a pixel sent stands for step x step of them), x0, y0, x1, y1 (the region), columns, rows,
// samples a pixel; then columns * rows * 3 half floats, rows from the top.
#pragma once

#include <cstdint>
#include <string>

#include "backend/backend.hpp"
#include "ir/render_settings.hpp"

namespace scenec::runtime {

struct FrameInfo {
  std::uint32_t generation = 0;  // of the scene; grows with every edit that shows
  ir::ImageSize size{};
  ir::Region region{};
  int step = 1;
};
[[nodiscard]] std::string frame_bytes(const backend::Picture& picture, const FrameInfo& info);

// The nearest half float (IEEE 754 binary16); what is too large becomes the largest finite one.
[[nodiscard]] std::uint16_t half_of(float value);

}  // namespace scenec::runtime
