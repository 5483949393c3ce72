// Recorded rays with the hits of another tracer, as `embree_rays` writes them.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "backend/geometry/mesh.hpp"

namespace scenec::bench {

struct DumpRay {
  float origin[3];
  float t_near;
  float direction[3];
  float t_far;
};
struct DumpHit {
  static constexpr std::uint32_t miss = 0xffffffff;
  float t;
  std::uint32_t primitive;  // any hit: 1 if there is one
};
struct DumpSet {
  std::string name;
  bool any_hit = false;
  std::vector<DumpRay> rays;
  std::vector<DumpHit> hits;
};
struct RayDump {
  std::uint32_t triangles = 0;
  std::vector<DumpSet> sets;
};

[[nodiscard]] std::optional<RayDump> read_ray_dump(const std::string& path);

// The triangles the recorder saw, in its order: coordinates of an OBJ file as floats, polygons as
// fans, nothing left out. A PLY file is read by the product's reader.
[[nodiscard]] std::optional<backend::TriangleMesh> read_bench_mesh(const std::string& path);

}  // namespace scenec::bench
