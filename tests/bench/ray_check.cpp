#include "tests/bench/ray_check.hpp"

#include <fmt/format.h>

#include <cmath>
#include <string>

namespace scenec::bench {
namespace {

// What float arithmetic may do to the recorded t: a few dozen roundings of the size of what is
// subtracted.
bool is_tie(const DumpRay& r, const DumpHit& a, const DumpHit& b) {
  if (a.primitive == DumpHit::miss || b.primitive == DumpHit::miss) return false;
  const float size = std::fabs(r.origin[0]) + std::fabs(r.origin[1]) + std::fabs(r.origin[2]);
  return std::fabs(a.t - b.t) <= 0x1p-19F * (size + std::fabs(b.t));
}

// The nearest hit by the edge functions in long double over all triangles, for rays that differ.
DumpHit oracle(const backend::TriangleMesh& mesh, const DumpRay& r, long double& margin) {
  int z = 0;
  for (int k = 1; k < 3; ++k)
    if (std::fabs(r.direction[k]) > std::fabs(r.direction[z])) z = k;
  const int x = (z + 1) % 3;
  const int y = (z + 2) % 3;
  DumpHit best{INFINITY, DumpHit::miss};
  long double best_t = INFINITY;
  const auto at = [&](const backend::Point3& p, int k) {
    return static_cast<long double>(component(p, k)) - static_cast<long double>(r.origin[k]);
  };
  for (std::uint32_t f = 0; f < mesh.faces.size(); ++f) {
    long double px[3], py[3], pz[3];
    for (std::size_t v = 0; v < 3; ++v) {
      const backend::Point3& p = mesh.positions[mesh.faces[f][v]];
      pz[v] = at(p, z) / static_cast<long double>(r.direction[z]);
      px[v] = at(p, x) - static_cast<long double>(r.direction[x]) * pz[v];
      py[v] = at(p, y) - static_cast<long double>(r.direction[y]) * pz[v];
    }
    long double e[3];
    long double nearest_edge = INFINITY;
    for (int v = 0; v < 3; ++v) {
      const int a = (v + 1) % 3;
      const int b = (v + 2) % 3;
      e[v] = px[b] * py[a] - py[b] * px[a];
      nearest_edge =
          std::fmin(nearest_edge, std::fabs(e[v]) / std::hypot(px[a] - px[b], py[a] - py[b]));
    }
    if ((e[0] < 0 || e[1] < 0 || e[2] < 0) && (e[0] > 0 || e[1] > 0 || e[2] > 0)) {
      margin = std::fmin(margin, nearest_edge);
      continue;
    }
    margin = std::fmin(margin, nearest_edge);
    const long double det = e[0] + e[1] + e[2];
    if (det == 0) continue;
    const long double t = (e[0] * pz[0] + e[1] * pz[1] + e[2] * pz[2]) / det;
    if (t < static_cast<long double>(r.t_near) || t > static_cast<long double>(r.t_far) ||
        t >= best_t)
      continue;
    best_t = t;
    best = {static_cast<float>(t), f};
  }
  return best;
}

std::string text_of(const DumpHit& h) {
  return h.primitive == DumpHit::miss ? "miss" : fmt::format("{}@{:.9g}", h.primitive, h.t);
}

}  // namespace

backend::Ray ray_of(const DumpRay& r) {
  const auto d = [](float x) { return static_cast<double>(x); };
  return {{d(r.origin[0]), d(r.origin[1]), d(r.origin[2])},
          {d(r.direction[0]), d(r.direction[1]), d(r.direction[2])},
          d(r.t_near),
          d(r.t_far)};
}

HitComparison compare_hits(const DumpSet& set, const std::vector<DumpHit>& ours,
                           const backend::TriangleMesh& mesh, int list) {
  HitComparison result;
  for (std::size_t i = 0; i < ours.size(); ++i) {
    const DumpHit& a = ours[i];
    const DumpHit& b = set.hits[i];
    if (a.primitive == b.primitive) continue;
    const bool tie = !set.any_hit && is_tie(set.rays[i], a, b);
    ++(tie ? result.ties : result.mismatches);
    if (tie || list-- <= 0) continue;
    long double margin = INFINITY;
    const DumpHit exact = oracle(mesh, set.rays[i], margin);
    fmt::print("  differs {} ray {} ours {} recorded {} long_double {} nearest_edge {:.3g}\n",
               set.name, i, text_of(a), text_of(b), text_of(exact), static_cast<double>(margin));
  }
  return result;
}

}  // namespace scenec::bench
