#include "frontend/course/mtl.hpp"

#include <fmt/format.h>

#include <array>
#include <utility>

#include "base/text.hpp"
#include "base/text_scan.hpp"

namespace scenec::frontend::course {
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
  MtlReader(std::string_view bytes, std::size_t longest_line)
      : scanner_(bytes, longest_line, LineScanner::Continuation::backslash) {}

  Result<std::vector<MtlMaterial>, AssetProblem> run() {
    const bool read = for_each_line(scanner_, problem_, [&](std::string_view line) {
      WordCursor cursor(line);
      // Widely copied libraries hold two statements on one line (`Tr 0  illum 2`).
      while (!cursor.at_end()) {
        if (!statement(cursor)) return false;
      }
      return true;
    });
    if (!read) return Failure{std::move(problem_)};
    return std::move(materials_);
  }

 private:
  bool fail(std::string message) {
    problem_ = {scanner_.line(), std::move(message)};
    return false;
  }

  bool statement(WordCursor& cursor) {
    const std::string_view keyword = cursor.word();
    if (keyword == "newmtl") {
      materials_.push_back({});
      materials_.back().name = cursor.rest();
      cursor.move_to(cursor.end());
      return !materials_.back().name.empty() || fail("`newmtl` without a name");
    }
    if (materials_.empty()) {
      return fail(fmt::format("`{}` before the first `newmtl`", printable(keyword, shown_text)));
    }
    return value(keyword, cursor, materials_.back());
  }

  bool value(std::string_view keyword, WordCursor& cursor, MtlMaterial& material) {
    if (keyword == "Kd") return colour(keyword, cursor, material.diffuse);
    if (keyword == "Ks") return colour(keyword, cursor, material.specular);
    if (keyword == "Ke") return colour(keyword, cursor, material.emission);
    if (keyword == "Ns") return number(keyword, cursor, material.shininess);
    if (keyword == "map_Kd") return map(keyword, cursor, material.diffuse_map);
    if (takes_numbers(keyword)) return skip_numbers(cursor);
    return skip_rest(cursor);
  }

  // Whatever else it says does not matter here, but another statement may follow on the line.
  static bool takes_numbers(std::string_view keyword) {
    return keyword == "Ka" || keyword == "Ni" || keyword == "Tr" || keyword == "illum";
  }
  static bool skip_numbers(WordCursor& cursor) {
    double ignored = 0;
    while (cursor.number(ignored) == NumberProblem::none) {
    }
    return true;
  }

  static bool skip_rest(WordCursor& cursor) {
    cursor.move_to(cursor.end());
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
    if (cursor.peek() == "spectral" || cursor.peek() == "xyz") return skip_rest(cursor);
    std::array<double, 3> rgb{};
    if (!read(keyword, cursor, rgb[0])) return false;
    rgb[1] = rgb[2] = rgb[0];
    if (!cursor.at_end() && (!read(keyword, cursor, rgb[1]) || !read(keyword, cursor, rgb[2]))) {
      return false;
    }
    target = rgb;
    return finish(keyword, cursor);
  }

  bool map(std::string_view keyword, WordCursor& cursor, std::string& target) {
    target = map_file(cursor);
    cursor.move_to(cursor.end());
    return !target.empty() || fail(fmt::format("`{}` without a file name", keyword));
  }

  LineScanner scanner_;
  std::vector<MtlMaterial> materials_;
  AssetProblem problem_;
};

}  // namespace

Result<std::vector<MtlMaterial>, AssetProblem> read_mtl(std::string_view bytes,
                                                        std::size_t longest_line) {
  return MtlReader(bytes, longest_line).run();
}

}  // namespace scenec::frontend::course
