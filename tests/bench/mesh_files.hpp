// Mesh files of any size for benchmarks: a bumpy sheet of 2 x columns x rows triangles.
#pragma once

#include <cstdint>
#include <string>

namespace scenec::bench {

struct Sheet {
  int columns = 250;
  int rows = 200;
  [[nodiscard]] std::uint64_t triangle_count() const {
    return 2 * static_cast<std::uint64_t>(columns) * static_cast<std::uint64_t>(rows);
  }
};

[[nodiscard]] std::string obj_of(const Sheet& sheet);
[[nodiscard]] std::string ascii_ply_of(const Sheet& sheet);
// Little-endian floats and 32-bit indices, as most programs write them: 15 MB for 810,000
// triangles.
[[nodiscard]] std::string binary_ply_of(const Sheet& sheet);

}  // namespace scenec::bench
