#include "runtime/watch/render_loop.hpp"

#include <algorithm>
#include <utility>

#include "runtime/cache.hpp"
#include "runtime/watch/state_json.hpp"

namespace scenec::runtime {

RenderLoop::RenderLoop(const Options& options, std::vector<std::string> scenes,
                       const Environment& environment, Board& board, WatchListener& listener)
    : options_(options),
      has_list_(scenes != options.operands || scenes.size() != 1),
      board_(board),
      listener_(listener),
      pool_(static_cast<unsigned>(options.threads.value_or(0))) {
  if (auto kept = cache_options_of(options, environment)) cache_.emplace(std::move(*kept));
  take_scenes(std::move(scenes));
}

RenderLoop::~RenderLoop() {
  stop();
}

void RenderLoop::start(FileWatcher& watcher) {
  watcher_ = &watcher;
  thread_ = std::jthread([this](const std::stop_token& stop) { run(stop); });
}

void RenderLoop::stop() {
  if (!thread_.joinable()) return;
  thread_.request_stop();
  {
    const std::lock_guard lock(mutex_);
    breakable_.request_stop();
  }
  awake_.notify_all();
  thread_.join();
}

// ---- from other threads

void RenderLoop::files_settled(const FilesSettled& settled) {
  const std::lock_guard lock(mutex_);
  for (const std::size_t scene : settled.touched) {
    const bool again = std::exchange(done_[scene].withheld, false);
    if (!again && !settled.changed.contains(scene)) continue;
    wishes_[scene].since = settled.last;
    ++wishes_[scene].version;
    ++wishes_[scene].files_version;
  }
  break_off();
}

// Under the lock.
void RenderLoop::break_off() {
  if (refining_ && !asked_) asked_ = WatchClock::now();
  breakable_.request_stop();
  awake_.notify_all();
}

void RenderLoop::set_scenes(std::vector<std::string> names) {
  const std::lock_guard lock(mutex_);
  new_names_ = std::move(names);
  break_off();
}

std::size_t RenderLoop::scene_count() const {
  const std::lock_guard lock(mutex_);
  return wishes_.size();
}

void RenderLoop::add_notice(const std::string& text) {
  const std::lock_guard lock(mutex_);
  notices_.push_back(text);
  if (has_list_) board_.put_list(list_json());
  for (Wishes& wishes : wishes_) ++wishes.version;
  awake_.notify_all();
}

void RenderLoop::wish(std::size_t scene, const std::function<Need(Wishes&)>& change) {
  const std::lock_guard lock(mutex_);
  const Need need = change(wishes_[scene]);
  if (need == Need::nothing) return;
  wishes_[scene].since = WatchClock::now();
  ++wishes_[scene].version;
  if (need == Need::attempt) ++wishes_[scene].files_version;
  break_off();
}

Wishes RenderLoop::wishes(std::size_t scene) const {
  const std::lock_guard lock(mutex_);
  return wishes_[scene];
}

Shown RenderLoop::shown(std::size_t scene) const {
  const std::lock_guard lock(mutex_);
  return shown_[scene];
}

// ---- the loop

void RenderLoop::run(const std::stop_token& stop) {
  while (auto job = next_job(stop)) work(*job, stop);
}

bool RenderLoop::wants_refining(std::size_t scene) const {
  return scenes_[scene]->wants_refining() && !wishes_[scene].paused;
}

// Changes first, of scenes that somebody looks at before others; then a step of refining, in turn.
std::optional<RenderLoop::Job> RenderLoop::find_job() {
  std::optional<std::size_t> found;
  for (std::size_t i = 0; i < scenes_.size(); ++i) {
    if (done_[i].version == wishes_[i].version) continue;
    if (!found || (board_.slot(i).viewers > 0 && board_.slot(*found).viewers == 0)) found = i;
  }
  if (found) {
    Job job{.scene = *found, .begin = true, .wishes = wishes_[*found]};
    job.make = done_[*found].files_version != wishes_[*found].files_version;
    done_[*found].version = wishes_[*found].version;
    done_[*found].files_version = wishes_[*found].files_version;
    return job;
  }
  if (WatchClock::now() < give_way_until_) return std::nullopt;
  for (const bool viewed : {true, false}) {
    for (std::size_t k = 1; k <= scenes_.size(); ++k) {
      const std::size_t i = (turn_ + k) % scenes_.size();
      if (!wants_refining(i) || (board_.slot(i).viewers > 0) != viewed) continue;
      turn_ = i;
      return Job{.scene = i, .wishes = wishes_[i]};
    }
  }
  return std::nullopt;
}

std::optional<RenderLoop::Job> RenderLoop::next_job(const std::stop_token& stop) {
  std::unique_lock lock(mutex_);
  std::optional<Job> job;
  if (!asked_) refining_ = false;
  const auto is_there = [&] {
    if (new_names_) take_scenes(*std::exchange(new_names_, std::nullopt));
    return (job = find_job()).has_value();
  };
  if (!awake_.wait_until(lock, stop, give_way_until_, is_there)) awake_.wait(lock, stop, is_there);
  if (stop.stop_requested()) return std::nullopt;
  if (const auto asked = std::exchange(asked_, std::nullopt))
    broken_off_ms_ = std::chrono::duration<double, std::milli>(WatchClock::now() - *asked).count();
  refining_ = !job->make && !job->begin && scenes_[job->scene]->has_coarse();
  breakable_ = std::stop_source();
  job->stop = breakable_.get_token();
  return job;
}

void RenderLoop::work(const Job& job, const std::stop_token& stop) {
  WatchedScene& scene = *scenes_[job.scene];
  if (job.make && !make(job)) return;
  if (job.begin) {
    if (!scene.shown()) return;
    if (!scene.wants_new_picture(job.wishes)) {
      show(scene);
      return;
    }
    scene.begin_picture(job.wishes, pool_);
  }
  // A first look is finished whatever comes; only the end of the program breaks it off.
  const std::stop_token breaks = scene.has_coarse() ? job.stop : stop;
  if (!scene.wants_refining()) return;
  if (!scene.refine(breaks) || !scene.has_news(WatchClock::now())) return;
  const bool is_first = !scene.has_coarse();
  if (!is_first && job.stop.stop_requested()) return;  // shown with what comes of the change
  show(scene);
  if (is_first) give_way(job.scene);
}

// Browsers need processors too: refining begins when a first picture, or a message, has had the
// time to be painted.
void RenderLoop::give_way(std::size_t scene) {
  constexpr std::chrono::milliseconds painting{30};
  if (board_.slot(scene).viewers > 0) give_way_until_ = WatchClock::now() + painting;
}

bool RenderLoop::make(const Job& job) {
  WatchedScene& scene = *scenes_[job.scene];
  auto attempt = scene.attempt(job.wishes, pool_, memory_, cache_ ? &*cache_ : nullptr,
                               [&] { return watcher_->is_restless(job.scene); });
  if (scene.latest() && withhold(job.scene, *attempt)) {
    watcher_->watch(job.scene, attempt->files);
    return false;
  }
  const auto outcome = scene.adopt(std::move(attempt), job.wishes);
  watch_files(scene);
  listener_.attempted(scene);
  if (outcome == WatchedScene::Outcome::changed) return true;
  show(scene);
  if (outcome == WatchedScene::Outcome::failed) give_way(job.scene);
  return outcome == WatchedScene::Outcome::unchanged;
}

// What is perhaps a mixture of two states of the files is not shown: it is made again when they
// have settled. Where that never happens, a picture now and then is better than none.
bool RenderLoop::withhold(std::size_t scene, const Attempt& attempt) {
  constexpr std::chrono::seconds longest{1};
  const std::lock_guard lock(mutex_);
  Done& done = done_[scene];
  const auto now = WatchClock::now();
  // Settled by now: the event has come already, and another attempt with it if bytes have changed.
  const bool to_come = attempt.mixed && watcher_->is_restless(scene);
  if (!to_come || (done.withheld_since && now - *done.withheld_since > longest)) {
    done.withheld_since.reset();
    return false;
  }
  if (!done.withheld_since) done.withheld_since = now;
  done.withheld = true;
  return true;
}

void RenderLoop::watch_files(const WatchedScene& scene) {
  std::vector<FileRecord> files = scene.latest()->files;
  // After a mistake less was read than the scene is made of: what the last good one has read is
  // still of interest.
  if (scene.is_stale()) {
    for (const FileRecord& old : scene.shown()->files) {
      const bool known = std::any_of(files.begin(), files.end(),
                                     [&](const FileRecord& f) { return f.path == old.path; });
      if (!known) files.push_back(old);
    }
  }
  watcher_->watch(scene.number(), std::move(files));
}

void RenderLoop::show(WatchedScene& scene) {
  if (scene.has_news(WatchClock::now())) {
    const auto picture = scene.take_picture(WatchClock::now());
    board_.put_frame(scene.number(), frame_bytes(*picture, scene.frame_info()));
    scene.find_changes();
    listener_.pictured(scene, picture);
  }
  WatchContext context;
  Wishes wished;
  {
    const std::lock_guard lock(mutex_);
    shown_[scene.number()] = scene.view();
    context.notices = notices_;
    context.broken_off_ms = broken_off_ms_;
    wished = wishes_[scene.number()];
  }
  board_.put_state(scene.number(), state_json(scene, wished, context));
}

}  // namespace scenec::runtime
