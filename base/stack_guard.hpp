// How much of the calling thread's stack is left, for code that recurses as deep as its input asks:
// it stops with a message instead of a crash, whatever size the system gives stacks.
#pragma once

#include <cstdint>

namespace scenec {

class StackGuard {
 public:
  // Of the thread that makes it.
  StackGuard();
  // True when less than the reserve is left. Costs a subtraction.
  [[nodiscard]] bool nearly_full() const {
    return reinterpret_cast<std::uintptr_t>(__builtin_frame_address(0)) < lowest_;
  }

 private:
  std::uintptr_t lowest_ = 0;
};

}  // namespace scenec
