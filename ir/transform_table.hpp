// The table of transforms, in as few bytes as each of them needs: a scene may hold ten million
// instances. A pure move takes 28 bytes, anything else 100; both read back as they were, except
// that a negative zero, which no scene holds, reads back as zero.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

#include "base/assert.hpp"
#include "base/ids.hpp"
#include "ir/values.hpp"

namespace scenec::ir {

// An array that grows by whole pieces: growth copies nothing, so memory never doubles.
template <class T>
class PiecewiseArray {
 public:
  [[nodiscard]] std::size_t size() const { return size_; }
  [[nodiscard]] const T& operator[](std::size_t i) const { return pieces_[i >> shift][i & mask]; }
  void push(const T& value) {
    if ((size_ & mask) == 0) pieces_.push_back(std::make_unique_for_overwrite<T[]>(mask + 1));
    pieces_[size_ >> shift][size_ & mask] = value;
    ++size_;
  }

 private:
  static constexpr std::size_t shift = 12;
  static constexpr std::size_t mask = (std::size_t{1} << shift) - 1;
  std::vector<std::unique_ptr<T[]>> pieces_;
  std::size_t size_ = 0;
};

class TransformTable {
 public:
  using id_type = Id<Transform>;

  // Precondition: affine (the last row is 0 0 0 1).
  id_type push(const Transform& transform);
  [[nodiscard]] Transform operator[](id_type id) const;
  // Whether the row holds just that transform; cheaper than reading it.
  [[nodiscard]] bool holds(id_type id, const Transform& transform) const;
  [[nodiscard]] std::size_t size() const { return places_.size(); }

 private:
  using Move = std::array<double, 3>;
  using Rows = std::array<double, 12>;
  std::vector<std::uint32_t> places_;  // index into moves_ or rows_, doubled; odd: into rows_
  PiecewiseArray<Move> moves_;
  PiecewiseArray<Rows> rows_;
};

}  // namespace scenec::ir
