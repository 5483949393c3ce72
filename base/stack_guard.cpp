#include "base/stack_guard.hpp"

#include <pthread.h>

#include <cstddef>

namespace scenec {

namespace {
// For what is called between two looks at the guard, printing a message included. Sanitizers make
// frames several times as large.
constexpr std::size_t reserve = std::size_t{1} << 20;
}  // namespace

StackGuard::StackGuard() {
  pthread_attr_t attributes;
  if (pthread_getattr_np(pthread_self(), &attributes) != 0) return;
  void* low = nullptr;
  std::size_t size = 0;
  if (pthread_attr_getstack(&attributes, &low, &size) == 0) {
    const std::size_t kept = reserve < size / 2 ? reserve : size / 2;
    lowest_ = reinterpret_cast<std::uintptr_t>(low) + kept;
  }
  pthread_attr_destroy(&attributes);
}

}  // namespace scenec
