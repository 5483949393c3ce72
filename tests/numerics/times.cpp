#include "tests/numerics/times.hpp"

#include <array>
#include <cmath>
#include <cstdint>
#include <ctime>
#include <functional>
#include <limits>
#include <memory>
#include <vector>

#include "backend/accel/scene_accel.hpp"
#include "backend/geometry/revolve_mesh.hpp"
#include "tests/numerics/finding.hpp"
#include "tests/unit/backend/geometry/random_rays.hpp"

namespace scenec::numerics {
namespace {

using namespace backend;
using backend::testing_support::Draw;
using Points = std::vector<ProfilePoint>;

constexpr std::size_t rays_each = 20'000;
constexpr std::uint32_t steps = 256;

// The fastest of five rounds, in microseconds of processor time a ray.
double microseconds(const std::function<bool(const Ray&)>& trace, const std::vector<Ray>& rays) {
  double best = std::numeric_limits<double>::infinity();
  std::uint64_t hits = 0;
  for (int round = 0; round < 5; ++round) {
    const std::clock_t start = std::clock();
    for (const Ray& ray : rays) hits += trace(ray) ? 1U : 0U;
    best = std::fmin(best, static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC);
  }
  return hits > 0 ? best * 1e6 / static_cast<double>(rays.size()) : 0;
}

struct Subject {
  const char* name;
  Profile profile;
};

std::vector<Subject> subjects() {
  return {
      {"cylinder, a cubic",
       bezier_profile(Points{{1.5, 0}, {1.5, 2.0 / 3}, {1.5, 4.0 / 3}, {1.5, 2}})},
      {"vase, a cubic", bezier_profile(Points{{1, 0}, {2, 0.7}, {0.2, 1.3}, {1, 2}})},
      {"spline, three spans",
       bspline_profile(Points{{0.5, 0}, {1.5, 0.5}, {0.5, 1}, {1.5, 1.5}, {0.7, 2}, {1, 2.5}},
                       SplineEnds::clamped)},
      {"vase with poles, three cubics", beziers_profile(Points{{0, 0},
                                                               {1, 0},
                                                               {1, 0.5},
                                                               {0.6, 0.7},
                                                               {0.2, 0.9},
                                                               {0.2, 1.2},
                                                               {0.7, 1.4},
                                                               {1, 1.5},
                                                               {0.9, 2},
                                                               {0, 2}})},
      {"degree 8", bezier_profile(Points{{0.5, 0},
                                         {1.5, 0.2},
                                         {0.1, 0.5},
                                         {1.8, 0.8},
                                         {0.2, 1},
                                         {1.5, 1.2},
                                         {0.4, 1.5},
                                         {1, 1.8},
                                         {0.8, 2}})},
  };
}

}  // namespace

std::string solver_times() {
  ThreadPool pool(1);
  std::string out = fmt::format(
      "| surface | certified | newton | tessellated, {} steps | newton / certified |\n"
      "|---|--:|--:|--:|--:|\n",
      steps);
  for (const Subject& subject : subjects()) {
    const Revolve revolve(subject.profile);
    SceneAccel mesh;
    mesh.add_mesh(0, std::make_shared<const MeshAccel>(tessellate(revolve, steps), pool));
    mesh.build(pool);
    Draw draw(31);
    std::vector<Ray> rays;
    for (std::size_t i = 0; i < rays_each; ++i) {
      const Point3 origin{draw.between(-6, 6), draw.between(-1, 3), draw.between(-6, 6)};
      const Point3 target{draw.between(-1.5, 1.5), draw.between(0, 2), draw.between(-1.5, 1.5)};
      rays.push_back({origin, normalized(target - origin)});
    }
    ShapeHit shape_hit;
    Hit hit;
    const double certified =
        microseconds([&](const Ray& r) { return intersect(revolve, r, shape_hit); }, rays);
    const double newton = microseconds(
        [&](const Ray& r) { return intersect_by_newton(revolve, r, shape_hit); }, rays);
    const double triangles =
        microseconds([&](const Ray& r) { return mesh.intersect(r, hit); }, rays);
    out += fmt::format("| {} | {:.2f} µs | {:.2f} µs | {:.2f} µs | {:.0f} |\n", subject.name,
                       certified, newton, triangles, newton / certified);
  }
  return out;
}

}  // namespace scenec::numerics
