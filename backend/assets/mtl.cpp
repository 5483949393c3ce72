#include "backend/assets/mtl.hpp"

#include <fmt/format.h>

#include <cmath>
#include <utility>

#include "backend/assets/text_scan.hpp"
#include "base/text.hpp"

namespace scenec::backend {
namespace {

constexpr std::size_t shown_text = 60;

// How many values stand behind an option of a map statement; -1: not an option.
int least_values_of(std::string_view option) {
  for (const std::string_view name : {"-o", "-s", "-t"}) {
    if (option == name) return 1;  // up to three
  }
  for (const std::string_view name :
       {"-blendu", "-blendv", "-bm", "-boost", "-cc", "-clamp", "-imfchan", "-texres", "-type"}) {
    if (option == name) return 1;
  }
  return option == "-mm" ? 2 : -1;
}

bool takes_three(std::string_view option) {
  return option == "-o" || option == "-s" || option == "-t";
}

// The file name behind the options; it may hold blanks.
std::string_view map_file(WordCursor cursor) {
  while (true) {
    const std::string_view option = cursor.peek();
    const int values = least_values_of(option);
    if (values < 0) return cursor.rest();
    static_cast<void>(cursor.word());
    for (int i = 0; i < values; ++i) static_cast<void>(cursor.word());
    double ignored = 0;
    for (int i = 0; takes_three(option) && i < 2; ++i) {
      if (cursor.number(ignored) != NumberProblem::none) break;
    }
  }
}

class MtlReader {
 public:
  MtlReader(std::string_view bytes, const MeshLimits& limits)
      : limits_(limits), scanner_(bytes, limits.line_bytes, LineScanner::Continuation::backslash) {}

  Result<MtlLibrary, AssetProblem> run() {
    std::string_view line;
    while (scanner_.next(line)) {
      WordCursor cursor(line);
      // Widely copied libraries hold two statements on one line (`Tr 0  illum 2`).
      while (!cursor.at_end()) {
        if (!statement(cursor)) return Failure{std::move(problem_)};
      }
    }
    if (scanner_.too_long()) {
      fail(fmt::format("line longer than {} bytes", limits_.line_bytes));
      return Failure{std::move(problem_)};
    }
    return std::move(library_);
  }

 private:
  bool fail(std::string message) {
    problem_ = {scanner_.line(), std::move(message)};
    return false;
  }

  bool statement(WordCursor& cursor) {
    const std::string_view keyword = cursor.word();
    if (keyword == "newmtl") {
      library_.materials.push_back({});
      library_.materials.back().name = cursor.rest();
      library_.materials.back().line = scanner_.line();
      cursor.move_to(cursor.end());
      return !library_.materials.back().name.empty() || fail("`newmtl` without a name");
    }
    if (library_.materials.empty()) {
      return fail(fmt::format("`{}` before the first `newmtl`", printable(keyword, shown_text)));
    }
    return value(keyword, cursor, library_.materials.back());
  }

  bool value(std::string_view keyword, WordCursor& cursor, MtlMaterial& material) {
    if (keyword == "Kd") return colour(keyword, cursor, material.diffuse);
    if (keyword == "Ks") return colour(keyword, cursor, material.specular);
    if (keyword == "Ke") return colour(keyword, cursor, material.emission);
    if (keyword == "Ka") return colour(keyword, cursor, material.ambient);
    if (keyword == "Ns") return number(keyword, cursor, material.shininess);
    if (keyword == "Ni") return number(keyword, cursor, material.ior);
    if (keyword == "d") {
      if (cursor.peek() == "-halo") static_cast<void>(cursor.word());
      return number(keyword, cursor, material.opacity);
    }
    if (keyword == "Tr") {
      if (!number(keyword, cursor, material.opacity)) return false;
      material.opacity = 1 - *material.opacity;
      return true;
    }
    if (keyword == "illum") return illumination(cursor, material);
    if (keyword == "map_Kd") return map(keyword, cursor, material.diffuse_map);
    if (keyword == "map_d") return map(keyword, cursor, material.opacity_map);
    if (keyword == "map_bump" || keyword == "map_Bump" || keyword == "bump") {
      return map(keyword, cursor, material.bump_map);
    }
    return ignore(keyword, cursor);
  }

  bool ignore(std::string_view keyword, WordCursor& cursor) {
    cursor.move_to(cursor.end());
    if (library_.ignored.count++ == 0) {
      library_.ignored.first_line = scanner_.line();
      library_.ignored.first_keyword = printable(keyword, shown_text);
    }
    return true;
  }

  bool read(std::string_view keyword, WordCursor& cursor, double& number) {
    const NumberProblem problem = cursor.number(number);
    if (problem == NumberProblem::none) return true;
    return fail(fmt::format("value of `{}` {}", keyword, describe(problem, cursor.peek())));
  }

  // Another number cannot begin a statement.
  bool finish(std::string_view keyword, WordCursor& cursor) {
    double ignored = 0;
    if (WordCursor(cursor).number(ignored) != NumberProblem::none) return true;
    return fail(
        fmt::format("unexpected `{}` behind `{}`", printable(cursor.rest(), shown_text), keyword));
  }

  bool number(std::string_view keyword, WordCursor& cursor, std::optional<double>& target) {
    double number = 0;
    if (!read(keyword, cursor, number)) return false;
    target = number;
    return finish(keyword, cursor);
  }

  // Three numbers, or one for all three. `spectral` and `xyz` forms are read over.
  bool colour(std::string_view keyword, WordCursor& cursor,
              std::optional<std::array<double, 3>>& target) {
    if (cursor.peek() == "spectral" || cursor.peek() == "xyz") return ignore(keyword, cursor);
    std::array<double, 3> rgb{};
    if (!read(keyword, cursor, rgb[0])) return false;
    rgb[1] = rgb[2] = rgb[0];
    if (!cursor.at_end() && (!read(keyword, cursor, rgb[1]) || !read(keyword, cursor, rgb[2]))) {
      return false;
    }
    target = rgb;
    return finish(keyword, cursor);
  }

  bool illumination(WordCursor& cursor, MtlMaterial& material) {
    double number = 0;
    if (!read("illum", cursor, number)) return false;
    if (!(number >= 0 && number <= 10) || std::trunc(number) != number) {
      return fail(fmt::format("`illum` is {}; needs a whole number from 0 to 10", number));
    }
    material.illumination = static_cast<int>(number);
    return finish("illum", cursor);
  }

  bool map(std::string_view keyword, WordCursor& cursor, std::string& target) {
    target = map_file(cursor);
    cursor.move_to(cursor.end());
    return !target.empty() || fail(fmt::format("`{}` without a file name", keyword));
  }

  const MeshLimits& limits_;
  LineScanner scanner_;
  MtlLibrary library_;
  AssetProblem problem_;
};

}  // namespace

Result<MtlLibrary, AssetProblem> read_mtl(std::string_view bytes, const MeshLimits& limits) {
  if (bytes.size() > limits.file_bytes) {
    return Failure{AssetProblem{0, fmt::format("file has {} bytes; at most {} are allowed",
                                               bytes.size(), limits.file_bytes)}};
  }
  return MtlReader(bytes, limits).run();
}

}  // namespace scenec::backend
