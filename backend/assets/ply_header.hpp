// The header of a PLY file: its elements with their properties, checked for what a body reader
// relies on (known types, no duplicates, counts that the body can hold).
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "backend/assets/mesh_data.hpp"
#include "base/asset_problem.hpp"
#include "base/result.hpp"

namespace scenec::backend {

enum class PlyFormat : std::uint8_t { ascii, binary_little_endian, binary_big_endian };
enum class PlyType : std::uint8_t { int8, uint8, int16, uint16, int32, uint32, float32, float64 };

[[nodiscard]] constexpr std::size_t size_of(PlyType type) {
  constexpr std::size_t sizes[] = {1, 1, 2, 2, 4, 4, 4, 8};
  return sizes[static_cast<std::size_t>(type)];
}
[[nodiscard]] constexpr bool is_real(PlyType type) {
  return type == PlyType::float32 || type == PlyType::float64;
}

struct PlyProperty {
  std::string name;
  bool is_list = false;
  PlyType count_type = PlyType::uint8;  // of a list
  PlyType type = PlyType::float32;      // of the value, or of the items
};

struct PlyElement {
  std::string name;
  std::uint64_t count = 0;
  std::uint64_t line = 0;
  std::vector<PlyProperty> properties;
};

struct PlyHeader {
  PlyFormat format = PlyFormat::ascii;
  std::vector<PlyElement> elements;
  std::size_t body_offset = 0;
  std::uint64_t body_line = 0;  // line number of the first body line
};

[[nodiscard]] Result<PlyHeader, AssetProblem> read_ply_header(std::string_view bytes,
                                                              const MeshLimits& limits);
// The fewest bytes one row of the element takes in the body.
[[nodiscard]] std::uint64_t least_row_size(const PlyElement& element, PlyFormat format);

}  // namespace scenec::backend
