// What a material is made of: its words as weighted lobes.
#pragma once

#include <array>
#include <string_view>
#include <vector>

#include "frontend/course/materials.hpp"

namespace scenec::frontend::course {

enum class LobeKind : std::uint8_t { diffuse, mirror, glass, glossy, phong };
inline constexpr std::array<std::string_view, 5> lobe_names{"diffuse", "mirror", "glass", "coat",
                                                            "phong"};

struct Lobe {
  LobeKind kind = LobeKind::phong;
  double weight = 1;
};

struct Lobes {
  std::vector<Lobe> list;  // weights of any sum
  double factor = 1;       // on all colours: shares that sum to less than 1 absorb the rest
};

[[nodiscard]] Lobes lobes_of(const MaterialData& material);

}  // namespace scenec::frontend::course
