// The values of a PLY body, one after the other, in the three formats. Both readers have the same
// members, so that what is made of the values is written once; neither reads outside its bytes.
#pragma once

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <limits>
#include <string_view>
#include <type_traits>

#include "backend/assets/mesh_data.hpp"
#include "backend/assets/ply_header.hpp"
#include "base/text_scan.hpp"

namespace scenec::backend {

enum class RowProblem : std::uint8_t {
  none,
  truncated,
  unparsable,
  not_whole,
  list_too_long,
  extra
};

// Values of an ascii body: one row a line, blank lines between rows allowed.
class AsciiBody {
 public:
  static constexpr bool is_binary = false;
  AsciiBody(std::string_view bytes, std::uint64_t first_line, const MeshLimits& limits)
      : scanner_(bytes, limits.line_bytes, LineScanner::Continuation::none),
        first_line_(first_line) {}

  RowProblem begin_row() {
    std::string_view line;
    do {
      if (!scanner_.next(line)) return RowProblem::truncated;
      cursor_ = WordCursor(line);
      cursor_.skip_blanks();
    } while (cursor_.position() == cursor_.end());
    return RowProblem::none;
  }
  RowProblem end_row() {
    cursor_.skip_blanks();
    return cursor_.position() == cursor_.end() ? RowProblem::none : RowProblem::extra;
  }
  RowProblem value(PlyType type, double& value) {
    switch (cursor_.number(value)) {
      case NumberProblem::none:
        break;
      case NumberProblem::missing:
        return RowProblem::truncated;
      case NumberProblem::not_finite:
        value = std::numeric_limits<double>::infinity();
        static_cast<void>(cursor_.word());
        break;
      case NumberProblem::unparsable:
        return RowProblem::unparsable;
    }
    return is_real(type) || std::trunc(value) == value ? RowProblem::none : RowProblem::not_whole;
  }
  // Every item takes at least two bytes of the line (the last one a byte).
  [[nodiscard]] bool can_hold(double count, PlyType) const {
    return count * 2 <= static_cast<double>(cursor_.end() - cursor_.position()) + 1;
  }
  RowProblem skip(double count, PlyType type) {
    double ignored = 0;
    for (double i = 0; i < count; ++i) {
      if (const RowProblem problem = value(type, ignored); problem != RowProblem::none) {
        return problem;
      }
    }
    return RowProblem::none;
  }
  [[nodiscard]] std::uint64_t line() const { return first_line_ + scanner_.line() - 1; }
  [[nodiscard]] std::size_t rest() const {
    const bool blank =
        std::ranges::all_of(scanner_.rest(), [](char c) { return is_blank(c) || c == '\n'; });
    return blank ? 0 : scanner_.rest().size();
  }

 private:
  LineScanner scanner_;
  std::uint64_t first_line_;
  WordCursor cursor_{std::string_view{}};
};

// Values of a binary body. `swapped`: its byte order is not the machine's.
template <bool swapped>
class BinaryBody {
 public:
  static constexpr bool is_binary = true;
  explicit BinaryBody(std::string_view bytes) : rest_(bytes) {}

  // The bytes of rows of one size, which are then behind; empty when there are not as many.
  std::string_view take_rows(std::uint64_t count, std::size_t row_size) {
    if (row_size == 0 || count > rest_.size() / row_size) return {};
    const std::string_view rows = rest_.substr(0, static_cast<std::size_t>(count) * row_size);
    rest_.remove_prefix(rows.size());
    return rows;
  }
  // What has not been read.
  [[nodiscard]] std::string_view bytes() const { return rest_; }
  void advance(std::size_t size) { rest_.remove_prefix(size); }

  // The value that lies at `from`.
  template <class T>
  static T load(const char* from) {
    using Bits = std::conditional_t<
        sizeof(T) == 1, std::uint8_t,
        std::conditional_t<sizeof(T) == 2, std::uint16_t,
                           std::conditional_t<sizeof(T) == 4, std::uint32_t, std::uint64_t>>>;
    Bits bits;
    std::memcpy(&bits, from, sizeof bits);
    if constexpr (swapped && sizeof bits == 2) bits = __builtin_bswap16(bits);
    if constexpr (swapped && sizeof bits == 4) bits = __builtin_bswap32(bits);
    if constexpr (swapped && sizeof bits == 8) bits = __builtin_bswap64(bits);
    return std::bit_cast<T>(bits);
  }

  RowProblem begin_row() { return RowProblem::none; }
  RowProblem end_row() { return RowProblem::none; }
  RowProblem value(PlyType type, double& value) {
    if (rest_.size() < size_of(type)) return RowProblem::truncated;
    switch (type) {
      case PlyType::int8:
        value = take<std::int8_t>();
        break;
      case PlyType::uint8:
        value = take<std::uint8_t>();
        break;
      case PlyType::int16:
        value = take<std::int16_t>();
        break;
      case PlyType::uint16:
        value = take<std::uint16_t>();
        break;
      case PlyType::int32:
        value = take<std::int32_t>();
        break;
      case PlyType::uint32:
        value = take<std::uint32_t>();
        break;
      case PlyType::float32:
        value = static_cast<double>(take<float>());
        break;
      case PlyType::float64:
        value = take<double>();
        break;
    }
    return RowProblem::none;
  }
  [[nodiscard]] bool can_hold(double count, PlyType type) const {
    return count * static_cast<double>(size_of(type)) <= static_cast<double>(rest_.size());
  }
  RowProblem skip(double count, PlyType type) {
    rest_.remove_prefix(static_cast<std::size_t>(count) * size_of(type));
    return RowProblem::none;
  }
  [[nodiscard]] std::uint64_t line() const { return 0; }
  [[nodiscard]] std::size_t rest() const { return rest_.size(); }

 private:
  template <class T>
  T take() {
    const T value = load<T>(rest_.data());
    rest_.remove_prefix(sizeof value);
    return value;
  }

  std::string_view rest_;
};

}  // namespace scenec::backend
