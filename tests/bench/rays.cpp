#include "tests/bench/rays.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <memory>
#include <string>

#include "backend/accel/scene_accel.hpp"
#include "tests/bench/ray_check.hpp"
#include "tests/bench/ray_timing.hpp"

namespace scenec::bench {
namespace {

using backend::FoundHit;
using backend::MeshAccel;
using backend::Ray;
using backend::SceneAccel;

struct Arguments {
  std::string dump;
  std::string mesh;
  unsigned threads = 1;
  int repeat = 5;
  int list = 0;
  bool full_precision = false;
  Clock clock = Clock::wall;
  backend::Target target = backend::best_target();
};

bool parse(int count, char** words, Arguments& out) {
  for (int i = 0; i < count; ++i) {
    const std::string word = words[i];
    const bool has_value = i + 1 < count;
    if (word == "--precision-double") {
      out.full_precision = true;
    } else if (word == "--cpu-time") {
      out.clock = Clock::cpu;
    } else if (word.starts_with("--")) {
      if (!has_value) return false;
      const std::string value = words[++i];
      if (word == "--mesh") {
        out.mesh = value;
      } else if (word == "--threads") {
        out.threads = static_cast<unsigned>(std::max(1, std::atoi(value.c_str())));
      } else if (word == "--repeat") {
        out.repeat = std::max(1, std::atoi(value.c_str()));
      } else if (word == "--list") {
        out.list = std::atoi(value.c_str());
      } else if (word == "--target") {
        const auto target = value == "best" ? backend::best_target() : backend::find_target(value);
        const auto all = backend::available_targets();
        if (!target || std::find(all.begin(), all.end(), *target) == all.end()) return false;
        out.target = *target;
      } else {
        return false;
      }
    } else {
      out.dump = word;
    }
  }
  return !out.dump.empty() && !out.mesh.empty();
}

void trace(const SceneAccel& accel, const DumpSet& set, std::size_t first, std::size_t last,
           std::vector<DumpHit>& out) {
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
}

std::uint64_t checksum_of(const std::vector<DumpHit>& hits) {
  std::uint64_t hash = 1469598103934665603ULL;
  for (const DumpHit& h : hits) hash = (hash ^ h.primitive) * 1099511628211ULL;
  return hash;
}

void run_set(const SceneAccel& accel, const DumpSet& set, const backend::TriangleMesh& mesh,
             const Arguments& arguments) {
  std::vector<DumpHit> hits(set.rays.size());
  std::vector<double> seconds;
  for (int i = 0; i < arguments.repeat; ++i)
    seconds.push_back(seconds_of(
        set.rays.size(), arguments.threads, arguments.clock,
        [&](std::size_t first, std::size_t last) { trace(accel, set, first, last, hits); }));
  std::sort(seconds.begin(), seconds.end());
  const double count = static_cast<double>(set.rays.size()) * 1e-6;
  const HitComparison c = compare_hits(set, hits, mesh, arguments.list);
  fmt::print(
      "set {} mode single rays {} threads {} target {} mrays_best {:.3f} mrays_median {:.3f} "
      "mismatches {} ties {} checksum {:016x}\n",
      set.name, set.rays.size(), arguments.threads, name_of(arguments.target),
      count / seconds.front(), count / seconds[seconds.size() / 2], c.mismatches, c.ties,
      checksum_of(hits));
  std::fflush(stdout);
}

}  // namespace

int run_rays(int count, char** words) {
  Arguments arguments;
  if (!parse(count, words, arguments)) {
    fmt::print(stderr,
               "usage: scenec-bench rays DUMP --mesh FILE [--threads N] [--target "
               "baseline|sse4|avx2|avx512|best] [--repeat N] [--list N]\n");
    return 2;
  }
  const auto dump = read_ray_dump(arguments.dump);
  auto mesh = read_bench_mesh(arguments.mesh);
  if (!dump || !mesh || mesh->faces.size() != dump->triangles) {
    fmt::print(stderr, "scenec-bench: cannot read {} and {}, or they do not fit together\n",
               arguments.dump, arguments.mesh);
    return 1;
  }
  ThreadPool pool(arguments.threads);
  const auto shared = std::make_shared<const backend::TriangleMesh>(std::move(*mesh));
  double best = INFINITY;
  std::shared_ptr<const MeshAccel> built;
  for (int i = 0; i < std::min(arguments.repeat, 3); ++i) {
    built.reset();
    const double start = seconds_now(arguments.clock);
    built = std::make_shared<const MeshAccel>(
        shared, pool,
        arguments.full_precision ? backend::Precision::full : backend::Precision::mixed);
    best = std::min(best, seconds_now(arguments.clock) - start);
  }
  fmt::print("build seconds {:.4f} threads {} bytes_per_triangle {:.1f} nodes {} vertices {}\n",
             best, pool.size(),
             static_cast<double>(built->tree().bytes()) / static_cast<double>(shared->faces.size()),
             built->tree().tree.nodes.size(), built->tree().full() ? "double" : "float");
  SceneAccel accel;
  accel.add_mesh(0, built);
  accel.build(pool, arguments.target);
  for (const DumpSet& set : dump->sets) run_set(accel, set, *shared, arguments);
  return 0;
}

}  // namespace scenec::bench
