#include "base/source_map.hpp"

#include <algorithm>
#include <limits>
#include <mutex>
#include <optional>
#include <utility>

#include "base/assert.hpp"
#include "base/text.hpp"

namespace scenec {

namespace {

constexpr std::string_view byte_order_mark = "\xef\xbb\xbf";
// Code points are counted once a block of this many bytes, so that a column in a line of 64 MiB
// costs a walk over one block and not over the line.
constexpr std::size_t block_size = 4096;

constexpr std::uint32_t no_range = std::numeric_limits<std::uint32_t>::max();

struct LineIndex {
  std::vector<std::uint32_t> line_starts;
  std::vector<std::uint32_t> code_points_before_block;
};

LineIndex index_of(std::string_view text) {
  LineIndex index;
  index.line_starts.push_back(text.starts_with(byte_order_mark) ? 3 : 0);
  for (std::size_t at = text.find('\n'); at != std::string_view::npos;
       at = text.find('\n', at + 1)) {
    index.line_starts.push_back(static_cast<std::uint32_t>(at + 1));
  }
  std::size_t code_points = 0;
  for (std::size_t at = 0; at <= text.size(); at += block_size) {
    index.code_points_before_block.push_back(static_cast<std::uint32_t>(code_points));
    code_points += count_code_points(text.substr(at, block_size));
  }
  return index;
}

// The ranges by begin, wider before narrower, and for each the narrowest range around it.
struct RangeTree {
  std::vector<DerivedRange> ranges;
  std::vector<std::uint32_t> enclosing;

  explicit RangeTree(std::vector<DerivedRange> unsorted) : ranges(std::move(unsorted)) {
    std::stable_sort(ranges.begin(), ranges.end(),
                     [](const DerivedRange& a, const DerivedRange& b) {
                       return a.begin != b.begin ? a.begin < b.begin : a.end > b.end;
                     });
    enclosing.reserve(ranges.size());
    std::uint32_t top = no_range;
    for (std::uint32_t i = 0; i < ranges.size(); ++i) {
      while (top != no_range && ranges[top].end < ranges[i].end) top = enclosing[top];
      enclosing.push_back(top);
      top = i;
    }
  }

  // The last range that begins at or before `offset`: itself or one around it holds the offset.
  [[nodiscard]] std::uint32_t last_before(std::uint32_t offset) const {
    const auto after = std::upper_bound(
        ranges.begin(), ranges.end(), offset,
        [](std::uint32_t value, const DerivedRange& range) { return value < range.begin; });
    return after == ranges.begin() ? no_range
                                   : static_cast<std::uint32_t>(after - ranges.begin() - 1);
  }

  [[nodiscard]] std::uint32_t narrowest(std::uint32_t begin, std::uint32_t end) const {
    std::uint32_t at = last_before(begin);
    while (at != no_range && ranges[at].end < end) at = enclosing[at];
    return at;
  }
};

}  // namespace

struct SourceMap::File {
  std::string path;
  std::string_view text;
  std::shared_ptr<const void> owner;
  FileId parent;  // invalid for a file of the disk
  std::optional<RangeTree> ranges;
  mutable std::once_flag indexed;
  mutable LineIndex lazy_index;

  [[nodiscard]] const LineIndex& index() const {
    std::call_once(indexed, [this] { lazy_index = index_of(text); });
    return lazy_index;
  }
  [[nodiscard]] std::size_t line_of(std::uint32_t offset) const {
    const auto& starts = index().line_starts;
    const auto after = std::upper_bound(starts.begin(), starts.end(), offset);
    return after == starts.begin() ? 0 : static_cast<std::size_t>(after - starts.begin() - 1);
  }
  [[nodiscard]] std::size_t code_points_before(std::size_t offset) const {
    const std::size_t block = offset / block_size;
    return index().code_points_before_block[block] +
           count_code_points(text.substr(block * block_size, offset % block_size));
  }
};

SourceMap::SourceMap() = default;
SourceMap::~SourceMap() = default;
SourceMap::SourceMap(SourceMap&&) noexcept = default;
SourceMap& SourceMap::operator=(SourceMap&&) noexcept = default;

FileId SourceMap::add(std::string path, std::string_view text, std::shared_ptr<const void> owner) {
  SCENEC_ASSERT(text.size() < std::numeric_limits<std::uint32_t>::max());
  auto file = std::make_unique<File>();
  file->path = std::move(path);
  file->text = text;
  file->owner = std::move(owner);
  files_.push_back(std::move(file));
  return FileId(static_cast<std::uint32_t>(files_.size() - 1));
}

FileId SourceMap::add(std::string path, std::string text) {
  const auto owner = std::make_shared<const std::string>(std::move(text));
  return add(std::move(path), *owner, owner);
}

FileId SourceMap::add_derived(FileId parent, std::string text, std::vector<DerivedRange> ranges) {
  const FileId id = add(std::string(path(parent)), std::move(text));
  files_[id.value()]->parent = parent;
  files_[id.value()]->ranges.emplace(std::move(ranges));
  return id;
}

std::uint64_t SourceMap::text_bytes() const {
  std::uint64_t bytes = 0;
  for (const auto& file : files_) bytes += file->text.size();
  return bytes;
}

void SourceMap::truncate(std::size_t size) {
  SCENEC_ASSERT(size <= files_.size());
  files_.resize(size);
}

std::string_view SourceMap::path(FileId file) const {
  SCENEC_ASSERT(file.value() < files_.size());
  return files_[file.value()]->path;
}

std::string_view SourceMap::text(FileId file) const {
  SCENEC_ASSERT(file.value() < files_.size());
  return files_[file.value()]->text;
}

std::string_view SourceMap::text(Span span) const {
  const std::string_view whole = text(span.file);
  const std::size_t begin = std::min<std::size_t>(span.begin, whole.size());
  return whole.substr(begin, span.end > begin ? span.end - begin : 0);
}

Position SourceMap::position(FileId file, std::uint32_t offset) const {
  SCENEC_ASSERT(file.value() < files_.size());
  const File& source = *files_[file.value()];
  const std::size_t line = source.line_of(offset);
  const std::size_t start = source.index().line_starts[line];
  const std::size_t at = std::clamp<std::size_t>(offset, start, source.text.size());
  const std::size_t column = source.code_points_before(at) - source.code_points_before(start) + 1;
  return {static_cast<std::uint32_t>(line + 1), static_cast<std::uint32_t>(column)};
}

std::string_view SourceMap::line(FileId file, std::uint32_t line_number) const {
  SCENEC_ASSERT(file.value() < files_.size());
  const File& source = *files_[file.value()];
  const auto& starts = source.index().line_starts;
  if (line_number == 0 || line_number > starts.size()) return {};
  const std::size_t begin = starts[line_number - 1];
  // What follows the last line start is the rest of the text; else the line ends before its `\n`.
  const std::size_t end =
      line_number < starts.size() ? starts[line_number] - std::size_t{1} : source.text.size();
  std::string_view line = source.text.substr(begin, end - begin);
  if (line.ends_with('\r')) line.remove_suffix(1);
  return line;
}

Span SourceMap::resolve(Span span) const {
  while (span.valid()) {
    SCENEC_ASSERT(span.file.value() < files_.size());
    const File& file = *files_[span.file.value()];
    if (!file.ranges) break;
    const RangeTree& tree = *file.ranges;
    std::uint32_t at = tree.narrowest(span.begin, span.end);
    if (at == no_range) at = tree.narrowest(span.begin, span.begin);
    if (at == no_range) at = tree.last_before(span.begin);
    if (at == no_range) return {file.parent, 0, 0};
    const DerivedRange& range = tree.ranges[at];
    Span origin{file.parent, range.origin_begin, range.origin_end};
    // Text that was copied as it stands keeps its exact places.
    const bool inside = span.begin >= range.begin && span.end <= range.end;
    if (inside && range.end - range.begin == range.origin_end - range.origin_begin &&
        text(origin) == text(Span{span.file, range.begin, range.end})) {
      origin = {file.parent, range.origin_begin + (span.begin - range.begin),
                range.origin_begin + (span.end - range.begin)};
    }
    span = origin;
  }
  return span;
}

}  // namespace scenec
