// `Schema<T>` says everything about the keys of T once: name, member, whether it is required, its
// range, its documentation and the rules between keys. Checking, defaults (the member
// initialisers), dump, hash, formatter order, completion, `scenec schema` and the manual derive
// from it.
#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <string_view>
#include <tuple>
#include <utility>

namespace scenec::ir {

struct Range {
  double low = -std::numeric_limits<double>::infinity();
  double high = std::numeric_limits<double>::infinity();
  bool low_open = false;
  bool high_open = false;

  [[nodiscard]] constexpr bool contains(double value) const {  // NaN is never contained
    const bool above = low_open ? value > low : value >= low;
    const bool below = high_open ? value < high : value <= high;
    return above && below;
  }
};
namespace range {
inline constexpr Range any{};
inline constexpr Range positive{.low = 0, .low_open = true};
inline constexpr Range non_negative{.low = 0};
inline constexpr Range unit{.low = 0, .high = 1};
inline constexpr Range half_turn{
    .low = 0, .high = 3.141592653589793, .low_open = true, .high_open = true};
[[nodiscard]] constexpr Range between(double low, double high) {
  return {.low = low, .high = high};
}
}  // namespace range

enum class Need : std::uint8_t { optional, required };

// `range` applies to the number itself or to each component of a vector, colour or list, in SI.
template <class T, class Member>
struct Key {
  using member_type = Member;
  Member T::* member;
  std::string_view name;
  Need need = Need::optional;
  Range range{};
  std::string_view doc;
};
template <class T, class Member>
[[nodiscard]] constexpr Key<T, Member> key(Member T::* member, std::string_view name, Range range,
                                           std::string_view doc) {
  return {member, name, Need::optional, range, doc};
}
template <class T, class Member>
[[nodiscard]] constexpr Key<T, Member> required(Member T::* member, std::string_view name,
                                                Range range, std::string_view doc) {
  return {member, name, Need::required, range, doc};
}

// A rule between keys of one block; unused places of `keys` are empty.
struct KeyRule {
  enum class Kind : std::uint8_t { exactly_one, at_most_one, together };
  Kind kind = Kind::exactly_one;
  std::array<std::string_view, 4> keys{};
};

template <class T>
struct Schema;  // static constexpr: std::string_view name, doc; auto keys = std::tuple{...}; auto
                // rules = std::array<KeyRule, n>

template <class T>
concept HasSchema = requires {
  Schema<T>::name;
  Schema<T>::keys;
};

// Calls f(key) for each key in the order of declaration, which is the canonical order.
template <HasSchema T, class F>
constexpr void visit_keys(F&& f) {
  std::apply([&](const auto&... keys) { (f(keys), ...); }, Schema<T>::keys);
}

inline constexpr std::array<KeyRule, 0> no_rules{};

}  // namespace scenec::ir
