// `Result<T, E>`: a value or the reason there is none. For the world (files, decoders); user
// mistakes become diagnostics at the edge. (g++ 12 has no std::expected in C++20 mode.)
#pragma once

#include <utility>
#include <variant>

#include "base/assert.hpp"

namespace scenec {

template <class E>
struct Failure {
  E error;
};
template <class E>
Failure(E) -> Failure<E>;

template <class T, class E>
class Result {
 public:
  Result(T value) : state_(std::in_place_index<0>, std::move(value)) {}
  Result(Failure<E> failure) : state_(std::in_place_index<1>, std::move(failure.error)) {}

  [[nodiscard]] bool ok() const { return state_.index() == 0; }
  explicit operator bool() const { return ok(); }
  [[nodiscard]] const T& value() const& {
    SCENEC_ASSERT(ok());
    return std::get<0>(state_);
  }
  [[nodiscard]] T& value() & {
    SCENEC_ASSERT(ok());
    return std::get<0>(state_);
  }
  [[nodiscard]] T&& value() && {
    SCENEC_ASSERT(ok());
    return std::get<0>(std::move(state_));
  }
  [[nodiscard]] const E& error() const {
    SCENEC_ASSERT(!ok());
    return std::get<1>(state_);
  }

 private:
  std::variant<T, E> state_;
};

}  // namespace scenec
