// scenec-bench scaling: how building and tracing grow with the number of triangles, beside a
// kd-tree and brute force, on bumpy spheres of 1,000 to 10 million triangles.
#include "tests/bench/scaling.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <functional>
#include <memory>
#include <string>
#include <string_view>

#include "backend/accel/scene_accel.hpp"
#include "tests/bench/ray_check.hpp"
#include "tests/bench/ray_sets.hpp"
#include "tests/bench/ray_timing.hpp"
#include "tests/unit/backend/accel/kd_tree.hpp"
#include "tests/unit/backend/geometry/test_meshes.hpp"

namespace scenec::bench {
namespace {

using namespace backend;

constexpr int resolution = 512;  // of the camera that makes the rays
constexpr std::size_t most_for_kd_tree = 1'100'000;
constexpr std::size_t most_for_brute_force = 11'000;
constexpr std::size_t rays_of_brute_force = 2000;

TriangleMesh sphere_of(std::uint32_t triangles) {
  const auto quads = static_cast<std::uint32_t>(std::ceil(std::sqrt(triangles / 2.0) + 0.5));
  TriangleMesh mesh = testing_support::displaced_sphere(quads, 0);
  // As files have them.
  const auto single = [](double x) { return static_cast<double>(static_cast<float>(x)); };
  for (Point3& p : mesh.positions) p = {single(p.x), single(p.y), single(p.z)};
  return mesh;
}

using Find = std::function<bool(const Ray&)>;

// Nanoseconds a ray on one thread, the least of the rounds.
double time_a_ray(const DumpSet& set, std::size_t most, int rounds, const Find& find) {
  const std::size_t count = std::min(most, set.rays.size());
  double best = INFINITY;
  std::size_t hits = 0;
  for (int i = 0; i < rounds; ++i) {
    best =
        std::min(best, seconds_of(count, 1, Clock::cpu, [&](std::size_t first, std::size_t last) {
                   for (std::size_t k = first; k < last; ++k)
                     hits += find(ray_of(set.rays[k])) ? 1U : 0U;
                 }));
  }
  // Used, so that nothing is left out.
  return hits == 0 ? INFINITY : best * 1e9 / static_cast<double>(count);
}

std::string cell(double value) {
  return std::isfinite(value) ? fmt::format("{:8.0f}", value) : fmt::format("{:>8}", "-");
}

struct Row {
  double primary = INFINITY;
  double shuffled = INFINITY;
};

Row time_of_tree(const SceneAccel& accel, const std::vector<DumpSet>& sets, int rounds) {
  const Find find = [&](const Ray& ray) {
    FoundHit hit;
    return accel.find(ray, hit);
  };
  const std::size_t all = sets[0].rays.size();
  return {time_a_ray(sets[0], all, rounds, find), time_a_ray(sets[2], all, rounds, find)};
}

void measure(std::uint32_t triangles, int rounds) {
  const auto mesh = std::make_shared<const TriangleMesh>(sphere_of(triangles));
  const std::vector<DumpSet> sets = ray_sets_of(*mesh, {resolution, false});
  ThreadPool pool(1);
  const double start = seconds_now(Clock::cpu);
  const auto built = std::make_shared<const MeshAccel>(mesh, pool);
  const double build = seconds_now(Clock::cpu) - start;
  SceneAccel accel;
  accel.add_mesh(0, built);
  accel.build(pool);
  const Row tree = time_of_tree(accel, sets, rounds);
  Row kd;
  double kd_build = INFINITY;
  if (mesh->faces.size() <= most_for_kd_tree) {
    const double before = seconds_now(Clock::cpu);
    const test::KdTree other(*mesh);
    kd_build = seconds_now(Clock::cpu) - before;
    const Find find = [&](const Ray& ray) {
      ShapeHit hit;
      return other.find(ray, hit);
    };
    kd = {time_a_ray(sets[0], sets[0].rays.size(), 1, find),
          time_a_ray(sets[2], sets[2].rays.size(), 1, find)};
  }
  double brute = INFINITY;
  if (mesh->faces.size() <= most_for_brute_force) {
    brute = time_a_ray(sets[2], rays_of_brute_force, 1, [&](const Ray& ray) {
      ShapeHit hit;
      return test::find_by_brute_force(*mesh, ray, hit);
    });
  }
  const double count = static_cast<double>(mesh->faces.size());
  fmt::print("{:9} {:7.3f} {:6.2f} {:6.1f} {} {} {} {} {} {}\n", mesh->faces.size(), build,
             count * 1e-6 / build, static_cast<double>(built->tree().bytes()) / count,
             cell(tree.primary), cell(tree.shuffled), cell(kd_build * 1e3), cell(kd.primary),
             cell(kd.shuffled), cell(brute));
  std::fflush(stdout);
}

}  // namespace

int run_scaling(int count, char** words) {
  std::uint32_t most = 10'000'000;
  int rounds = 3;
  for (int i = 0; i < count; i += 2) {
    const std::string_view word = words[i];
    const int value = i + 1 < count ? std::atoi(words[i + 1]) : 0;
    if (value <= 0 || (word != "--most" && word != "--rounds")) {
      fmt::print(stderr, "usage: scenec-bench scaling [--most TRIANGLES] [--rounds N]\n");
      return 2;
    }
    if (word == "--most")
      most = static_cast<std::uint32_t>(value);
    else
      rounds = value;
  }
  fmt::print(
      "one thread, processor time; ns a ray by tree, kd-tree (its build in ms before it), brute "
      "force (shuffled)\ntriangles build s    M/s B/tri.  primary shuffled    kd ms  primary "
      "shuffled    "
      "brute\n");
  for (std::uint32_t triangles = 1000; triangles <= most; triangles *= 10)
    measure(triangles, rounds);
  return 0;
}

}  // namespace scenec::bench
