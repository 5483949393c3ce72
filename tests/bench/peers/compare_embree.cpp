// scenec-compare-embree MESH...: single rays beside Embree 3, in one process and in turn, so that
// both see the same neighbours. Prints for each mesh and set the rates and our ratio to Embree's
// robust mode and to its fastest (high quality, not robust), and where hits differ from the robust
// ones; at the end the geometric means.
//
//   scenec-compare-embree [--resolution N] [--threads N] [--rounds N] [--interior] [--subdivide]
//                         [--double] [--list N] MESH...
//
// --interior, --subdivide: of the meshes behind it. --list: shows the first mismatches beside the
// answer in long double. Time is processor time, of all threads; the
// fastest round counts. Embree traces with flush-to-zero on, as it asks; we never do.
#include <embree3/rtcore.h>
#include <fmt/format.h>
#include <immintrin.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <functional>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "backend/accel/scene_accel.hpp"
#include "tests/bench/ray_check.hpp"
#include "tests/bench/ray_sets.hpp"
#include "tests/bench/ray_timing.hpp"

namespace scenec::bench {
namespace {

using backend::FoundHit;
using backend::MeshAccel;
using backend::Precision;
using backend::Ray;
using backend::SceneAccel;

struct Settings {
  RaySetOptions rays;
  unsigned threads = 1;
  int rounds = 5;
  bool subdivide = false;
  int list = 0;  // mismatches to show
  Precision precision = Precision::mixed;
};

// A thing that answers a range of rays.
using Tracer = std::function<void(const DumpSet&, std::size_t, std::size_t, std::vector<DumpHit>&)>;

double time_of(const Tracer& tracer, const DumpSet& set, unsigned threads,
               std::vector<DumpHit>& out) {
  return seconds_of(set.rays.size(), threads, Clock::cpu,
                    [&](std::size_t first, std::size_t last) { tracer(set, first, last, out); });
}

class EmbreeScene {
 public:
  EmbreeScene(const backend::TriangleMesh& mesh, RTCBuildQuality quality, RTCSceneFlags flags)
      : device_(rtcNewDevice("threads=1")) {
    for (const backend::Point3& p : mesh.positions) {
      for (const double x : {p.x, p.y, p.z}) vertices_.push_back(static_cast<float>(x));
    }
    vertices_.push_back(0);  // it may read past the last one
    const double start = seconds_now(Clock::cpu);
    const RTCGeometry geometry = rtcNewGeometry(device_, RTC_GEOMETRY_TYPE_TRIANGLE);
    rtcSetSharedGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3,
                               vertices_.data(), 0, 12, mesh.positions.size());
    rtcSetSharedGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3,
                               mesh.faces.data(), 0, 12, mesh.faces.size());
    rtcSetGeometryBuildQuality(geometry, quality);
    rtcCommitGeometry(geometry);
    scene_ = rtcNewScene(device_);
    rtcSetSceneBuildQuality(scene_, quality);
    rtcSetSceneFlags(scene_, flags);
    rtcAttachGeometry(scene_, geometry);
    rtcReleaseGeometry(geometry);
    rtcCommitScene(scene_);
    build_seconds_ = seconds_now(Clock::cpu) - start;
  }
  EmbreeScene(const EmbreeScene&) = delete;
  EmbreeScene& operator=(const EmbreeScene&) = delete;
  ~EmbreeScene() {
    rtcReleaseScene(scene_);
    rtcReleaseDevice(device_);
  }
  [[nodiscard]] double build_seconds() const { return build_seconds_; }

  void trace(const DumpSet& set, std::size_t first, std::size_t last,
             std::vector<DumpHit>& out) const {
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    context.flags = set.name == "primary" ? RTC_INTERSECT_CONTEXT_FLAG_COHERENT
                                          : RTC_INTERSECT_CONTEXT_FLAG_INCOHERENT;
    for (std::size_t i = first; i < last; ++i) {
      const DumpRay& r = set.rays[i];
      RTCRayHit h{};
      h.ray = {r.origin[0],
               r.origin[1],
               r.origin[2],
               r.t_near,
               r.direction[0],
               r.direction[1],
               r.direction[2],
               0,
               r.t_far,
               ~0U,
               0,
               0};
      h.hit.geomID = h.hit.primID = h.hit.instID[0] = RTC_INVALID_GEOMETRY_ID;
      if (set.any_hit) {
        rtcOccluded1(scene_, &context, &h.ray);
        out[i] = {0, h.ray.tfar < 0 ? 1U : 0U};
      } else {
        rtcIntersect1(scene_, &context, &h);
        out[i] = {h.hit.primID == DumpHit::miss ? INFINITY : h.ray.tfar, h.hit.primID};
      }
    }
  }

 private:
  RTCDevice device_;
  RTCScene scene_ = nullptr;
  std::vector<float> vertices_;
  double build_seconds_ = 0;
};

// With flush-to-zero on while it runs.
Tracer flushed(const EmbreeScene& scene) {
  return
      [&scene](const DumpSet& set, std::size_t first, std::size_t last, std::vector<DumpHit>& out) {
        constexpr unsigned flush_and_daz = 0x8040;
        const unsigned before = _mm_getcsr();
        _mm_setcsr(before | flush_and_daz);
        scene.trace(set, first, last, out);
        _mm_setcsr(before);
      };
}

Tracer ours(const SceneAccel& accel) {
  return
      [&accel](const DumpSet& set, std::size_t first, std::size_t last, std::vector<DumpHit>& out) {
        for (std::size_t i = first; i < last; ++i) {
          const Ray ray = ray_of(set.rays[i]);
          if (set.any_hit) {
            out[i] = {0, accel.occluded(ray) ? 1U : 0U};
          } else {
            FoundHit hit;
            out[i] = accel.find(ray, hit) ? DumpHit{static_cast<float>(hit.t), hit.primitive}
                                          : DumpHit{INFINITY, DumpHit::miss};
          }
        }
      };
}

struct Ratios {
  std::vector<double> robust;
  std::vector<double> fastest;
};

void compare_set(DumpSet& set, const backend::TriangleMesh& mesh, const SceneAccel& accel,
                 const EmbreeScene& robust, const EmbreeScene& fastest, const Settings& settings,
                 Ratios& ratios) {
  const Tracer tracers[3] = {ours(accel), flushed(robust), flushed(fastest)};
  double best[3] = {INFINITY, INFINITY, INFINITY};
  std::vector<DumpHit> hits(set.rays.size());
  std::vector<DumpHit> own;
  for (int round = 0; round < settings.rounds; ++round) {
    for (std::size_t k = 0; k < 3; ++k) {
      best[k] = std::min(best[k], time_of(tracers[k], set, settings.threads, hits));
      if (k == 0) own = hits;
    }
  }
  set.hits.resize(set.rays.size());
  robust.trace(set, 0, set.rays.size(), set.hits);  // without flush-to-zero
  const HitComparison c = compare_hits(set, own, mesh, settings.list);
  const double rays = static_cast<double>(set.rays.size()) * 1e-6 * settings.threads;
  ratios.robust.push_back(best[1] / best[0]);
  ratios.fastest.push_back(best[2] / best[0]);
  fmt::print(
      "  {:9} rays {:8} ours {:6.2f} robust {:6.2f} fastest {:6.2f} Mrays/s  "
      "of robust {:.3f}  of fastest {:.3f}  mismatches {} ties {}\n",
      set.name, set.rays.size(), rays / best[0], rays / best[1], rays / best[2],
      ratios.robust.back(), ratios.fastest.back(), c.mismatches, c.ties);
  std::fflush(stdout);
}

bool compare_mesh(const std::string& path, const Settings& settings, Ratios& ratios) {
  auto read = read_bench_mesh(path);
  if (!read) return false;
  const auto mesh = std::make_shared<const backend::TriangleMesh>(
      settings.subdivide ? subdivided(*read) : std::move(*read));
  std::vector<DumpSet> sets = ray_sets_of(*mesh, settings.rays);
  const EmbreeScene robust(*mesh, RTC_BUILD_QUALITY_MEDIUM, RTC_SCENE_FLAG_ROBUST);
  const EmbreeScene fastest(*mesh, RTC_BUILD_QUALITY_HIGH, RTC_SCENE_FLAG_NONE);
  ThreadPool pool(1);
  const double start = seconds_now(Clock::cpu);
  const auto built = std::make_shared<const MeshAccel>(mesh, pool, settings.precision);
  const double seconds = seconds_now(Clock::cpu) - start;
  SceneAccel accel;
  accel.add_mesh(0, built);
  accel.build(pool);
  const double count = static_cast<double>(mesh->faces.size());
  fmt::print(
      "{}: {} triangles; build {:.3f} s ({:.2f} M/s), Embree medium {:.3f}, high {:.3f}; "
      "{:.1f} B a triangle\n",
      path.substr(path.find_last_of('/') + 1), mesh->faces.size(), seconds, count * 1e-6 / seconds,
      robust.build_seconds(), fastest.build_seconds(),
      static_cast<double>(built->tree().bytes()) / count);
  for (DumpSet& set : sets) compare_set(set, *mesh, accel, robust, fastest, settings, ratios);
  return true;
}

double geometric_mean(const std::vector<double>& values) {
  double sum = 0;
  for (const double v : values) sum += std::log(v);
  return std::exp(sum / static_cast<double>(values.size()));
}

int run(int count, char** words) {
  Settings settings;
  Ratios ratios;
  for (int i = 1; i < count; ++i) {
    const std::string_view word = words[i];
    const auto number = [&] { return i + 1 < count ? std::max(1, std::atoi(words[++i])) : 1; };
    if (word == "--resolution") {
      settings.rays.resolution = number();
    } else if (word == "--threads") {
      settings.threads = static_cast<unsigned>(number());
    } else if (word == "--rounds") {
      settings.rounds = number();
    } else if (word == "--list") {
      settings.list = number();
    } else if (word == "--interior") {
      settings.rays.interior = true;
    } else if (word == "--subdivide") {
      settings.subdivide = true;
    } else if (word == "--double") {
      settings.precision = Precision::full;
    } else if (word.starts_with("--") || !compare_mesh(words[i], settings, ratios)) {
      fmt::print(stderr, "scenec-compare-embree: cannot use {}\n", word);
      return 2;
    }
  }
  if (ratios.robust.empty()) return 2;
  fmt::print(
      "{} threads, of robust: geometric mean {:.3f}, smallest {:.3f}; of fastest: {:.3f}, "
      "{:.3f}\n",
      settings.threads, geometric_mean(ratios.robust), std::ranges::min(ratios.robust),
      geometric_mean(ratios.fastest), std::ranges::min(ratios.fastest));
  return 0;
}

}  // namespace
}  // namespace scenec::bench

int main(int argc, char** argv) {
  return scenec::bench::run(argc, argv);
}
