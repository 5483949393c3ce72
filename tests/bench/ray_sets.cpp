#include "tests/bench/ray_sets.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <map>
#include <memory>
#include <random>
#include <utility>

#include "backend/accel/scene_accel.hpp"
#include "base/elementary.hpp"
#include "tests/bench/ray_check.hpp"

namespace scenec::bench {
namespace {

using namespace backend;

float as_float(double x) {
  return static_cast<float>(x);
}

DumpRay dump_ray(const Point3& o, const Vector3& direction, double t_far) {
  const Vector3 d = normalized(direction).vector();
  return {{as_float(o.x), as_float(o.y), as_float(o.z)},
          0,
          {as_float(d.x), as_float(d.y), as_float(d.z)},
          as_float(t_far)};
}

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr double offset_of_size = 1e-4;  // origins lie this far off the surface, of the diagonal

struct View {
  Point3 eye;
  Vector3 forward;
  Vector3 right;
  Vector3 up;
  double half;
  Point3 light;
  double light_size;
  double offset;
};

View view_of(const Bounds3& box, bool interior) {
  const Point3 center = box.centroid();
  const Vector3 extent = box.extent();
  const double diagonal = length(extent);
  const Vector3 axis = extent.x >= extent.z ? Vector3{1, 0, 0} : Vector3{0, 0, 1};
  View v{};
  v.half = std::tan((interior ? 75 : 42) * (pi / 360));
  v.eye = interior ? center - 0.28 * dot(axis, extent) * axis - Vector3{0, 0.35 * extent.y, 0}
                   : center + 1.15 * diagonal * normalized(Vector3{0.45, 0.35, 1}).vector();
  const Vector3 along = interior ? axis + Vector3{0, 0.08, 0} : center - v.eye;
  v.forward = normalized(along).vector();
  v.right = normalized(cross(v.forward, Vector3{0, 1, 0})).vector();
  v.up = cross(v.right, v.forward);
  v.light = interior ? center + Vector3{0, 0.1 * extent.y, 0}
                     : center + diagonal * Vector3{0.3, 0.9, 0.3};
  v.light_size = (interior ? 0.1 : 0.4) * diagonal;
  v.offset = offset_of_size * diagonal;
  return v;
}

DumpSet primary_rays(const View& view, int resolution) {
  DumpSet set{"primary", false, {}, {}};
  for (int y = 0; y < resolution; ++y) {
    for (int x = 0; x < resolution; ++x) {
      const double u = view.half * (2 * (x + 0.5) / resolution - 1);
      const double v = view.half * (1 - 2 * (y + 0.5) / resolution);
      set.rays.push_back(dump_ray(view.eye, view.forward + u * view.right + v * view.up, infinity));
    }
  }
  return set;
}

}  // namespace

std::vector<DumpSet> ray_sets_of(const TriangleMesh& mesh, const RaySetOptions& options) {
  ThreadPool pool;
  SceneAccel accel;
  accel.add_mesh(0, std::make_shared<const MeshAccel>(TriangleMesh(mesh), pool));
  accel.build(pool);
  const View view = view_of(bounds(mesh), options.interior);
  std::vector<DumpSet> sets{primary_rays(view, options.resolution),
                            {"diffuse", false, {}, {}},
                            {"shuffled", false, {}, {}},
                            {"shadow", true, {}, {}}};
  std::mt19937_64 bits(1);
  const auto number = [&] { return static_cast<double>(bits() >> 11) * 0x1p-53; };
  for (const DumpRay& r : sets[0].rays) {
    const Ray ray = ray_of(r);
    Hit hit;
    if (!accel.intersect(ray, hit)) continue;
    Vector3 n = hit.geometric_normal.vector();
    if (dot(n, ray.direction) > 0) n = -n;
    const Point3 from = ray.at(hit.t) + view.offset * n;
    const Vector3 s =
        normalized(std::fabs(n.x) > 0.5 ? cross(n, Vector3{0, 1, 0}) : cross(n, Vector3{1, 0, 0}))
            .vector();
    const double u = number();
    const double phi = 2 * pi * number();
    const Vector3 bounce = std::sqrt(u) * std::cos(phi) * s +
                           std::sqrt(u) * std::sin(phi) * cross(n, s) + std::sqrt(1 - u) * n;
    sets[1].rays.push_back(dump_ray(from, bounce, infinity));
    const Vector3 to_light =
        view.light - from + view.light_size * Vector3{number() - 0.5, 0, number() - 0.5};
    sets[3].rays.push_back(dump_ray(from, to_light, 0.999 * length(to_light)));
  }
  sets[2].rays = sets[1].rays;
  std::shuffle(sets[2].rays.begin(), sets[2].rays.end(), bits);
  return sets;
}

TriangleMesh subdivided(const TriangleMesh& mesh) {
  std::vector<Vector3> normals(mesh.positions.size());
  for (const Face& f : mesh.faces) {
    const Point3& a = mesh.positions[f[0]];
    const Vector3 n = cross(mesh.positions[f[1]] - a, mesh.positions[f[2]] - a);
    for (const std::uint32_t i : f) normals[i] += n;
  }
  for (Vector3& n : normals) n = length(n) > 0 ? normalized(n).vector() : n;
  TriangleMesh fine;
  fine.positions = mesh.positions;
  std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> middles;
  const auto middle = [&](std::uint32_t i, std::uint32_t j) {
    const auto [found, added] =
        middles.try_emplace(std::minmax(i, j), static_cast<std::uint32_t>(fine.positions.size()));
    if (added) {
      const Point3& p = mesh.positions[i];
      const Point3& q = mesh.positions[j];
      const Point3 m = p + 0.5 * (q - p);
      const Vector3 lift =
          dot(normals[i], p - m) * normals[i] + dot(normals[j], q - m) * normals[j];
      const Point3 lifted = m + 0.375 * lift;  // 3/4 of the mean of both
      const auto single = [](double x) { return static_cast<double>(static_cast<float>(x)); };
      fine.positions.push_back({single(lifted.x), single(lifted.y), single(lifted.z)});
    }
    return found->second;
  };
  for (const Face& f : mesh.faces) {
    const std::uint32_t ab = middle(f[0], f[1]);
    const std::uint32_t bc = middle(f[1], f[2]);
    const std::uint32_t ca = middle(f[2], f[0]);
    fine.faces.insert(fine.faces.end(), {Face{f[0], ab, ca}, Face{ab, f[1], bc}, Face{ca, bc, f[2]},
                                         Face{ab, bc, ca}});
  }
  return fine;
}

}  // namespace scenec::bench
