// Plain values as the bytes they are in memory, one after the other, for entries of a ContentCache:
// those stay on their machine. Reading never goes beyond the bytes and allocates nothing for counts
// they cannot hold.
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <string>
#include <string_view>
#include <type_traits>

#include "base/huge_pages.hpp"

namespace scenec {

template <class T>
void append_packed(std::string& out, const T& value) {
  static_assert(std::is_trivially_copyable_v<T>);
  const std::size_t size = out.size();
  out.resize(size + sizeof value);
  std::memcpy(out.data() + size, &value, sizeof value);
}

template <class Vector>
[[nodiscard]] std::string_view packed_bytes_of(const Vector& values) {
  static_assert(std::is_trivially_copyable_v<typename Vector::value_type>);
  return {reinterpret_cast<const char*>(values.data()),
          values.size() * sizeof(typename Vector::value_type)};
}

// Takes values off the front; after the first that is not there, nothing is.
class PackedReader {
 public:
  explicit PackedReader(std::string_view bytes) : rest_(bytes) {}
  [[nodiscard]] bool ok() const { return ok_; }
  [[nodiscard]] bool at_end() const { return ok_ && rest_.empty(); }
  void refuse() { ok_ = false; }

  [[nodiscard]] std::string_view take(std::uint64_t size) {
    ok_ = ok_ && size <= rest_.size();
    if (!ok_) return {};
    const std::string_view taken = rest_.substr(0, static_cast<std::size_t>(size));
    rest_.remove_prefix(taken.size());
    return taken;
  }
  template <class T>
  [[nodiscard]] T value() {
    static_assert(std::is_trivially_copyable_v<T>);
    T value{};
    const std::string_view bytes = take(sizeof value);
    if (ok_) std::memcpy(&value, bytes.data(), sizeof value);
    return value;
  }
  template <class Vector>
  [[nodiscard]] Vector list(std::uint64_t count) {
    using T = typename Vector::value_type;
    static_assert(std::is_trivially_copyable_v<T>);
    ok_ = ok_ && count <= rest_.size() / sizeof(T);
    Vector values;
    if (!ok_ || count == 0) return values;
    const std::string_view bytes = take(count * sizeof(T));
    values.reserve(static_cast<std::size_t>(count));
    advise_huge_pages(values.data(), bytes.size());
    values.resize(static_cast<std::size_t>(count));
    std::memcpy(static_cast<void*>(values.data()), bytes.data(), bytes.size());
    return values;
  }

 private:
  std::string_view rest_;
  bool ok_ = true;
};

}  // namespace scenec
