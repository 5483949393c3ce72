#include "backend/assets/triangulate.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <numeric>
#include <span>
#include <utility>

#include "base/assert.hpp"

namespace scenec::backend {
namespace {

using Vec3 = std::array<double, 3>;
using Vec2 = std::array<double, 2>;

Vec3 difference(const Point3& a, const Point3& b) {
  return {a.x - b.x, a.y - b.y, a.z - b.z};
}

Vec3 cross(const Vec3& a, const Vec3& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

bool is_zero(const Vec3& a) {
  return a[0] == 0 && a[1] == 0 && a[2] == 0;
}

double dot(const Vec3& a, const Vec3& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

double largest_component(const Vec3& a) {
  return std::max({std::abs(a[0]), std::abs(a[1]), std::abs(a[2])});
}

// Brings the largest component to [0.5, 1) by a power of two; zero stays zero.
Vec3 rescaled(const Vec3& a) {
  const double largest = largest_component(a);
  if (largest == 0 || !std::isfinite(largest)) return a;
  int exponent = 0;
  std::frexp(largest, &exponent);
  return {std::ldexp(a[0], -exponent), std::ldexp(a[1], -exponent), std::ldexp(a[2], -exponent)};
}

bool is_finite(const Vec3& a) {
  return std::isfinite(a[0]) && std::isfinite(a[1]) && std::isfinite(a[2]);
}

// A quarter of the corners' coordinates has differences that are finite whatever they are.
bool has_area(const Point3& a, const Point3& b, const Point3& c) {
  const Vec3 direct = cross(difference(b, a), difference(c, a));
  if (is_finite(direct) && !is_zero(direct)) return true;
  const auto quarter = [](const Point3& p) { return Point3{p.x / 4, p.y / 4, p.z / 4}; };
  const bool large = !is_finite(direct);
  const Vec3 ab = large ? difference(quarter(b), quarter(a)) : difference(b, a);
  const Vec3 ac = large ? difference(quarter(c), quarter(a)) : difference(c, a);
  return !is_zero(cross(rescaled(ab), rescaled(ac)));
}

// Twice the signed area of a, b, c in the plane.
double turn(const Vec2& a, const Vec2& b, const Vec2& c) {
  return (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
}

class Triangulator {
 public:
  Triangulator(FaceList& faces, const MeshLimits& limits, MeshData& mesh)
      : faces_(faces), mesh_(mesh), limits_(limits), ear_tests_left_(limits.ear_tests) {}

  std::optional<AssetProblem> run() {
    if (std::optional<AssetProblem> problem = reserve()) return problem;
    keep_leading_triangles();
    std::size_t part = 0;
    std::size_t first_corner = 0;
    for (std::size_t face = 0; face < faces_.sizes.size(); ++face) {
      while (part < faces_.parts.size() && faces_.parts[part].first_face <= face) open_part(part++);
      const std::uint32_t size = faces_.sizes[face];
      const std::size_t before = mesh_.triangles.size();
      if (size == 3) {
        emit(first_corner, 0, 1, 2);
      } else if (!add_polygon(first_corner, size)) {
        return AssetProblem{
            line_of(leading_ + face),
            fmt::format("the concave polygons up to this one, with {} corners, cost "
                        "more than {} tests to cut into triangles; split it",
                        size, limits_.ear_tests)};
      }
      if (mesh_.triangles.size() == before) drop(corners(first_corner, size), leading_ + face);
      first_corner += size;
    }
    close_parts();
    return std::nullopt;
  }

 private:
  std::uint32_t line_of(std::size_t face) const {
    return faces_.lines.empty() ? 0 : faces_.lines[face];
  }

  std::span<const std::uint32_t> corners(std::size_t first, std::size_t size) const {
    return std::span(faces_.corner_positions).subspan(first, size);
  }

  const Point3& position(std::size_t corner) const {
    return mesh_.positions[faces_.corner_positions[corner]];
  }

  std::optional<AssetProblem> reserve() {
    const std::uint64_t count =
        faces_.triangles.size() + faces_.corner_positions.size() - 2 * faces_.sizes.size();
    if (count > limits_.triangles) {
      return AssetProblem{
          0, fmt::format("{} triangles; at most {} are allowed", count, limits_.triangles),
          limit_option::mesh_triangles};
    }
    leading_ = faces_.triangles.size();
    mesh_.triangles = std::move(faces_.triangles);
    mesh_.triangles.reserve(count);
    if (!faces_.corner_normals.empty()) mesh_.normal_triangles.reserve(count);
    if (!faces_.corner_uvs.empty()) mesh_.uv_triangles.reserve(count);
    if (faces_.parts.empty()) mesh_.parts.push_back({});
    return std::nullopt;
  }

  // Those with an area move together; the vector is not copied.
  void keep_leading_triangles() {
    std::size_t kept = 0;
    for (std::size_t face = 0; face < leading_; ++face) {
      const TriangleIndices t = mesh_.triangles[face];
      if (has_area(mesh_.positions[t[0]], mesh_.positions[t[1]], mesh_.positions[t[2]])) {
        mesh_.triangles[kept++] = t;
      } else {
        drop(t, face);
      }
    }
    mesh_.triangles.resize(kept);
  }

  void open_part(std::size_t part) {
    mesh_.parts.push_back({static_cast<std::uint32_t>(mesh_.triangles.size()), 0,
                           faces_.parts[part].group, faces_.parts[part].material});
  }

  void close_parts() {
    for (std::size_t i = 0; i < mesh_.parts.size(); ++i) {
      const std::size_t end =
          i + 1 < mesh_.parts.size() ? mesh_.parts[i + 1].first_triangle : mesh_.triangles.size();
      mesh_.parts[i].triangle_count =
          static_cast<std::uint32_t>(end) - mesh_.parts[i].first_triangle;
    }
    std::erase_if(mesh_.parts, [](const MeshPart& part) { return part.triangle_count == 0; });
  }

  // Adds the triangle of corners first+i, first+j, first+k unless it has no area.
  void emit(std::size_t first, std::size_t i, std::size_t j, std::size_t k) {
    if (!has_area(position(first + i), position(first + j), position(first + k))) return;
    const auto pick = [&](const std::vector<std::uint32_t>& table) {
      return TriangleIndices{table[first + i], table[first + j], table[first + k]};
    };
    mesh_.triangles.push_back(pick(faces_.corner_positions));
    if (!faces_.corner_normals.empty())
      mesh_.normal_triangles.push_back(pick(faces_.corner_normals));
    if (!faces_.corner_uvs.empty()) mesh_.uv_triangles.push_back(pick(faces_.corner_uvs));
  }

  void drop(std::span<const std::uint32_t> corners, std::size_t face) {
    ++mesh_.dropped_face_count;
    if (mesh_.dropped_faces.size() >= limits_.reported_dropped_faces) return;
    std::vector<std::uint32_t> sorted(corners.begin(), corners.end());
    std::ranges::sort(sorted);
    const auto distinct = std::ranges::unique(sorted).begin() - sorted.begin();
    mesh_.dropped_faces.push_back(
        {line_of(face), static_cast<std::uint32_t>(face),
         distinct < 3 ? DropReason::repeated_vertex : DropReason::zero_area});
  }

  Vec3 newell_normal(std::size_t first, std::size_t size) const {
    Vec3 sum{0, 0, 0};
    for (std::size_t i = 1; i + 1 < size; ++i) {
      const Vec3 part = cross(difference(position(first + i), position(first)),
                              difference(position(first + i + 1), position(first)));
      for (std::size_t axis = 0; axis < 3; ++axis) sum[axis] += part[axis];
    }
    return sum;
  }

  bool fan_is_right(std::size_t first, std::size_t size, const Vec3& normal) const {
    for (std::size_t i = 1; i + 1 < size; ++i) {
      const Vec3 part = cross(difference(position(first + i), position(first)),
                              difference(position(first + i + 1), position(first)));
      if (dot(part, normal) < 0) return false;
    }
    return true;
  }

  // False: the ear budget is used up.
  bool add_polygon(std::size_t first, std::size_t size) {
    const Vec3 normal = newell_normal(first, size);
    if (fan_is_right(first, size, normal)) {
      for (std::size_t i = 1; i + 1 < size; ++i) emit(first, 0, i, i + 1);
      return true;
    }
    project(first, size, normal);
    return clip_ears(first, size);
  }

  // Fills plane_ with the corners seen along the largest axis of the normal, counter-clockwise.
  void project(std::size_t first, std::size_t size, const Vec3& normal) {
    std::size_t axis = 0;
    for (std::size_t i = 1; i < 3; ++i) {
      if (std::abs(normal[i]) > std::abs(normal[axis])) axis = i;
    }
    const double sign = normal[axis] < 0 ? -1.0 : 1.0;
    plane_.resize(size);
    for (std::size_t i = 0; i < size; ++i) {
      const Point3& p = position(first + i);
      plane_[i] = {component(p, static_cast<int>((axis + 1) % 3)) * sign,
                   component(p, static_cast<int>((axis + 2) % 3))};
    }
  }

  // An ear: turns left (or is flat) and holds no other corner that turns right.
  bool is_ear(std::size_t at) {
    const std::size_t count = ring_.size();
    const std::uint32_t a = ring_[(at + count - 1) % count];
    const std::uint32_t b = ring_[at];
    const std::uint32_t c = ring_[(at + 1) % count];
    const Vec2 &pa = plane_[a], &pb = plane_[b], &pc = plane_[c];
    if (!(turn(pa, pb, pc) > 0)) return false;
    for (const std::uint32_t other : ring_) {
      if (other == a || other == b || other == c) continue;
      const Vec2& p = plane_[other];
      if (p == pa || p == pb || p == pc) continue;
      if (turn(pa, pb, p) >= 0 && turn(pb, pc, p) >= 0 && turn(pc, pa, p) >= 0) return false;
    }
    return true;
  }

  bool clip_ears(std::size_t first, std::size_t size) {
    ring_.resize(size);
    std::iota(ring_.begin(), ring_.end(), std::uint32_t{0});
    std::size_t at = 0;
    std::size_t refused = 0;
    while (ring_.size() > 3) {
      if (ear_tests_left_ < ring_.size()) return false;
      ear_tests_left_ -= ring_.size();
      const std::size_t count = ring_.size();
      // A ring without an ear is flat or crosses itself: cut where we stand.
      if (refused < count && !is_ear(at)) {
        ++refused;
        at = (at + 1) % count;
        continue;
      }
      emit(first, ring_[(at + count - 1) % count], ring_[at], ring_[(at + 1) % count]);
      ring_.erase(ring_.begin() + static_cast<std::ptrdiff_t>(at));
      at = at == 0 ? ring_.size() - 1 : at - 1;
      refused = 0;
    }
    emit(first, ring_[0], ring_[1], ring_[2]);
    return true;
  }

  FaceList& faces_;
  std::size_t leading_ = 0;  // faces taken from `FaceList::triangles`
  MeshData& mesh_;
  const MeshLimits& limits_;
  std::uint64_t ear_tests_left_;
  std::vector<Vec2> plane_;
  std::vector<std::uint32_t> ring_;
};

}  // namespace

std::optional<AssetProblem> triangulate(FaceList faces, const MeshLimits& limits, MeshData& mesh) {
  SCENEC_ASSERT(faces.corner_positions.size() >= 3 * faces.sizes.size());
  SCENEC_ASSERT(faces.triangles.empty() ||
                (faces.parts.empty() && faces.corner_normals.empty() && faces.corner_uvs.empty()));
  return Triangulator(faces, limits, mesh).run();
}

}  // namespace scenec::backend
