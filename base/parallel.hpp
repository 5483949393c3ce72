// A pool of std::jthread workers and a deterministic parallel loop. Cancellation is a
// std::stop_token passed down; there are no global pools.
#pragma once

#include <cstddef>
#include <functional>
#include <memory>
#include <stop_token>

namespace scenec {

class ThreadPool {
 public:
  // `threads` = 0 takes the hardware's number. The calling thread works too: a pool of 1 starts
  // none. If threads cannot be started the pool has fewer.
  explicit ThreadPool(unsigned threads = 0);
  ~ThreadPool();
  ThreadPool(const ThreadPool&) = delete;
  ThreadPool& operator=(const ThreadPool&) = delete;

  [[nodiscard]] unsigned size() const;
  // Calls body(index, worker) for each index in [0, count), worker in [0, size()). Indices are
  // taken in order by whichever worker is free; after a stop request no new index is begun.
  // Returns true when every index was done. An exception of `body` is rethrown here.
  // Must not be called from inside `body`.
  bool for_each(std::size_t count, const std::function<void(std::size_t, unsigned)>& body,
                std::stop_token stop = {});

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace scenec
