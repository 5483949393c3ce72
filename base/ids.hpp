// Strong 32-bit ids and the tables they index. An `Id<Tag>` of one table cannot index another, and
// data refers to data by id, never by pointer.
#pragma once

#include <compare>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <utility>
#include <vector>

#include "base/assert.hpp"

namespace scenec {

template <class Tag>
class Id {
 public:
  constexpr Id() = default;
  constexpr explicit Id(std::uint32_t value) : value_(value) {}

  [[nodiscard]] constexpr std::uint32_t value() const { return value_; }
  [[nodiscard]] constexpr bool valid() const { return value_ != none; }
  friend constexpr auto operator<=>(Id, Id) = default;

 private:
  static constexpr std::uint32_t none = std::numeric_limits<std::uint32_t>::max();
  std::uint32_t value_ = none;
};

// A growing array of `T` indexed by `Id<T>`; ids are handed out in order of insertion.
template <class T, class Tag = T>
class Table {
 public:
  using id_type = Id<Tag>;

  id_type push(T row) {
    SCENEC_ASSERT(rows_.size() < std::numeric_limits<std::uint32_t>::max());
    rows_.push_back(std::move(row));
    return id_type(static_cast<std::uint32_t>(rows_.size() - 1));
  }
  [[nodiscard]] const T& operator[](id_type id) const {
    SCENEC_ASSERT(id.value() < rows_.size());
    return rows_[id.value()];
  }
  [[nodiscard]] T& operator[](id_type id) {
    SCENEC_ASSERT(id.value() < rows_.size());
    return rows_[id.value()];
  }
  [[nodiscard]] std::size_t size() const { return rows_.size(); }
  [[nodiscard]] bool empty() const { return rows_.empty(); }
  void reserve(std::size_t count) { rows_.reserve(count); }
  [[nodiscard]] auto begin() const { return rows_.begin(); }
  [[nodiscard]] auto end() const { return rows_.end(); }

 private:
  std::vector<T> rows_;
};

}  // namespace scenec
