#include "backend/accel/huge_vector.hpp"

#include <new>

#ifdef __linux__
#include <sys/mman.h>
#endif

namespace scenec::backend {
namespace {

constexpr std::size_t cache_line = 64;
constexpr std::size_t huge_page = std::size_t{2} << 20;
// Below this the last, partly used huge page would cost more than it saves.
constexpr std::size_t huge_threshold = 2 * huge_page;

std::size_t alignment_of(std::size_t bytes) {
  return bytes >= huge_threshold ? huge_page : cache_line;
}

}  // namespace

void* allocate_huge(std::size_t bytes) {
  const std::size_t alignment = alignment_of(bytes);
  void* memory = ::operator new(bytes, std::align_val_t{alignment});
#ifdef __linux__
  // Advice only: where the system has no huge pages the memory works all the same.
  if (alignment == huge_page) madvise(memory, bytes & ~(huge_page - 1), MADV_HUGEPAGE);
#endif
  return memory;
}

void free_huge(void* memory, std::size_t bytes) {
  ::operator delete(memory, std::align_val_t{alignment_of(bytes)});
}

}  // namespace scenec::backend
