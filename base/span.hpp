// A half-open byte range of one source file.
#pragma once

#include <compare>
#include <cstdint>

#include "base/ids.hpp"

namespace scenec {

struct SourceFile;
using FileId = Id<SourceFile>;

struct Span {
  FileId file;
  std::uint32_t begin = 0;
  std::uint32_t end = 0;

  [[nodiscard]] constexpr bool valid() const { return file.valid(); }
  friend constexpr auto operator<=>(const Span&, const Span&) = default;
};

// The smallest span that holds both; they must lie in the same file.
[[nodiscard]] constexpr Span join(Span a, Span b) {
  return {a.file, a.begin < b.begin ? a.begin : b.begin, a.end > b.end ? a.end : b.end};
}

}  // namespace scenec
