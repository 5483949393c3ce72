// How long a thing takes to answer many rays: chunks of them to whichever thread is free.
#pragma once

#include <time.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <thread>
#include <vector>

namespace scenec::bench {

// Processor time, of all threads, is the better measure where other programs share the machine.
enum class Clock : std::uint8_t { wall, cpu };

[[nodiscard]] inline double seconds_now(Clock clock) {
  if (clock == Clock::cpu) {
    timespec t{};
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &t);
    return static_cast<double>(t.tv_sec) + 1e-9 * static_cast<double>(t.tv_nsec);
  }
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

// Seconds that trace(first, last) takes over [0, count).
template <class Trace>
[[nodiscard]] double seconds_of(std::size_t count, unsigned threads, Clock clock, Trace&& trace) {
  constexpr std::size_t chunk = 4096;
  std::atomic<std::size_t> next{0};
  const auto work = [&] {
    for (std::size_t first = 0; (first = next.fetch_add(chunk)) < count;)
      trace(first, std::min(first + chunk, count));
  };
  const double start = seconds_now(clock);
  {
    std::vector<std::jthread> others;
    for (unsigned i = 1; i < threads; ++i) others.emplace_back(work);
    work();
  }
  return seconds_now(clock) - start;
}

}  // namespace scenec::bench
