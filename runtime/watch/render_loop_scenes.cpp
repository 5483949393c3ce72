// Which scenes the loop has: those of a folder come and go. A scene keeps its number for good, so
// that open pages stay right.
#include <algorithm>
#include <utility>

#include "runtime/watch/render_loop.hpp"
#include "runtime/watch/state_json.hpp"

namespace scenec::runtime {

// Under the lock, on the loop's thread or before it runs.
void RenderLoop::take_scenes(std::vector<std::string> names) {
  std::vector<bool> listed(scenes_.size(), false);
  for (std::string& name : names) {
    const auto known = std::find_if(scenes_.begin(), scenes_.end(),
                                    [&](const auto& scene) { return scene->path() == name; });
    const auto number = static_cast<std::size_t>(known - scenes_.begin());
    if (known == scenes_.end()) {
      Options options = options_;
      options.operands = {std::move(name)};
      scenes_.push_back(std::make_unique<WatchedScene>(number, std::move(options)));
      wishes_.emplace_back().since = WatchClock::now();
      done_.emplace_back();
      shown_.emplace_back();
      board_.add_scene();
      listed.push_back(true);
    } else {
      // What came back while nobody knew of it is a change of the files, which have been let go.
      if (!listed_[number] && !(*known)->latest()) {
        wishes_[number].since = WatchClock::now();
        ++wishes_[number].version;
        ++wishes_[number].files_version;
      }
      listed[number] = true;
    }
  }
  for (std::size_t i = 0; i < listed_.size(); ++i) {
    if (listed_[i] && !listed[i] && board_.slot(i).viewers == 0) drop(i);
  }
  listed_ = std::move(listed);
  if (has_list_) board_.put_list(list_json());
}

// The file is gone and nobody looks on: nothing is kept for it but its number. Whoever looks on
// keeps the last picture, with the reason why there is no other.
void RenderLoop::drop(std::size_t scene) {
  const Options options = scenes_[scene]->options();
  scenes_[scene] = std::make_unique<WatchedScene>(scene, options);
  shown_[scene] = {};
  done_[scene] = {.version = wishes_[scene].version,
                  .files_version = wishes_[scene].files_version,
                  .withheld_since = {}};
  board_.clear(scene);
  watcher_->watch(scene, {});
}

std::string RenderLoop::list_json() const {
  std::vector<ListedScene> listed;
  for (std::size_t i = 0; i < scenes_.size(); ++i) {
    if (listed_[i]) listed.push_back({i, scenes_[i]->path()});
  }
  return scenec::runtime::list_json(listed, notices_);
}

}  // namespace scenec::runtime
