#include "runtime/watch/file_watcher.hpp"

#include <poll.h>
#include <sys/eventfd.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <utility>

#include "runtime/watch/scene_folder.hpp"

namespace scenec::runtime {

namespace {

using Clock = std::chrono::steady_clock;

Settle::Touch touch_of(const DirectoryEvent& event) {
  using Kind = DirectoryEvent::Kind;
  switch (event.kind) {
    case Kind::written:
      return Settle::Touch::writing;
    case Kind::closed:
      return Settle::Touch::closed;
    case Kind::gone:
    case Kind::lost:
      return Settle::Touch::missing;
    case Kind::created: {
      // A file that was just opened is closed some time; a link or a directory is not.
      struct stat status{};
      const std::string path = event.directory + "/" + event.name;
      const bool is_new_file =
          ::lstat(path.c_str(), &status) == 0 && S_ISREG(status.st_mode) && status.st_nlink == 1;
      return is_new_file ? Settle::Touch::writing : Settle::Touch::changed;
    }
    case Kind::moved_here:
    case Kind::attributes:
      return Settle::Touch::changed;
  }
  return Settle::Touch::changed;
}

}  // namespace

FileWatcher::FileWatcher(WatcherOptions options, Listener listener, Notice notice)
    : options_(options),
      listener_(std::move(listener)),
      notice_(std::move(notice)),
      wake_(::eventfd(0, EFD_CLOEXEC | EFD_NONBLOCK)),
      settle_(options.settle),
      thread_([this](const std::stop_token& stop) { run(stop); }) {}

FileWatcher::~FileWatcher() {
  thread_.request_stop();
  wake();
}

void FileWatcher::wake() const {
  const std::uint64_t one = 1;
  static_cast<void>(::write(wake_.number(), &one, sizeof one));  // full means awake
}

void FileWatcher::watch(std::size_t scene, std::vector<FileRecord> files) {
  {
    const std::lock_guard lock(mutex_);
    new_sets_[scene] = std::move(files);
  }
  wake();
}

void FileWatcher::wait_until_armed() {
  std::unique_lock lock(mutex_);
  armed_.wait(lock, [&] { return new_sets_.empty() && !arming_; });
}

bool FileWatcher::is_restless(std::size_t scene) const {
  const std::lock_guard lock(mutex_);
  return restless_.contains(scene);
}

void FileWatcher::run(const std::stop_token& stop) {
  next_poll_ = Clock::now();
  while (!stop.stop_requested()) {
    wait(Clock::now());
    if (stop.stop_requested()) return;
    const Settle::Time now = Clock::now();
    take_new_sets(now);
    read_events(now);
    poll(now);
    if (const auto deadline = settle_.deadline(); deadline && *deadline <= now) finish_burst(now);
  }
}

void FileWatcher::wait(Settle::Time now) {
  std::optional<Settle::Time> until = settle_.deadline();
  if (!polled_.empty()) until = until ? std::min(*until, next_poll_) : next_poll_;
  int timeout = -1;
  if (until) {
    const auto left = std::chrono::ceil<std::chrono::milliseconds>(*until - now).count();
    timeout = static_cast<int>(std::clamp<std::int64_t>(left, 0, 60'000));
  }
  std::array<pollfd, 2> waiting{pollfd{wake_.number(), POLLIN, 0},
                                pollfd{events_.descriptor(), POLLIN, 0}};
  // A negative descriptor is passed over.
  static_cast<void>(::poll(waiting.data(), waiting.size(), timeout));
  std::uint64_t count = 0;
  static_cast<void>(::read(wake_.number(), &count, sizeof count));
}

void FileWatcher::take_new_sets(Settle::Time now) {
  std::map<std::size_t, std::vector<FileRecord>> sets;
  {
    const std::lock_guard lock(mutex_);
    sets.swap(new_sets_);
    if (sets.empty()) return;
    arming_ = true;
  }
  std::set<std::string> doubtful;
  for (const auto& [scene, records] : sets) {
    for (std::string& path : files_.set(scene, records)) doubtful.insert(std::move(path));
  }
  arm();
  for (const std::string& path : doubtful) {
    // What is being changed is looked at when that is over.
    if (files_.has_changed(path)) touch(path, Settle::Touch::changed, now);
  }
  {
    const std::lock_guard lock(mutex_);
    arming_ = false;
  }
  armed_.notify_all();
}

void FileWatcher::arm() {
  files_.look_up_places();
  std::vector<std::string> unwatched;
  if (options_.poll || !events_.valid()) {
    for (const auto& [directory, attention] : files_.directories()) unwatched.push_back(directory);
    if (!options_.poll && told_.insert("invalid").second)
      notice_("the system has no file notification left; files are looked at every second");
  } else {
    unwatched = events_.watch(files_.directories());
    if (!unwatched.empty() && told_.insert("limit").second) {
      notice_(
          "the system's limit of watched directories is reached (fs.inotify.max_user_watches);"
          " some files are looked at every second");
    }
  }
  const std::set<std::string> wanted = files_.files_to_poll(unwatched);
  if (wanted.size() > 0 && unwatched.empty() && told_.insert("remote").second)
    notice_("some files lie on a network file system; they are looked at every second");
  std::erase_if(polled_, [&](const auto& entry) { return !wanted.contains(entry.first); });
  for (const std::string& path : wanted) {
    if (!polled_.contains(path)) polled_[path] = signature_of(path);
  }
}

void FileWatcher::read_events(Settle::Time now) {
  if (!events_.valid()) return;
  const DirectoryEvents::Batch batch = events_.read();
  for (const DirectoryEvent& event : batch.events) handle(event, now);
  if (batch.overflow) {
    lost_directory_ = true;
    for (const std::string& path : files_.all()) touch(path, Settle::Touch::changed, now);
  }
}

void FileWatcher::handle(const DirectoryEvent& event, Settle::Time now) {
  using Kind = DirectoryEvent::Kind;
  std::set<std::string> paths = files_.files_at({event.directory, event.name});
  // What is known already may be written and replaced without a change of the listing.
  if (is_scene_name(event.name) && (paths.empty() || event.kind == Kind::gone))
    paths.merge(files_.listings_of(event.directory));
  if (paths.empty()) return;
  const bool is_content = event.kind == Kind::written || event.kind == Kind::closed;
  if (!is_content) lost_directory_ = true;  // the path may lead elsewhere now
  const Settle::Touch what = touch_of(event);
  for (const std::string& path : paths) touch(path, what, now);
}

void FileWatcher::touch(const std::string& path, Settle::Touch touch, Settle::Time now) {
  settle_.touch(path, touch, now);
  const std::lock_guard lock(mutex_);
  for (const std::size_t scene : files_.owners_of({path})) restless_.insert(scene);
}

FileWatcher::Signature FileWatcher::signature_of(const std::string& path) {
  struct stat status{};
  if (::stat(path.c_str(), &status) != 0) return {};
  const auto word = [](auto value) { return static_cast<std::uint64_t>(value); };
  return {{word(status.st_size) + 1, word(status.st_mtim.tv_sec), word(status.st_mtim.tv_nsec),
           word(status.st_ctim.tv_sec), word(status.st_ctim.tv_nsec), word(status.st_ino)}};
}

void FileWatcher::poll(Settle::Time now) {
  if (polled_.empty() || now < next_poll_) return;
  // While something is going on, growth must be seen: look more often.
  next_poll_ = now + (settle_.pending() ? options_.settle.quiet : options_.poll_every);
  for (auto& [path, signature] : polled_) {
    const Signature current = signature_of(path);
    if (current == signature) continue;
    signature = current;
    touch(path, Settle::Touch::changed, now);
    next_poll_ = std::min(next_poll_, now + options_.settle.quiet / 2);
  }
}

void FileWatcher::finish_burst(Settle::Time now) {
  const Settle::Burst burst = settle_.take(now);
  const bool rearm = std::exchange(lost_directory_, false);
  if (rearm) arm();
  FilesSettled settled{.changed = files_.find_changed(burst.paths),
                       .touched = files_.owners_of(burst.paths),
                       .first = burst.first,
                       .last = burst.last,
                       .forced = burst.forced};
  {
    const std::lock_guard lock(mutex_);
    restless_.clear();
  }
  listener_(settled);
}

}  // namespace scenec::runtime
