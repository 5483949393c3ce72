#include "base/parallel.hpp"

#include <algorithm>
#include <atomic>
#include <condition_variable>
#include <cstdint>
#include <exception>
#include <limits>
#include <mutex>
#include <system_error>
#include <thread>
#include <vector>

#include "base/assert.hpp"

namespace scenec {

namespace {

// One call of for_each: what the workers share while it runs.
struct Loop {
  std::size_t count;
  const std::function<void(std::size_t, unsigned)>& body;
  const std::stop_token& stop;
  std::atomic<std::size_t> next{0};
  std::atomic<std::size_t> done{0};
  std::atomic<bool> failed{false};
  std::mutex failure_mutex{};
  // Of several failures the one of the lowest index is kept. Indices are taken in order, so every
  // index below a failing one runs to its end: which failure is rethrown does not depend on
  // threads.
  std::size_t failure_index = std::numeric_limits<std::size_t>::max();
  std::exception_ptr failure{};

  void work(unsigned worker) {
    while (!failed.load(std::memory_order_relaxed) && !stop.stop_requested()) {
      const std::size_t index = next.fetch_add(1, std::memory_order_relaxed);
      if (index >= count) return;
      try {
        body(index, worker);
        done.fetch_add(1, std::memory_order_relaxed);
      } catch (...) {
        keep_failure(index);
      }
    }
  }

 private:
  void keep_failure(std::size_t index) {
    const std::lock_guard lock(failure_mutex);
    failed.store(true, std::memory_order_relaxed);
    if (index >= failure_index) return;
    failure_index = index;
    failure = std::current_exception();
  }
};

}  // namespace

struct ThreadPool::Impl {
  std::mutex mutex;
  std::condition_variable_any loop_started;
  std::condition_variable loop_finished;
  Loop* loop = nullptr;
  std::uint64_t loop_number = 0;
  std::size_t busy = 0;
  std::atomic<bool> in_loop{false};
  std::vector<std::jthread> threads;  // last: joined before the rest goes away

  void serve(const std::stop_token& end, unsigned worker) {
    std::uint64_t served = 0;
    std::unique_lock lock(mutex);
    while (loop_started.wait(lock, end, [&] { return loop_number != served; })) {
      served = loop_number;
      Loop& current = *loop;
      lock.unlock();
      current.work(worker);
      lock.lock();
      if (--busy == 0) loop_finished.notify_one();
    }
  }
};

ThreadPool::ThreadPool(unsigned threads) : impl_(std::make_unique<Impl>()) {
  const unsigned wanted =
      threads != 0 ? threads : std::max(1U, std::thread::hardware_concurrency());
  impl_->threads.reserve(wanted - 1);
  for (unsigned worker = 1; worker < wanted; ++worker) {
    try {
      impl_->threads.emplace_back(
          [pool = impl_.get(), worker](const std::stop_token& end) { pool->serve(end, worker); });
    } catch (const std::system_error&) {
      break;  // the system gives no more; fewer threads do the same work
    }
  }
}

ThreadPool::~ThreadPool() = default;

unsigned ThreadPool::size() const {
  return static_cast<unsigned>(impl_->threads.size()) + 1;
}

bool ThreadPool::for_each(std::size_t count, const std::function<void(std::size_t, unsigned)>& body,
                          std::stop_token stop) {
  const bool nested = impl_->in_loop.exchange(true);
  SCENEC_ASSERT(!nested);
  Loop loop{.count = count, .body = body, .stop = stop};
  const bool alone = impl_->threads.empty() || count < 2;
  if (!alone) {
    const std::lock_guard lock(impl_->mutex);
    impl_->loop = &loop;
    impl_->busy = impl_->threads.size();
    ++impl_->loop_number;
    impl_->loop_started.notify_all();
  }
  loop.work(0);
  if (!alone) {
    std::unique_lock lock(impl_->mutex);
    impl_->loop_finished.wait(lock, [&] { return impl_->busy == 0; });
    impl_->loop = nullptr;
  }
  impl_->in_loop.store(false);
  if (loop.failure) std::rethrow_exception(loop.failure);
  return loop.done.load() == count;
}

}  // namespace scenec
