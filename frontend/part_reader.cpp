#include "frontend/part_reader.hpp"

#include <utility>

namespace scenec::frontend {

namespace {
// Parts that wait to be read, a thread. A tree is about twelve times as large as its text.
constexpr std::size_t parts_ahead = 8;
}  // namespace

void PartReader::run(ThreadPool& pool, const std::function<void()>& read) {
  const std::size_t threads = pool.size();
  window_ = 1 + parts_ahead * (threads - 1);
  pool.for_each(threads, [&](std::size_t index, unsigned) {
    if (index > 0) return parse_ahead();
    try {
      read();
    } catch (...) {
      stop();
      throw;
    }
    stop();
  });
}

void PartReader::stop() {
  const std::lock_guard lock(mutex_);
  stopped_ = true;
  changed_.notify_all();
}

// Cuts and parses the next part, the lock given back meanwhile. False when there is none.
bool PartReader::parse_one(Lock& lock) {
  if (at_end_) return false;
  const auto place = splitter_.next(input_.part_bytes);
  if (!place) {
    at_end_ = true;
    failed_ = failed_ || !splitter_.finished();
    changed_.notify_all();
    return false;
  }
  Part& part = parts_.emplace_back();
  lock.unlock();
  try {
    DiagnosticSink sink;
    part.tree = std::make_unique<grammar::SyntaxTree>(
        grammar::parse_sdl_part(input_.file, input_.text, *place, sink));
    part.sound = sink.error_count() == 0 && sink.warning_count() == 0;
  } catch (...) {
    lock.lock();
    failed_ = at_end_ = true;  // nobody waits for this part
    changed_.notify_all();
    throw;
  }
  lock.lock();
  part.ready = true;
  changed_.notify_all();
  return true;
}

void PartReader::parse_ahead() {
  Lock lock(mutex_);
  while (!stopped_ && !at_end_) {
    if (parts_.size() >= window_) {
      changed_.wait(lock);
    } else {
      static_cast<void>(parse_one(lock));
    }
  }
}

const grammar::SyntaxTree* PartReader::next() {
  const WorkClock::Running parsing(input_.parsing);
  if (std::exchange(keep_current_, false)) kept_.push_back(std::move(current_));
  current_.reset();
  Lock lock(mutex_);
  failed_ = failed_ || input_.found.has_errors();
  while (!failed_) {
    if (!parts_.empty() && parts_.front().ready) {
      Part part = std::move(parts_.front());
      parts_.pop_front();
      changed_.notify_all();
      failed_ = !part.sound;
      if (failed_) break;
      current_ = std::move(part.tree);
      return current_.get();
    }
    // The one that is waited for is being parsed by another thread: meanwhile one behind it.
    if (parts_.size() <= window_ && parse_one(lock)) continue;
    if (parts_.empty()) return nullptr;
    if (!parts_.front().ready) changed_.wait(lock);
  }
  return nullptr;
}

}  // namespace scenec::frontend
