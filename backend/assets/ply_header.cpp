#include "backend/assets/ply_header.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <optional>
#include <utility>

#include "base/text.hpp"
#include "base/text_scan.hpp"

namespace scenec::backend {
namespace {

constexpr std::size_t shown_text = 40;
constexpr std::size_t most_properties = 1'024;  // over all elements

// Products of two 64-bit counts; GCC and clang both have it, -Wpedantic needs the word.
__extension__ using Wide = unsigned __int128;

std::optional<PlyType> find_type(std::string_view word) {
  struct Row {
    std::string_view old_name;
    std::string_view new_name;
  };
  constexpr Row rows[] = {{"char", "int8"},     {"uchar", "uint8"},   {"short", "int16"},
                          {"ushort", "uint16"}, {"int", "int32"},     {"uint", "uint32"},
                          {"float", "float32"}, {"double", "float64"}};
  for (std::size_t i = 0; i < std::size(rows); ++i) {
    if (word == rows[i].old_name || word == rows[i].new_name) return static_cast<PlyType>(i);
  }
  return std::nullopt;
}

class HeaderReader {
 public:
  HeaderReader(std::string_view bytes, const MeshLimits& limits)
      : bytes_(bytes), scanner_(bytes, limits.line_bytes, LineScanner::Continuation::none) {}

  Result<PlyHeader, AssetProblem> run() {
    std::string_view line;
    if (!scanner_.next(line) || trimmed(line) != "ply") {
      return Failure{AssetProblem{1, "not a PLY file; the first line must be `ply`"}};
    }
    const bool ended = for_each_line(scanner_, problem_, [&](std::string_view text) {
      WordCursor cursor(text);
      return cursor.peek().empty() || (statement(cursor) && !done_);
    });
    if (ended) fail("`end_header` is missing");
    if (!done_) return Failure{std::move(problem_)};
    header_.body_offset = bytes_.size() - scanner_.rest().size();
    header_.body_line = scanner_.line() + 1;
    if (!check()) return Failure{std::move(problem_)};
    return std::move(header_);
  }

 private:
  bool fail(std::string message) {
    problem_ = {scanner_.line(), std::move(message)};
    return false;
  }

  bool statement(WordCursor& cursor) {
    const std::string_view keyword = cursor.word();
    if (keyword == "comment" || keyword == "obj_info") return true;
    if (keyword == "format") return format(cursor);
    if (keyword == "element") return element(cursor);
    if (keyword == "property") return property(cursor);
    if (keyword != "end_header") {
      return fail(fmt::format("unknown header word `{}`", printable(keyword, shown_text)));
    }
    done_ = true;
    return true;
  }

  bool format(WordCursor& cursor) {
    const std::string_view name = cursor.word();
    const std::string_view version = cursor.word();
    if (has_format_) return fail("second `format` line");
    has_format_ = true;
    if (name == "ascii") {
      header_.format = PlyFormat::ascii;
    } else if (name == "binary_little_endian") {
      header_.format = PlyFormat::binary_little_endian;
    } else if (name == "binary_big_endian") {
      header_.format = PlyFormat::binary_big_endian;
    } else {
      return fail(fmt::format("unknown format `{}`", printable(name, shown_text)));
    }
    return version == "1.0" ||
           fail(fmt::format("PLY version `{}`; only 1.0 is known", printable(version, shown_text)));
  }

  bool element(WordCursor& cursor) {
    PlyElement element;
    element.name = cursor.word();
    element.line = scanner_.line();
    const std::string_view count = cursor.word();
    const auto result = std::from_chars(count.data(), count.data() + count.size(), element.count);
    if (count.empty() || result.ec != std::errc{} || result.ptr != count.data() + count.size()) {
      return fail(fmt::format("count of element `{}` is `{}`; needs a whole number from 0",
                              printable(element.name, shown_text), printable(count, shown_text)));
    }
    const auto same = [&](const PlyElement& other) { return other.name == element.name; };
    if (std::ranges::any_of(header_.elements, same)) {
      return fail(fmt::format("second element `{}`", printable(element.name, shown_text)));
    }
    if (header_.elements.size() == most_properties) {
      return fail(fmt::format("more than {} elements", most_properties));
    }
    header_.elements.push_back(std::move(element));
    return true;
  }

  bool type(WordCursor& cursor, PlyType& type) {
    const std::string_view word = cursor.word();
    const std::optional<PlyType> found = find_type(word);
    if (!found) return fail(fmt::format("unknown type `{}`", printable(word, shown_text)));
    type = *found;
    return true;
  }

  bool property(WordCursor& cursor) {
    if (header_.elements.empty()) return fail("`property` before the first `element`");
    PlyProperty property;
    if (cursor.peek() == "list") {
      static_cast<void>(cursor.word());
      property.is_list = true;
      if (!type(cursor, property.count_type)) return false;
      if (is_real(property.count_type)) return fail("list count must have a whole-number type");
    }
    if (!type(cursor, property.type)) return false;
    property.name = cursor.word();
    if (property.name.empty()) return fail("property without a name");
    std::vector<PlyProperty>& properties = header_.elements.back().properties;
    const auto same = [&](const PlyProperty& other) { return other.name == property.name; };
    if (std::ranges::any_of(properties, same)) {
      return fail(fmt::format("second property `{}` in element `{}`",
                              printable(property.name, shown_text),
                              printable(header_.elements.back().name, shown_text)));
    }
    if (++property_count_ > most_properties) {
      return fail(fmt::format("more than {} properties", most_properties));
    }
    properties.push_back(std::move(property));
    return true;
  }

  // The body must be able to hold all rows at their smallest, in exact arithmetic.
  bool check() {
    if (!has_format_) return fail("`format` line is missing");
    Wide needed = 0;
    const std::uint64_t rest = bytes_.size() - header_.body_offset;
    for (const PlyElement& element : header_.elements) {
      const std::uint64_t row = least_row_size(element, header_.format);
      if (element.count > 0 && row == 0) {
        problem_ = {element.line, fmt::format("element `{}` has rows but no property",
                                              printable(element.name, shown_text))};
        return false;
      }
      needed += Wide{element.count} * row;
      // The last ascii row may lack its line end.
      if (needed > Wide{rest} + 1) {
        problem_ = {element.line,
                    fmt::format("element `{}` with {} rows does not fit the {} bytes that follow",
                                printable(element.name, shown_text), element.count, rest)};
        return false;
      }
    }
    return true;
  }

  std::string_view bytes_;
  LineScanner scanner_;
  PlyHeader header_;
  AssetProblem problem_;
  std::size_t property_count_ = 0;
  bool has_format_ = false;
  bool done_ = false;
};

}  // namespace

std::uint64_t least_row_size(const PlyElement& element, PlyFormat format) {
  std::uint64_t size = 0;
  for (const PlyProperty& property : element.properties) {
    if (format == PlyFormat::ascii) {
      size += 2;  // a digit and a blank or line end
    } else {
      size += size_of(property.is_list ? property.count_type : property.type);
    }
  }
  return size;
}

Result<PlyHeader, AssetProblem> read_ply_header(std::string_view bytes, const MeshLimits& limits) {
  return HeaderReader(bytes, limits).run();
}

}  // namespace scenec::backend
