// 128-bit content hashes (XXH3). The value depends on bytes only: no positions, no addresses, the
// same on every machine (integers and floats are fed little-endian).
#pragma once

#include <compare>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>

namespace scenec {

struct Hash128 {
  std::uint64_t low = 0;
  std::uint64_t high = 0;
  friend constexpr auto operator<=>(const Hash128&, const Hash128&) = default;
  // 32 lower-case hexadecimal digits, high word first.
  [[nodiscard]] std::string hex() const;
};

[[nodiscard]] Hash128 hash_bytes(std::string_view bytes);

// Feeds values one after the other. Strings are fed with their length, so that "ab","c" and
// "a","bc" differ; -0.0 is fed as 0.0.
class Hasher {
 public:
  Hasher();
  ~Hasher();
  Hasher(Hasher&&) noexcept;
  Hasher& operator=(Hasher&&) noexcept;

  void raw(const void* data, std::size_t size);
  void add(std::string_view text);
  void add(double value);
  void add(Hash128 value);
  template <class T>
    requires std::integral<T> || std::is_enum_v<T>
  void add(T value) {
    const auto wide = static_cast<std::uint64_t>(value);
    raw(&wide, sizeof wide);
  }
  [[nodiscard]] Hash128 result() const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace scenec

template <>
struct std::hash<scenec::Hash128> {
  std::size_t operator()(const scenec::Hash128& value) const noexcept {
    return static_cast<std::size_t>(value.low);
  }
};
