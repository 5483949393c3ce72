// The thread that makes pictures: compiles scenes whose files have changed, shows a coarse picture
// first and refines it until the scene's stop rule holds. A change breaks the refining off at once,
// but never the coarse picture: under a stream of edits pictures keep coming.
#pragma once

#include <condition_variable>
#include <cstddef>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <stop_token>
#include <string>
#include <thread>
#include <vector>

#include "base/content_cache.hpp"
#include "base/parallel.hpp"
#include "runtime/environment.hpp"
#include "runtime/watch/board.hpp"
#include "runtime/watch/file_watcher.hpp"
#include "runtime/watch/watched_scene.hpp"

namespace scenec::runtime {

// What is told beside the pages: to the terminal, to files, to viewers. Called on the loop's
// thread.
class WatchListener {
 public:
  virtual ~WatchListener() = default;
  virtual void attempted(const WatchedScene& scene) = 0;
  virtual void pictured(const WatchedScene& scene,
                        const std::shared_ptr<const backend::Picture>& picture) = 0;
};

class RenderLoop {
 public:
  // The options hold for every scene.
  RenderLoop(const Options& options, std::vector<std::string> scenes,
             const Environment& environment, Board& board, WatchListener& listener);
  ~RenderLoop();
  RenderLoop(const RenderLoop&) = delete;
  RenderLoop& operator=(const RenderLoop&) = delete;

  // Starts the thread. The watcher must live until stop() has returned.
  void start(FileWatcher& watcher);
  void stop();

  // From any thread:
  void files_settled(const FilesSettled& settled);
  // The scenes there are from now on. Each keeps its number, also while it is gone.
  void set_scenes(std::vector<std::string> names);
  void add_notice(const std::string& text);
  // What an author asks for on the page. `change` runs under the loop's lock and says whether the
  // scene must be made anew for it.
  enum class Need : std::uint8_t { nothing, picture, attempt };
  void wish(std::size_t scene, const std::function<Need(Wishes&)>& change);
  [[nodiscard]] Wishes wishes(std::size_t scene) const;
  // What is on the screen.
  [[nodiscard]] Shown shown(std::size_t scene) const;
  [[nodiscard]] std::size_t scene_count() const;

 private:
  struct Job {
    std::size_t scene = 0;
    bool make = false;   // a new attempt
    bool begin = false;  // a new picture
    Wishes wishes{};
    std::stop_token stop{};
  };
  // What has been done of what is wished, by scene.
  struct Done {
    std::uint64_t version = 0;
    std::uint64_t files_version = 0;
    // Made while files were changing, and not shown: to be made again when they have settled.
    bool withheld = false;
    std::optional<WatchClock::time_point> withheld_since;
  };
  void run(const std::stop_token& stop);
  [[nodiscard]] std::optional<Job> next_job(const std::stop_token& stop);
  [[nodiscard]] std::optional<Job> find_job();
  void take_scenes(std::vector<std::string> names);
  void drop(std::size_t scene);
  [[nodiscard]] std::string list_json() const;
  [[nodiscard]] bool wants_refining(std::size_t scene) const;
  void work(const Job& job, const std::stop_token& stop);
  // False when there is nothing to show for it.
  bool make(const Job& job);
  bool withhold(std::size_t scene, const Attempt& attempt);
  void show(WatchedScene& scene);
  void break_off();
  void give_way(std::size_t scene);
  void watch_files(const WatchedScene& scene);

  const Options& options_;
  bool has_list_;  // of scenes, for the page to choose from
  Board& board_;
  WatchListener& listener_;
  FileWatcher* watcher_ = nullptr;
  ThreadPool pool_;
  backend::SceneMemory memory_;
  std::optional<ContentCache> cache_;
  std::vector<std::unique_ptr<WatchedScene>> scenes_;
  std::size_t turn_ = 0;  // of the scenes that are refined
  WatchClock::time_point give_way_until_{};

  mutable std::mutex mutex_;
  std::condition_variable_any awake_;
  std::vector<Wishes> wishes_;
  std::vector<Done> done_;
  std::vector<Shown> shown_;
  std::vector<bool> listed_;  // by scene: not gone
  std::optional<std::vector<std::string>> new_names_;
  std::vector<std::string> notices_;
  std::stop_source breakable_;                   // of the job that may be broken off now
  bool refining_ = false;                        // the job at hand is one
  std::optional<WatchClock::time_point> asked_;  // when it was asked to end
  std::optional<double> broken_off_ms_;          // from there to the job after it, the last time
  std::jthread thread_;
};

}  // namespace scenec::runtime
