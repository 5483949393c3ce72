// Vectors for trees and their leaves: cache-line aligned, and in huge pages where there is enough
// of them to matter (a walk through megabytes of nodes is bound by address translation).
#pragma once

#include <cstddef>
#include <vector>

namespace scenec::backend {

[[nodiscard]] void* allocate_huge(std::size_t bytes);
void free_huge(void* memory, std::size_t bytes);

template <class T>
struct HugeAllocator {
  using value_type = T;
  HugeAllocator() = default;
  template <class U>
  HugeAllocator(const HugeAllocator<U>&) {}  // NOLINT(google-explicit-constructor): as std asks
  [[nodiscard]] T* allocate(std::size_t count) {
    return static_cast<T*>(allocate_huge(count * sizeof(T)));
  }
  void deallocate(T* memory, std::size_t count) { free_huge(memory, count * sizeof(T)); }
  friend bool operator==(const HugeAllocator&, const HugeAllocator&) { return true; }
};

template <class T>
using HugeVector = std::vector<T, HugeAllocator<T>>;

}  // namespace scenec::backend
