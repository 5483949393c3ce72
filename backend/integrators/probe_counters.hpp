// What a probing kernel finds out while it traces a few samples once more: where the time goes, or
// how much its rays test. Never both at once, as counting takes time.
//
// Times are ticks of the processor's own counter, of use only in relation to each other.
#pragma once

#include <array>
#include <chrono>
#include <cstddef>
#include <cstdint>

#include "backend/accel/scene_accel.hpp"
#include "backend/backend.hpp"

namespace scenec::backend {

// What a kernel does: it follows rays of each kind (the first stages, in the order of RayKind),
// chooses lights and draws points of them, resolves and asks materials. The rest has no stage.
enum class RenderStage : std::uint8_t { lights = ray_kind_names.size(), materials };
inline constexpr std::size_t render_stage_count = ray_kind_names.size() + 2;
[[nodiscard]] constexpr RenderStage stage_of(RayKind kind) {
  return static_cast<RenderStage>(kind);
}

[[nodiscard]] inline std::uint64_t ticks_now() {
#if defined(__x86_64__)
  return __builtin_ia32_rdtsc();
#else
  return static_cast<std::uint64_t>(std::chrono::steady_clock::now().time_since_epoch().count());
#endif
}

struct ProbeCounters {
  enum class Mode : std::uint8_t { time, tests };
  struct Stage {
    std::uint64_t ticks = 0;
    std::uint64_t calls = 0;
  };
  struct Tests {
    std::uint64_t rays = 0;
    TestCounts tests;
  };

  Mode mode = Mode::time;
  std::array<Stage, render_stage_count> stages{};
  std::array<Tests, ray_kind_names.size()> rays{};

  void count_tests(RayKind kind, const SceneAccel& accel, const Ray& ray, const HitFilter& filter) {
    if (mode != Mode::tests) return;
    Tests& of_kind = rays[static_cast<std::size_t>(kind)];
    ++of_kind.rays;
    accel.count_tests(ray, kind == RayKind::shadow ? Search::any : Search::closest, filter,
                      of_kind.tests);
  }
};

// Adds the time of its life to a stage.
class StageClock {
 public:
  StageClock(ProbeCounters& probe, RenderStage stage)
      : stage_(probe.mode == ProbeCounters::Mode::time
                   ? &probe.stages[static_cast<std::size_t>(stage)]
                   : nullptr),
        start_(stage_ != nullptr ? ticks_now() : 0) {}
  ~StageClock() {
    if (stage_ == nullptr) return;
    stage_->ticks += ticks_now() - start_;
    ++stage_->calls;
  }
  StageClock(const StageClock&) = delete;
  StageClock& operator=(const StageClock&) = delete;

 private:
  ProbeCounters::Stage* stage_;
  std::uint64_t start_;
};

}  // namespace scenec::backend
