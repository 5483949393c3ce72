// Wavefront material libraries: what a course scene takes from them. Other statements are read
// over; opacity is one of them, as exporters disagree on whether `Tr` and `d` count up or down.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "base/asset_problem.hpp"
#include "base/result.hpp"

namespace scenec::frontend::course {

struct MtlMaterial {
  std::string name;
  std::optional<std::array<double, 3>> diffuse;   // Kd
  std::optional<std::array<double, 3>> specular;  // Ks
  std::optional<std::array<double, 3>> emission;  // Ke
  std::optional<double> shininess;                // Ns
  std::string diffuse_map;  // map_Kd: the file name as written, options left out
};

// In file order.
[[nodiscard]] Result<std::vector<MtlMaterial>, AssetProblem> read_mtl(std::string_view bytes,
                                                                      std::size_t longest_line);

}  // namespace scenec::frontend::course
