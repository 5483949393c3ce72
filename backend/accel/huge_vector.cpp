#include "backend/accel/huge_vector.hpp"

#include <cstdint>
#include <new>

#ifdef __linux__
#include <sys/mman.h>
#endif

namespace scenec::backend {
namespace {

constexpr std::size_t cache_line = 64;
#ifdef __linux__
constexpr std::size_t page = 4096;
constexpr std::size_t huge_page = std::size_t{2} << 20;
// Below this the last, partly used huge page would cost more than it saves.
constexpr std::size_t huge_threshold = 2 * huge_page;
// From here on memory is mapped by itself: the general allocator would keep it when it is freed.
constexpr std::size_t mapped_threshold = std::size_t{256} << 10;

std::size_t whole_pages(std::size_t bytes) {
  return (bytes + page - 1) & ~(page - 1);
}

void* map(std::size_t bytes) {
  void* memory = mmap(nullptr, bytes, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
  if (memory == MAP_FAILED) throw std::bad_alloc();
  return memory;
}

void* map_huge(std::size_t bytes) {
  const std::size_t room = bytes + huge_page;
  auto* const first = static_cast<std::byte*>(map(room));
  const std::size_t before =
      (huge_page - reinterpret_cast<std::uintptr_t>(first) % huge_page) % huge_page;
  if (before != 0) munmap(first, before);
  munmap(first + before + bytes, room - before - bytes);
  // Advice only: where the system has no huge pages the memory works all the same.
  madvise(first + before, bytes & ~(huge_page - 1), MADV_HUGEPAGE);
  return first + before;
}
#endif

}  // namespace

void* allocate_huge(std::size_t bytes) {
#ifdef __linux__
  if (bytes >= huge_threshold) return map_huge(whole_pages(bytes));
  if (bytes >= mapped_threshold) return map(whole_pages(bytes));
#endif
  return ::operator new(bytes, std::align_val_t{cache_line});
}

void free_huge(void* memory, std::size_t bytes) {
#ifdef __linux__
  if (bytes >= mapped_threshold) {
    munmap(memory, whole_pages(bytes));
    return;
  }
#endif
  ::operator delete(memory, std::align_val_t{cache_line});
}

}  // namespace scenec::backend
