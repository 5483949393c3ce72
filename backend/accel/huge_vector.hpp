// Vectors for trees and their leaves: cache-line aligned, and in huge pages where there is enough
// of them to matter (a walk through megabytes of nodes is bound by address translation). Memory is
// the system's again as soon as it is freed, and untouched until it is written: `resize` leaves new
// elements of trivial types undefined.
#pragma once

#include <cstddef>
#include <new>
#include <utility>
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
  template <class U>
  void construct(U* place) {
    ::new (static_cast<void*>(place)) U;
  }
  template <class U, class... Args>
  void construct(U* place, Args&&... args) {
    ::new (static_cast<void*>(place)) U(std::forward<Args>(args)...);
  }
  friend bool operator==(const HugeAllocator&, const HugeAllocator&) { return true; }
};

template <class T>
using HugeVector = std::vector<T, HugeAllocator<T>>;

}  // namespace scenec::backend
