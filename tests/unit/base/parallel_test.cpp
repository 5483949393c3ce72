#include "base/parallel.hpp"

#include <gtest/gtest.h>

#include <atomic>
#include <latch>
#include <numeric>
#include <stdexcept>
#include <string>
#include <vector>

namespace scenec {
namespace {

TEST(ThreadPool, DoesEveryIndexOnce) {
  for (const unsigned threads : {1U, 2U, 3U, 8U}) {
    ThreadPool pool(threads);
    EXPECT_EQ(pool.size(), threads);
    for (const std::size_t count : {0UL, 1UL, 2UL, 7UL, 1000UL}) {
      std::vector<std::atomic<int>> done(count);
      EXPECT_TRUE(pool.for_each(count, [&](std::size_t index, unsigned worker) {
        EXPECT_LT(worker, threads);
        ++done[index];
      }));
      for (const auto& times : done) EXPECT_EQ(times, 1);
    }
  }
}

TEST(ThreadPool, ZeroTakesTheMachines) {
  const ThreadPool pool;
  EXPECT_GE(pool.size(), 1U);
}

TEST(ThreadPool, WorkersHaveDistinctNumbers) {
  constexpr unsigned threads = 4;
  ThreadPool pool(threads);
  std::vector<std::atomic<int>> seen(threads);
  std::latch all(threads);  // holds every worker in its index until all have one
  pool.for_each(threads, [&](std::size_t, unsigned worker) {
    ++seen[worker];
    all.arrive_and_wait();
  });
  for (const auto& times : seen) EXPECT_EQ(times, 1);
}

TEST(ThreadPool, ResultsDoNotDependOnThreads) {
  const auto work = [](unsigned threads) {
    ThreadPool pool(threads);
    std::vector<double> results(5000);
    pool.for_each(results.size(), [&](std::size_t index, unsigned) {
      double value = static_cast<double>(index);
      for (int i = 0; i < 50; ++i) value = value * 1.0000001 + 0.1;
      results[index] = value;
    });
    return results;
  };
  const auto alone = work(1);
  EXPECT_EQ(work(2), alone);
  EXPECT_EQ(work(7), alone);
}

TEST(ThreadPool, IndicesAreTakenInOrder) {
  ThreadPool pool(1);
  std::vector<std::size_t> order;
  pool.for_each(100, [&](std::size_t index, unsigned) { order.push_back(index); });
  std::vector<std::size_t> expected(100);
  std::iota(expected.begin(), expected.end(), 0U);
  EXPECT_EQ(order, expected);
}

TEST(ThreadPool, ManyShortLoops) {
  ThreadPool pool(4);
  std::atomic<std::size_t> sum{0};
  for (int loop = 0; loop < 3000; ++loop) {
    pool.for_each(5, [&](std::size_t index, unsigned) { sum += index; });
  }
  EXPECT_EQ(sum, 30000U);
}

TEST(ThreadPool, StopsWhenAsked) {
  for (const unsigned threads : {1U, 4U}) {
    ThreadPool pool(threads);
    std::stop_source stop;
    std::atomic<std::size_t> done{0};
    const bool all = pool.for_each(
        100000,
        [&](std::size_t, unsigned) {
          if (++done == 10) stop.request_stop();
        },
        stop.get_token());
    EXPECT_FALSE(all);
    EXPECT_GE(done, 10U);
    EXPECT_LT(done, 100000U);
    // Asked before it begins: nothing is begun. The pool stays usable.
    EXPECT_FALSE(pool.for_each(5, [&](std::size_t, unsigned) { FAIL(); }, stop.get_token()));
    EXPECT_TRUE(pool.for_each(5, [](std::size_t, unsigned) {}));
  }
}

TEST(ThreadPool, StopAfterTheLastIndexIsStillComplete) {
  ThreadPool pool(2);
  std::stop_source stop;
  EXPECT_TRUE(pool.for_each(
      4,
      [&](std::size_t index, unsigned) {
        if (index == 3) stop.request_stop();
      },
      stop.get_token()));
}

TEST(ThreadPool, RethrowsTheFailureOfTheLowestIndex) {
  for (const unsigned threads : {1U, 4U}) {
    ThreadPool pool(threads);
    for (int attempt = 0; attempt < 200; ++attempt) {
      std::string what;
      try {
        pool.for_each(64, [](std::size_t index, unsigned) {
          if (index % 8 == 5) throw std::runtime_error(std::to_string(index));
        });
      } catch (const std::runtime_error& error) {
        what = error.what();
      }
      ASSERT_EQ(what, "5");
    }
    EXPECT_TRUE(pool.for_each(10, [](std::size_t, unsigned) {}));
  }
}

TEST(ThreadPool, LoopsDoNotNest) {
  GTEST_FLAG_SET(death_test_style, "threadsafe");
  EXPECT_DEATH(
      {
        ThreadPool pool(2);
        pool.for_each(
            2, [&](std::size_t, unsigned) { pool.for_each(1, [](std::size_t, unsigned) {}); });
      },
      "internal failure");
}

}  // namespace
}  // namespace scenec
