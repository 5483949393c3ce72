// 128-bit content hashes (XXH3). The value depends on bytes only: no positions, no addresses, the
// same on every machine (integers and floats are fed little-endian).
#pragma once

#include <array>
#include <compare>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <cstring>
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
  void add(double value) { add_word(value == 0 ? 0.0 : value); }
  void add(Hash128 value);
  template <class T>
    requires std::integral<T> || std::is_enum_v<T>
  void add(T value) {
    add_word(static_cast<std::uint64_t>(value));
  }
  [[nodiscard]] Hash128 result() const;

 private:
  // Words are gathered before they are hashed: most of what is fed is eight bytes long.
  template <class T>
  void add_word(T value) {
    static_assert(sizeof value == 8);
    if (gathered_ == gather_.size()) flush();
    std::memcpy(gather_.data() + gathered_, &value, sizeof value);
    gathered_ += sizeof value;
  }
  void flush();

  struct State;
  std::unique_ptr<State> state_;
  std::array<unsigned char, 512> gather_;
  std::size_t gathered_ = 0;
};

}  // namespace scenec

template <>
struct std::hash<scenec::Hash128> {
  std::size_t operator()(const scenec::Hash128& value) const noexcept {
    return static_cast<std::size_t>(value.low);
  }
};
