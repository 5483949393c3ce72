// The back end's entrances: prepare (read assets, examine geometry), build (accelerators), render.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <stop_token>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "backend/accel/precision.hpp"
#include "backend/accel/target.hpp"
#include "base/content_cache.hpp"
#include "base/diagnostic.hpp"
#include "base/file_system.hpp"
#include "base/limits.hpp"
#include "base/parallel.hpp"
#include "ir/effects.hpp"
#include "ir/scene.hpp"

namespace scenec::backend {

// The scene with its meshes and images in memory. Shares the IR scene, which must outlive it.
struct PreparedScene;
// Accelerators and kernels' data; immutable, used by any number of threads.
struct RenderScene;
class TreeStore;  // backend/accel/tree_store.hpp
void destroy(PreparedScene* scene);
void destroy(RenderScene* scene);
struct Destroy {
  template <class T>
  void operator()(T* scene) const {
    destroy(scene);
  }
};
using PreparedPtr = std::unique_ptr<PreparedScene, Destroy>;
using RenderScenePtr = std::unique_ptr<RenderScene, Destroy>;

// Reads and checks every asset the scene names and examines the geometry (degenerate faces, lights
// inside geometry); reports with origins from the IR. Null when there was an error. A mesh file
// that `cache` has by the hash the front end took of it is not decoded again; null: no cache. An
// asset beyond `limits` is an error.
[[nodiscard]] PreparedPtr prepare(const ir::Scene& scene, FileSystem& files, ThreadPool& pool,
                                  DiagnosticSink& sink, ContentCache* cache = nullptr,
                                  const Limits& limits = {});

struct BuildOptions {
  ContentCache* cache = nullptr;  // a tree it has for a mesh is not built again
  TreeStore* trees = nullptr;     // the same in memory, for builds that follow each other
  // May move what is seen by the rounding of a vertex; the picture of either is deterministic.
  Precision precision = Precision::mixed;
  Target target = best_target();  // of no influence on any hit
};
[[nodiscard]] RenderScenePtr build(const PreparedScene& prepared, ThreadPool& pool,
                                   const BuildOptions& options = {});

// What the picture depends on, images included, and why (ir/effects.hpp).
[[nodiscard]] ir::EffectReport find_effects(const RenderScene& scene,
                                            const ir::RenderSettings& settings);

// A figure and the band that holds the true one 95 times in 100.
struct ErrorBand {
  double value = 0;
  double low = 0;
  double high = 0;
};
// How far the picture is from the one that infinitely many samples would give.
struct ErrorEstimate {
  bool known = false;  // false: too few samples to say anything; the figures are 0
  ErrorBand relative;  // the language's `error`: sqrt(relMSE)
  ErrorBand absolute;  // RMSE
};

// `fraction` in [0, 1] of the work asked for; called from worker threads, at most every few ms.
struct Progress {
  double fraction = 0;
  std::int64_t samples_done = 0;   // a pixel, in finished rounds
  ErrorEstimate error{};           // of a finished round, not always the last one
  std::int64_t error_samples = 0;  // of that round
  double seconds_a_sample = 0;     // of a pixel; 0: not known yet
};
using ProgressFunction = std::function<void(const Progress&)>;

// What a ray was traced for.
enum class RayKind : std::uint8_t {
  camera,
  reflected,  // by something exactly smooth
  refracted,  // by smooth or rough glass
  bounced,    // from a matt or glossy surface
  shadow,
  light,  // to a light whose radiance varies over it, for the radiance there
};
inline constexpr std::array<std::string_view, 6> ray_kind_names{"camera",  "reflected", "refracted",
                                                                "bounced", "shadow",    "light"};
using RayCounts = std::array<std::uint64_t, ray_kind_names.size()>;
[[nodiscard]] constexpr std::uint64_t total_of(const RayCounts& rays) {
  std::uint64_t sum = 0;
  for (const std::uint64_t count : rays) sum += count;
  return sum;
}

// Linear radiance before exposure, float32, row 0 at the top, three floats a pixel; plus named
// layers (EXR channel name, e.g. "albedo.R").
struct Picture {
  int width = 0;
  int height = 0;
  std::vector<float> rgb;
  std::vector<float> alpha;
  std::vector<std::pair<std::string, std::vector<float>>> layers;
  std::int64_t samples = 0;             // a pixel, of the finished rounds
  bool complete = true;                 // false after a stop request
  std::uint64_t dropped_samples = 0;    // not finite: counted, never averaged
  std::uint64_t saturated_samples = 0;  // beyond what a sum holds: cut to it
  RayCounts rays{};                     // of this process, stopped rounds included
  // How often code ran that only this effect calls for; 0 for effects that are not simulated.
  std::array<std::uint64_t, ir::effect_count> effect_runs{};
  std::uint64_t forgotten_media = 0;  // bodies in more than eight others: the outermost was dropped
};

// Which of the compiled kernels renders a picture simulated with `effects`: the smallest that holds
// them, or the one that holds all. No choice changes a bit of the picture.
enum class KernelChoice : std::uint8_t {
  smallest,
  full,
  probing,  // all effects, and tells what it does: see backend/render_profile.hpp
};
struct KernelSummary {
  std::string_view name;
  ir::EffectSet surplus;  // compiled in beyond `effects`; switched off while it runs
};
[[nodiscard]] KernelSummary kernel_for(ir::Method method, const ir::EffectSet& effects,
                                       KernelChoice choice = KernelChoice::smallest);

// Renders with `settings` (the scene's, or the scene's with the command line's changes). The bytes
// of the picture depend on scene, settings and build only: not on threads, tiles or time. After a
// stop request it returns within milliseconds with the samples every pixel has in common.
[[nodiscard]] Picture render(const RenderScene& scene, const ir::RenderSettings& settings,
                             ThreadPool& pool, std::stop_token stop,
                             const ProgressFunction& progress);
// The same with these effects instead of those the settings call for: for tests, which hold the
// picture to depend on no others, and for pricing an effect.
[[nodiscard]] Picture render(const RenderScene& scene, const ir::RenderSettings& settings,
                             const ir::EffectSet& effects, ThreadPool& pool, std::stop_token stop,
                             const ProgressFunction& progress,
                             KernelChoice kernel = KernelChoice::smallest);

// Bytes of the picture as a file. 8-bit formats apply exposure and tonemap (film .course:
// truncation without a curve); EXR holds linear float32.
enum class ImageFormat : std::uint8_t { png, exr, bmp };
[[nodiscard]] std::optional<ImageFormat> image_format_of(const std::string& path);
struct EncodeOptions {
  bool half = false;
  std::vector<std::pair<std::string, std::string>> metadata;  // "scenec/scene_hash" -> ...
};
[[nodiscard]] std::string encode(const Picture& picture, const ir::RenderSettings& settings,
                                 ImageFormat format, const EncodeOptions& options);

}  // namespace scenec::backend
