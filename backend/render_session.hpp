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

namespace scenec::backend {

// Not to be used by two threads at a time; `stop` may be asked for from any.
class RenderSession {
 public:
  // Scene and pool must outlive the session. `samples` and `stop` of the settings are not looked
  // at: whoever calls advance() decides. `camera`, when there is one, is seen through instead of
  // the one of the settings.
  RenderSession(const RenderScene& scene, const ir::RenderSettings& settings,
                const ir::EffectSet& effects, ThreadPool& pool,
                KernelChoice kernel = KernelChoice::smallest, const ir::Camera* camera = nullptr);
  ~RenderSession();
  RenderSession(RenderSession&&) noexcept;
  RenderSession& operator=(RenderSession&&) noexcept;

  // Called from worker threads with the part of the round that is done, after every tile.
  using PartFunction = std::function<void(double)>;
  // Gives every pixel `samples` more. False when it was stopped: it returns within milliseconds,
  // the round is dropped and the samples of finished rounds stay; advance() may be called again.
  bool advance(std::int64_t samples, const std::stop_token& stop = {},
               const PartFunction& part_done = {});

  [[nodiscard]] std::int64_t samples() const;  // a pixel, of finished rounds
  [[nodiscard]] Picture picture() const;       // of finished rounds, with the layers asked for
  [[nodiscard]] ErrorEstimate error() const;
  [[nodiscard]] std::uint64_t rays() const;  // dropped rounds included

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

}  // namespace scenec::backend
