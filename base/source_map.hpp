// Owns the text of every source file of one compilation and turns byte spans into places people
// read. A derived file (native text translated from a course file) knows which range of its parent
// each of its ranges came from, so every span can be resolved to what the author wrote.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "base/span.hpp"

namespace scenec {

// Line and column, 1-based; columns count code points.
struct Position {
  std::uint32_t line = 1;
  std::uint32_t column = 1;
};

// [begin, end) of a derived text came from [origin_begin, origin_end) of its parent file. Ranges
// may nest; the narrowest one that holds a span decides.
struct DerivedRange {
  std::uint32_t begin = 0;
  std::uint32_t end = 0;
  std::uint32_t origin_begin = 0;
  std::uint32_t origin_end = 0;
};

class SourceMap {
 public:
  SourceMap();
  ~SourceMap();
  SourceMap(SourceMap&&) noexcept;
  SourceMap& operator=(SourceMap&&) noexcept;

  // `path` is how messages name the file. `owner` keeps the bytes of `text` alive.
  FileId add(std::string path, std::string_view text, std::shared_ptr<const void> owner);
  FileId add(std::string path, std::string text);
  FileId add_derived(FileId parent, std::string text, std::vector<DerivedRange> ranges);

  [[nodiscard]] std::size_t size() const { return files_.size(); }
  [[nodiscard]] std::uint64_t text_bytes() const;  // of all files
  // Forgets the files added last; spans into them must be gone.
  void truncate(std::size_t size);

  [[nodiscard]] std::string_view path(FileId file) const;
  [[nodiscard]] std::string_view text(FileId file) const;
  [[nodiscard]] std::string_view text(Span span) const;
  [[nodiscard]] Position position(FileId file, std::uint32_t offset) const;
  // The text of a 1-based line without its line end.
  [[nodiscard]] std::string_view line(FileId file, std::uint32_t line_number) const;
  // The span in the file the author wrote; a span of an ordinary file is returned unchanged.
  [[nodiscard]] Span resolve(Span span) const;

 private:
  struct File;
  std::vector<std::unique_ptr<File>> files_;
};

}  // namespace scenec
