// A list whose first N elements need no memory of their own: calls have few arguments, and a loop
// makes millions of them.
#pragma once

#include <array>
#include <cstddef>
#include <utility>
#include <vector>

namespace scenec {

template <class T, std::size_t N>
class InlineList {
 public:
  using value_type = T;
  InlineList() = default;

  void push_back(T value) {
    if (size_ < N) {
      first_[size_++] = std::move(value);
      return;
    }
    if (size_ == N) {
      all_.reserve(2 * N);
      for (T& one : first_) all_.push_back(std::move(one));
    }
    all_.push_back(std::move(value));
    ++size_;
  }
  // Makes the list longer; what is new is T{}. A list never becomes shorter, so the places behind
  // its end are T{} already.
  void grow(std::size_t size) {
    if (size <= N) {
      if (size_ < size) size_ = size;
      return;
    }
    while (size_ < size) push_back(T{});
  }
  [[nodiscard]] std::size_t size() const { return size_; }
  [[nodiscard]] bool empty() const { return size_ == 0; }
  [[nodiscard]] T* begin() { return size_ <= N ? first_.data() : all_.data(); }
  [[nodiscard]] T* end() { return begin() + size_; }
  [[nodiscard]] const T* begin() const { return size_ <= N ? first_.data() : all_.data(); }
  [[nodiscard]] const T* end() const { return begin() + size_; }
  [[nodiscard]] T& operator[](std::size_t i) { return begin()[i]; }
  [[nodiscard]] const T& operator[](std::size_t i) const { return begin()[i]; }
  [[nodiscard]] T& back() { return begin()[size_ - 1]; }

 private:
  std::array<T, N> first_{};
  std::vector<T> all_;  // of a list longer than N: every element
  std::size_t size_ = 0;
};

}  // namespace scenec
