// Loops over very many things in parallel, in pieces of fixed size, so that what is summed a piece
// at a time does not depend on the pool.
#pragma once

#include <algorithm>
#include <cstddef>

#include "base/parallel.hpp"

namespace scenec::backend {

inline constexpr std::size_t chunk_size = 16384;

[[nodiscard]] constexpr std::size_t chunks_of(std::size_t count) {
  return (count + chunk_size - 1) / chunk_size;
}

// Calls f(first, last) for the runs of [0, count).
template <class F>
void for_chunks(ThreadPool& pool, std::size_t count, F&& f) {
  pool.for_each(chunks_of(count), [&](std::size_t i, unsigned) {
    f(i * chunk_size, std::min(count, (i + 1) * chunk_size));
  });
}

}  // namespace scenec::backend
