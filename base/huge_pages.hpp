// Memory that will be filled from end to end, in large pages: a page fault for every 4 KiB costs
// more than what a mesh reader does with the bytes.
#pragma once

#include <cstddef>
#include <vector>

namespace scenec {

// Advice only, for memory that has not been touched yet; where there are no huge pages, or too few
// bytes, nothing happens.
void advise_huge_pages(void* memory, std::size_t bytes);

// As reserve() on an empty vector.
template <class T>
void reserve_large(std::vector<T>& values, std::size_t count) {
  values.reserve(count);
  advise_huge_pages(values.data(), values.capacity() * sizeof(T));
}
template <class T>
void resize_large(std::vector<T>& values, std::size_t count) {
  reserve_large(values, count);
  values.resize(count);
}

}  // namespace scenec
