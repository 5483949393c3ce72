#include "runtime/watch/watched_scene.hpp"

#include <algorithm>
#include <utility>

namespace scenec::runtime {

namespace {

// A first look should not take longer than a frame of a film.
constexpr double first_look_seconds = 0.025;
constexpr int coarsest_step = 16;
constexpr std::size_t most_curve_points = 240;
// Comparing takes about a microsecond and 200 bytes an item.
constexpr std::size_t most_compared_items = 400'000;

double milliseconds(WatchClock::duration duration) {
  return std::chrono::duration<double, std::milli>(duration).count();
}

std::int64_t pixel_count(const ir::RenderSettings& settings) {
  if (const auto& r = settings.region) return (r->x1 - r->x0) * (r->y1 - r->y0);
  return settings.size.width * settings.size.height;
}

}  // namespace

std::shared_ptr<const Attempt> WatchedScene::attempt(const Wishes& wishes, ThreadPool& pool,
                                                     backend::SceneMemory& memory,
                                                     ContentCache* cache,
                                                     std::function<bool()> files_change) {
  Options options = options_;
  for (const auto& [name, value] : wishes.params) {
    std::erase_if(options.settings, [&](const NameAndValue& s) { return s.name == name; });
    options.settings.push_back({name, value});
  }
  const Workbench bench{.pool = pool,
                        .texts = texts_,
                        .memory = memory,
                        .trees = trees_,
                        .cache = cache,
                        .files_change = std::move(files_change)};
  return make_attempt(options, bench, shown_.get());
}

double WatchedScene::since_change(WatchClock::time_point now) const {
  return milliseconds(now - changed_);
}

WatchedScene::Outcome WatchedScene::adopt(std::shared_ptr<const Attempt> attempt,
                                          const Wishes& wishes) {
  changed_ = wishes.since;
  times_ = {.made = since_change(WatchClock::now()), .first_picture = {}, .finished = {}};
  latest_ = std::move(attempt);
  if (latest_->failed()) return Outcome::failed;
  const bool same = shown_ && shown_->world == latest_->world;
  if (!same && shown_ && !compared_) compared_ = shown_->world;
  if (same) changes_.clear();
  shown_ = latest_;
  change_ = same ? "no visible change" : "";
  return same ? Outcome::unchanged : Outcome::changed;
}

void WatchedScene::find_changes() {
  const std::shared_ptr<const World> before = std::exchange(compared_, nullptr);
  if (!before) return;
  changes_.clear();
  const ir::Scene& old = *before->scene;
  const ir::Scene& now = *shown_->world->scene;
  if (old.items.size() + now.items.size() > most_compared_items) {
    change_ = "too many items to be compared one by one";
    return;
  }
  changes_ = ir::changes_between(old, now);
}

bool WatchedScene::wants_new_picture(const Wishes& wishes) const {
  if (!stop_ || world_ != shown_->world || wished_region_ != wishes.region) return true;
  return camera_version_ != wishes.camera_version;
}

void WatchedScene::begin_picture(const Wishes& wishes, ThreadPool& pool) {
  changed_ = wishes.since;
  times_.first_picture.reset();
  times_.finished.reset();
  camera_ = wishes.camera;
  camera_version_ = wishes.camera_version;
  wished_region_ = wishes.region;
  session_.reset();
  world_ = shown_->world;
  settings_ = shown_->settings;
  const backend::RenderScene& built = *world_->built;
  if (auto region = wishes.region) {
    region->x1 = std::min(region->x1, settings_->size.width);
    region->y1 = std::min(region->y1, settings_->size.height);
    if (region->x0 < region->x1 && region->y0 < region->y1) settings_->region = region;
  }
  effects_ = backend::find_effects(built, *settings_);
  pool_ = &pool;
  stop_.emplace(*settings_);
  next_step_ = 4;
  const auto pixels = static_cast<double>(pixel_count(*settings_));
  if (seconds_per_sample_ > 0) {
    next_step_ = 1;
    while (next_step_ < coarsest_step &&
           pixels * seconds_per_sample_ > first_look_seconds * next_step_ * next_step_)
      next_step_ *= 2;
  }
  const ir::Region region = frame_info().region;
  while (next_step_ > 1 &&
         std::min(region.x1 - region.x0, region.y1 - region.y0) < std::int64_t{next_step_} * 8)
    next_step_ /= 2;
  finished_ = false;
  fresh_ = false;
  render_seconds_ = 0;
  curve_.clear();
  begun_ = WatchClock::now();
  ++generation_;
}

bool WatchedScene::refine(const std::stop_token& stop) {
  const auto begin = WatchClock::now();
  const std::int64_t before = samples();
  const int step = next_step_;
  const bool done = step > 1 ? refine_coarse(stop) : refine_full(stop);
  const double seconds = std::chrono::duration<double>(WatchClock::now() - begin).count();
  if (step == 1) render_seconds_ += seconds;
  if (!done) return false;
  fresh_ = true;
  const double samples = step > 1 ? 1 : static_cast<double>(session_->samples() - before);
  seconds_per_sample_ =
      seconds * step * step / (samples * static_cast<double>(pixel_count(*settings_)));
  if (step > 1) return true;
  // Estimating takes tens of milliseconds, and whoever breaks off does not wait for that.
  const backend::ErrorEstimate error =
      stop.stop_requested() ? backend::ErrorEstimate{} : session_->error();
  if (error.known) {
    curve_.push_back({render_seconds_, session_->samples(), error});
    if (curve_.size() > most_curve_points) {  // every other one; the last stays
      for (std::size_t i = 0; 2 * i + 1 < curve_.size(); ++i) curve_[i] = curve_[2 * i + 1];
      curve_.resize(curve_.size() / 2);
    }
  }
  finished_ = stop_->holds(session_->samples(), render_seconds_, error);
  if (finished_) times_.finished = since_change(WatchClock::now());
  return true;
}

bool WatchedScene::refine_coarse(const std::stop_token& stop) {
  auto picture = backend::coarse_picture(*world_->built, *settings_, effects_.simulated(), *pool_,
                                         next_step_, stop, camera_ ? &*camera_ : nullptr);
  if (!picture) return false;
  picture_ = std::make_shared<const backend::Picture>(*std::move(picture));
  step_ = next_step_;
  next_step_ /= 2;
  return true;
}

bool WatchedScene::refine_full(const std::stop_token& stop) {
  if (!session_) {
    session_.emplace(*world_->built, *settings_, effects_.simulated(), *pool_,
                     backend::KernelChoice::smallest, camera_ ? &*camera_ : nullptr);
  }
  if (!session_->advance(stop_->next_round(session_->samples()), stop)) return false;
  step_ = 1;
  return true;
}

bool WatchedScene::has_news(WatchClock::time_point now) const {
  if (!fresh_) return false;
  if (!has_coarse() || finished_ || step_ > 1 || samples() == 1) return true;
  const double age = milliseconds(now - begun_);
  const double wait = age < 1000 ? 100 : age < 5000 ? 250 : age < 20'000 ? 500 : 1000;
  return milliseconds(now - last_shown_) >= wait;
}

std::shared_ptr<const backend::Picture> WatchedScene::take_picture(WatchClock::time_point now) {
  if (step_ == 1) picture_ = std::make_shared<const backend::Picture>(session_->picture());
  fresh_ = false;
  last_shown_ = now;
  if (!has_coarse()) times_.first_picture = since_change(now);
  generation_shown_ = generation_;
  return picture_;
}

FrameInfo WatchedScene::frame_info() const {
  FrameInfo info{.generation = generation_, .size = settings_->size, .step = step_};
  info.region =
      settings_->region.value_or(ir::Region{0, 0, settings_->size.width, settings_->size.height});
  return info;
}

Shown WatchedScene::view() const {
  return {.attempt = shown_,
          .latest = latest_,
          .picture = picture_,
          .frame = picture_ ? frame_info() : FrameInfo{},
          .settings = settings_,
          .world = world_,
          .camera = camera_};
}

}  // namespace scenec::runtime
