// An open file of the system, and the one way its bytes are read: for the file systems, which
// differ in how they open.
#pragma once

#include <unistd.h>

#include <cstdint>
#include <utility>

#include "base/file_system.hpp"
#include "base/result.hpp"

namespace scenec {

class Descriptor {
 public:
  explicit Descriptor(int number = -1) : number_(number) {}
  Descriptor(Descriptor&& other) noexcept : number_(std::exchange(other.number_, -1)) {}
  Descriptor& operator=(Descriptor&& other) noexcept {
    std::swap(number_, other.number_);
    return *this;
  }
  ~Descriptor() {
    if (number_ >= 0) ::close(number_);
  }
  [[nodiscard]] bool valid() const { return number_ >= 0; }
  [[nodiscard]] int number() const { return number_; }

 private:
  int number_;
};

[[nodiscard]] FileError file_error_of(int error_number);

// The bytes of a regular file of at most `size_limit` bytes; anything else is refused unread.
[[nodiscard]] Result<FileContent, FileError> read_descriptor(const Descriptor& file,
                                                             std::uint64_t size_limit);

}  // namespace scenec
