// A picture in the making: refined by rounds of samples, looked at between them, saved and taken up
// again. Everything that renders goes through one: a render to the end, the watch daemon, a study.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <stop_token>
#include <string>
#include <string_view>

#include "backend/backend.hpp"
#include "backend/sample_plan.hpp"

namespace scenec::backend {

// Not to be used by two threads at a time; `stop` may be asked for from any.
class RenderSession {
 public:
  // Scene and pool must outlive the session. `samples` and `stop` of the settings are not looked
  // at: whoever calls advance() decides. `camera`, when there is one, is seen through instead of
  // the one of the settings.
  RenderSession(const RenderScene& scene, const ir::RenderSettings& settings,
                const ir::EffectSet& effects, ThreadPool& pool,
                KernelChoice kernel = KernelChoice::smallest, const ir::Camera* camera = nullptr,
                SampleSpread spread = SampleSpread::even);
  ~RenderSession();
  RenderSession(RenderSession&&) noexcept;
  RenderSession& operator=(RenderSession&&) noexcept;

  // Called from worker threads with the part of the round that is done, after every tile.
  using PartFunction = std::function<void(double)>;
  // Gives the pixels `samples` more: every one, or on average. False when it was stopped: it
  // returns within milliseconds, the round is dropped and the samples of finished rounds stay;
  // advance() may be called again.
  bool advance(std::int64_t samples, const std::stop_token& stop = {},
               const PartFunction& part_done = {});

  [[nodiscard]] std::int64_t samples() const;  // a pixel on average, of finished rounds
  [[nodiscard]] Picture picture() const;       // of finished rounds, with the layers asked for
  [[nodiscard]] ErrorEstimate error() const;
  [[nodiscard]] RayCounts rays() const;        // of this process, stopped rounds included
  [[nodiscard]] std::uint64_t memory() const;  // bytes of the sums it keeps

  // The sums of finished rounds as bytes, for this machine's builds of the same scene and settings;
  // what a session takes up from them goes on to the same bytes. The caller says what they belong
  // to; restore() refuses (false, nothing changed) only what cannot be sums of this picture.
  [[nodiscard]] std::string save() const;
  [[nodiscard]] bool restore(std::string_view bytes);

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

// A picture of 1/step the width and height with one sample a pixel, for a first look before a
// session takes the memory for its sums; nullopt when it was stopped. Costs 1/step^2 of a sample;
// nothing of it is kept.
[[nodiscard]] std::optional<Picture> coarse_picture(const RenderScene& scene,
                                                    const ir::RenderSettings& settings,
                                                    const ir::EffectSet& effects, ThreadPool& pool,
                                                    int step, const std::stop_token& stop,
                                                    const ir::Camera* camera = nullptr);

enum class StopReason : std::uint8_t { samples, error, time, request };

// What a render to the end must know beside the session to be taken up again.
struct StopState {
  bool error_reached = false;  // at the last of the points where it was looked at
  double seconds = 0;          // rendered so far
};
struct RenderHooks {
  ProgressFunction progress;           // from worker threads
  std::function<void()> between = {};  // after every finished round, from the caller's thread
};
// Advances the session until the settings' `samples` and `stop` hold, whichever comes first.
//
// `stop.error` is looked at where the samples have grown by an eighth, from 64 on, and holds when
// it did the last time too: with the same scene, seed and binary it stops at the same sample, with
// any threads and however often the render was taken up again. Other rules hold at round's ends;
// rounds take a second or two.
StopReason render_to_end(RenderSession& session, const ir::RenderSettings& settings,
                         const std::stop_token& stop, const RenderHooks& hooks, StopState& state);

}  // namespace scenec::backend
