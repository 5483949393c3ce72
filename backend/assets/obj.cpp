#include "backend/assets/obj.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <optional>
#include <string>
#include <unordered_map>
#include <utility>

#include "backend/assets/triangulate.hpp"
#include "base/text.hpp"
#include "base/text_scan.hpp"

namespace scenec::backend {
namespace {

constexpr std::size_t shown_text = 60;
// Beyond this an index cannot be right: a vertex takes at least seven bytes.
constexpr std::uint64_t largest_index = 0xFFFF'FFFE;

// Gives each distinct name a number in order of first use.
class NameTable {
 public:
  std::uint32_t number_of(std::string_view name, std::vector<std::string>& names) {
    const auto [found, added] =
        numbers_.try_emplace(std::string(name), static_cast<std::uint32_t>(names.size()));
    if (added) names.emplace_back(name);
    return found->second;
  }

 private:
  std::unordered_map<std::string, std::uint32_t> numbers_;
};

// One of the three index spaces, and the farthest reference ahead of what has been read.
struct IndexSpace {
  std::string_view noun;
  std::uint64_t farthest = 0;  // 1-based
  std::uint64_t farthest_line = 0;
};

class ObjReader {
 public:
  ObjReader(std::string_view bytes, const MeshLimits& limits)
      : limits_(limits), scanner_(bytes, limits.line_bytes, LineScanner::Continuation::backslash) {}

  Result<MeshData, AssetProblem> run() {
    if (!for_each_line(scanner_, problem_, [&](std::string_view line) { return statement(line); }))
      return Failure{std::move(problem_)};
    if (!check_forward(vertices_, mesh_.positions.size()) ||
        !check_forward(uvs_, mesh_.uvs.size()) || !check_forward(normals_, mesh_.normals.size())) {
      return Failure{std::move(problem_)};
    }
    if (faces_.sizes.empty()) {
      return Failure{
          AssetProblem{0, fmt::format("no face (`f`) in {} lines", scanner_.line() - 1)}};
    }
    pad(faces_.corner_normals);
    pad(faces_.corner_uvs);
    if (auto problem = triangulate(std::move(faces_), limits_, mesh_))
      return Failure{std::move(*problem)};
    // What no face names goes with no vertex: without an index table it would be taken for the
    // attribute of the vertex in the same place.
    if (mesh_.normal_triangles.empty()) mesh_.normals.clear();
    if (mesh_.uv_triangles.empty()) mesh_.uvs.clear();
    return std::move(mesh_);
  }

 private:
  bool fail(std::string message, std::string_view limit_option = {}) {
    problem_ = {scanner_.line(), std::move(message), limit_option};
    return false;
  }

  bool statement(std::string_view line) {
    WordCursor cursor(line);
    cursor.skip_blanks();
    const char* p = cursor.position();
    if (p == cursor.end() || *p == '#') return true;
    const auto length = cursor.end() - p;
    const char second = length > 1 ? p[1] : ' ';
    if (*p == 'v') {
      if (is_blank(second)) return cursor.move_to(p + 1), vertex(cursor);
      const bool two_letters = length == 2 || is_blank(p[2]);
      if (second == 'n' && two_letters) return cursor.move_to(p + 2), normal(cursor);
      if (second == 't' && two_letters) return cursor.move_to(p + 2), uv(cursor);
    }
    if (*p == 'f' && is_blank(second)) return cursor.move_to(p + 1), face(cursor);
    other(cursor);
    return true;
  }

  void other(WordCursor& cursor) {
    const std::string_view keyword = cursor.word();
    if (keyword == "g" || keyword == "o") {
      group_ = group_table_.number_of(cursor.rest(), mesh_.group_names);
      part_open_ = false;
    } else if (keyword == "usemtl") {
      material_ = material_table_.number_of(cursor.rest(), mesh_.material_names);
      part_open_ = false;
    }
  }

  bool coordinate(WordCursor& cursor, std::string_view name, double& value) {
    const NumberProblem problem = cursor.number(value);
    if (problem == NumberProblem::none) return true;
    return fail(fmt::format("{} {}", name, describe(problem, cursor.peek())));
  }

  // Numbers that may follow (w, vertex colours) must be numbers, but are not kept.
  bool skip_numbers(WordCursor& cursor, int most) {
    double ignored = 0;
    for (int i = 0; i < most && !cursor.at_end(); ++i) {
      if (!coordinate(cursor, "extra value", ignored)) return false;
    }
    if (cursor.at_end()) return true;
    return fail(fmt::format("unexpected `{}` behind the coordinates",
                            printable(cursor.rest(), shown_text)));
  }

  bool vertex(WordCursor& cursor) {
    std::array<double, 3> p;
    if (!coordinate(cursor, "x of the vertex", p[0]) ||
        !coordinate(cursor, "y of the vertex", p[1]) ||
        !coordinate(cursor, "z of the vertex", p[2])) {
      return false;
    }
    mesh_.positions.push_back({p[0], p[1], p[2]});
    return cursor.at_end() || skip_numbers(cursor, 5);
  }

  bool narrow(double value, float& narrowed) {
    narrowed = static_cast<float>(value);
    return std::isfinite(narrowed) || fail(fmt::format("{} is beyond single precision", value));
  }

  bool normal(WordCursor& cursor) {
    std::array<double, 3> n;
    std::array<float, 3> stored;
    if (!coordinate(cursor, "x of the normal", n[0]) ||
        !coordinate(cursor, "y of the normal", n[1]) ||
        !coordinate(cursor, "z of the normal", n[2]) || !narrow(n[0], stored[0]) ||
        !narrow(n[1], stored[1]) || !narrow(n[2], stored[2])) {
      return false;
    }
    mesh_.normals.push_back(stored);
    return cursor.at_end() || skip_numbers(cursor, 0);
  }

  bool uv(WordCursor& cursor) {
    std::array<double, 2> t{0, 0};
    std::array<float, 2> stored;
    if (!coordinate(cursor, "u of the texture coordinate", t[0])) return false;
    if (!cursor.at_end() && !coordinate(cursor, "v of the texture coordinate", t[1])) return false;
    if (!narrow(t[0], stored[0]) || !narrow(t[1], stored[1])) return false;
    mesh_.uvs.push_back(stored);
    return cursor.at_end() || skip_numbers(cursor, 1);
  }

  // One index; the cursor `p` moves behind it. Message text only on the failing path.
  bool index(const char*& p, const char* end, IndexSpace& space, std::size_t count,
             std::uint32_t& resolved) {
    const char* begin = p;
    const bool negative = p != end && *p == '-';
    if (negative || (p != end && *p == '+')) ++p;
    const char* digits = p;
    std::uint64_t value = 0;
    while (p != end && *p >= '0' && *p <= '9' && value <= largest_index) {
      value = value * 10 + static_cast<std::uint64_t>(*p++ - '0');
    }
    if (p == digits) return bad_corner(begin, end, "needs whole numbers such as `3` or `3/1/2`");
    if (value == 0) return bad_corner(begin, end, "indices begin at 1, or at -1 from the end");
    if (negative) {
      if (value > count) {
        return bad_corner(begin, end, fmt::format("only {} {} come before", count, space.noun));
      }
      resolved = static_cast<std::uint32_t>(count - value);
      return true;
    }
    if (value > count) {
      if (value > largest_index) return bad_corner(begin, end, "index is too large");
      if (value > space.farthest) space = {space.noun, value, scanner_.line()};
    }
    resolved = static_cast<std::uint32_t>(value - 1);
    return true;
  }

  bool bad_corner(const char* begin, const char* end, std::string_view what) {
    const char* stop = begin;
    while (stop != end && !is_blank(*stop)) ++stop;
    const std::string_view word(begin, static_cast<std::size_t>(stop - begin));
    return fail(fmt::format("face index `{}`: {}", printable(word, shown_text), what));
  }

  // Corner forms a, a/t, a//n, a/t/n; all corners of a face use the same.
  struct Corner {
    std::uint32_t position = no_index;
    std::uint32_t uv = no_index;
    std::uint32_t normal = no_index;
  };

  bool corner(const char*& p, const char* end, Corner& corner) {
    const char* begin = p;
    if (!index(p, end, vertices_, mesh_.positions.size(), corner.position)) return false;
    if (p != end && *p == '/') {
      ++p;
      if (p != end && *p != '/' && !is_blank(*p) &&
          !index(p, end, uvs_, mesh_.uvs.size(), corner.uv)) {
        return false;
      }
      if (p != end && *p == '/') {
        ++p;
        if (p != end && !is_blank(*p) &&
            !index(p, end, normals_, mesh_.normals.size(), corner.normal)) {
          return false;
        }
      }
    }
    return p == end || is_blank(*p) || *p == '#' ||
           bad_corner(begin, end, "needs the form `a`, `a/t`, `a//n` or `a/t/n`");
  }

  bool face(WordCursor& cursor) {
    const std::size_t first = faces_.corner_positions.size();
    std::uint32_t size = 0;
    bool has_uv = false;
    bool has_normal = false;
    while (!cursor.at_end()) {
      Corner read;
      const char* p = cursor.position();
      if (!corner(p, cursor.end(), read)) return false;
      cursor.move_to(p);
      if (size == 0) {
        has_uv = read.uv != no_index;
        has_normal = read.normal != no_index;
      } else if (has_uv != (read.uv != no_index) || has_normal != (read.normal != no_index)) {
        return fail(fmt::format("corner {} of the face has another form than the first", size + 1));
      }
      if (size == limits_.polygon_vertices) {
        return fail(fmt::format("face with more than {} corners", limits_.polygon_vertices),
                    limit_option::polygon_corners);
      }
      ++size;
      faces_.corner_positions.push_back(read.position);
      if (has_uv) append(faces_.corner_uvs, first + size, read.uv);
      if (has_normal) append(faces_.corner_normals, first + size, read.normal);
    }
    if (size < 3) return fail(fmt::format("face with {} corners; needs at least 3", size));
    if (!part_open_) open_part();
    faces_.sizes.push_back(size);
    faces_.lines.push_back(
        static_cast<std::uint32_t>(std::min<std::uint64_t>(scanner_.line(), no_index)));
    return true;
  }

  // Sets entry size-1; earlier faces that named none get `no_index`.
  static void append(std::vector<std::uint32_t>& table, std::size_t size, std::uint32_t index) {
    if (table.size() + 1 < size) table.resize(size - 1, no_index);
    table.push_back(index);
  }

  void pad(std::vector<std::uint32_t>& table) const {
    if (!table.empty()) table.resize(faces_.corner_positions.size(), no_index);
  }

  void open_part() {
    faces_.parts.push_back({static_cast<std::uint32_t>(faces_.sizes.size()), group_, material_});
    part_open_ = true;
  }

  bool check_forward(const IndexSpace& space, std::size_t count) {
    if (space.farthest <= count) return true;
    problem_ = {space.farthest_line, fmt::format("face index {} is beyond the {} {} of the file",
                                                 space.farthest, count, space.noun)};
    return false;
  }

  const MeshLimits& limits_;
  LineScanner scanner_;
  MeshData mesh_;
  FaceList faces_;
  IndexSpace vertices_{"vertices"};
  IndexSpace uvs_{"texture coordinates"};
  IndexSpace normals_{"normals"};
  NameTable group_table_;
  NameTable material_table_;
  std::uint32_t group_ = no_index;
  std::uint32_t material_ = no_index;
  bool part_open_ = false;
  AssetProblem problem_;
};

}  // namespace

Result<MeshData, AssetProblem> read_obj(std::string_view bytes, const MeshLimits& limits) {
  if (bytes.empty()) return Failure{AssetProblem{0, "file is empty"}};
  if (bytes.size() > limits.file_bytes) {
    return Failure{AssetProblem{
        0,
        fmt::format("file has {} bytes; at most {} are allowed", bytes.size(), limits.file_bytes),
        limit_option::mesh_bytes}};
  }
  return ObjReader(bytes, limits).run();
}

}  // namespace scenec::backend
