// One scene of the daemon: what is wished for it, what was made of it last, what is on the screen
// and how far its picture is. Used by the thread of the render loop.
#pragma once

#include <chrono>
#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <stop_token>
#include <string>
#include <vector>

#include "backend/render_session.hpp"
#include "backend/stop_rule.hpp"
#include "frontend/frontend_cache.hpp"
#include "ir/diff.hpp"
#include "runtime/watch/attempt.hpp"
#include "runtime/watch/frame_bytes.hpp"

namespace scenec::runtime {

using WatchClock = std::chrono::steady_clock;

// What the author wants to see; changed from any thread, under the loop's lock.
struct Wishes {
  std::uint64_t version = 1;                  // grows with every change
  std::uint64_t files_version = 1;            // with those that call for a new attempt
  std::map<std::string, std::string> params;  // set on the page, as source text
  std::optional<ir::Camera> camera;           // moved on the page
  std::uint64_t camera_version = 0;           // grows when it moves
  std::optional<ir::Region> region;           // drawn on the page
  bool paused = false;
  WatchClock::time_point since;  // of the last change
};

// A consistent view for other threads.
struct Shown {
  std::shared_ptr<const Attempt> attempt;           // that gave the picture
  std::shared_ptr<const Attempt> latest;            // may have failed
  std::shared_ptr<const backend::Picture> picture;  // linear; null: none yet
  FrameInfo frame;                                  // of the picture
  std::optional<ir::RenderSettings> settings;       // of the picture
  std::shared_ptr<const World> world;               // of the picture
  std::optional<ir::Camera> camera;                 // instead of the scene's
};

// Milliseconds from the change to what came of it.
struct WatchTimes {
  double made = 0;  // compiled and built, or refused
  std::optional<double> first_picture;
  std::optional<double> finished;
};

struct CurvePoint {
  double seconds = 0;
  std::int64_t samples = 0;
  backend::ErrorEstimate error;
};

class WatchedScene {
 public:
  WatchedScene(std::size_t number, Options options)
      : number_(number), options_(std::move(options)) {}

  // Makes the scene anew from its files and parameters.
  [[nodiscard]] std::shared_ptr<const Attempt> attempt(const Wishes& wishes, ThreadPool& pool,
                                                       backend::SceneMemory& memory,
                                                       ContentCache* cache,
                                                       std::function<bool()> files_change);
  enum class Outcome : std::uint8_t { failed, unchanged, changed };
  // Takes the attempt as the latest one.
  Outcome adopt(std::shared_ptr<const Attempt> attempt, const Wishes& wishes);
  // Begins another picture: of a scene that has changed, or seen differently.
  void begin_picture(const Wishes& wishes, ThreadPool& pool);
  // What is to be seen is not what is being pictured.
  [[nodiscard]] bool wants_new_picture(const Wishes& wishes) const;

  // One step towards the finished picture; the first one is a coarse picture. False: broken off.
  bool refine(const std::stop_token& stop);
  [[nodiscard]] bool has_coarse() const { return generation_shown_ == generation_; }
  [[nodiscard]] bool wants_refining() const { return stop_ && !finished_; }
  // Whether the last step is to be shown now, or has come too soon behind the one shown.
  [[nodiscard]] bool has_news(WatchClock::time_point now) const;
  // The picture as it is; for showing.
  [[nodiscard]] std::shared_ptr<const backend::Picture> take_picture(WatchClock::time_point now);

  [[nodiscard]] std::size_t number() const { return number_; }
  [[nodiscard]] const Options& options() const { return options_; }
  [[nodiscard]] const std::string& path() const { return options_.operands.at(0); }
  [[nodiscard]] const std::shared_ptr<const Attempt>& latest() const { return latest_; }
  [[nodiscard]] const std::shared_ptr<const Attempt>& shown() const { return shown_; }
  [[nodiscard]] bool is_stale() const { return shown_ && latest_ && latest_->failed(); }
  [[nodiscard]] bool finished() const { return finished_; }
  [[nodiscard]] const std::optional<ir::RenderSettings>& settings() const { return settings_; }
  [[nodiscard]] const std::optional<ir::Camera>& camera() const { return camera_; }
  [[nodiscard]] const ir::EffectReport& effects() const { return effects_; }
  [[nodiscard]] const std::vector<CurvePoint>& curve() const { return curve_; }
  [[nodiscard]] const WatchTimes& times() const { return times_; }
  [[nodiscard]] std::int64_t samples() const { return session_ ? session_->samples() : 0; }
  [[nodiscard]] std::int64_t sample_cap() const { return stop_ ? stop_->cap() : 0; }
  [[nodiscard]] FrameInfo frame_info() const;
  [[nodiscard]] const std::string& change() const { return change_; }
  // What distinguishes the scene that is shown from the one before it; known once `find_changes`
  // was called, which takes time and may wait for the first picture.
  [[nodiscard]] const std::vector<ir::PartChange>& changes() const { return changes_; }
  void find_changes();
  [[nodiscard]] Shown view() const;
  // Milliseconds since the change that is shown.
  [[nodiscard]] double since_change(WatchClock::time_point now) const;

 private:
  bool refine_coarse(const std::stop_token& stop);
  bool refine_full(const std::stop_token& stop);

  std::size_t number_;
  Options options_;
  // Small: ten thousand edits must not make the daemon grow.
  frontend::FrontendCache texts_{std::size_t{64} << 20, std::size_t{8} << 20, 16};
  backend::TreeStore trees_;
  std::shared_ptr<const Attempt> latest_;
  std::shared_ptr<const Attempt> shown_;
  std::shared_ptr<const World> compared_;  // what was shown before, until compared with
  std::vector<ir::PartChange> changes_;

  // The picture in the making.
  std::optional<ir::RenderSettings> settings_;
  std::optional<ir::Camera> camera_;
  std::uint64_t camera_version_ = 0;
  std::optional<ir::Region> wished_region_;
  std::shared_ptr<const World> world_;  // outlives the session
  ir::EffectReport effects_;
  ThreadPool* pool_ = nullptr;
  std::optional<backend::RenderSession> session_;  // from full resolution on
  std::optional<backend::StopRule> stop_;
  std::shared_ptr<const backend::Picture> picture_;
  int step_ = 1;  // of the last picture: 1 is full resolution
  int next_step_ = 1;
  bool finished_ = false;
  bool fresh_ = false;  // a step was done that has not been shown
  double render_seconds_ = 0;
  double seconds_per_sample_ = 0;  // of a pixel, measured; 0: not known
  std::vector<CurvePoint> curve_;

  std::uint32_t generation_ = 0;
  std::uint32_t generation_shown_ = 0;
  WatchClock::time_point changed_;
  WatchClock::time_point begun_;
  WatchClock::time_point last_shown_;
  WatchTimes times_;
  std::string change_;
};

}  // namespace scenec::runtime
