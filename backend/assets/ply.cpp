#include "backend/assets/ply.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <optional>
#include <string>
#include <utility>

#include "backend/assets/ply_body.hpp"
#include "backend/assets/ply_header.hpp"
#include "backend/assets/triangulate.hpp"
#include "base/huge_pages.hpp"
#include "base/text.hpp"
#include "base/text_scan.hpp"

namespace scenec::backend {
namespace {

constexpr std::size_t shown_text = 40;
constexpr std::uint64_t most_vertices = 0xFFFF'FFFE;

// What a vertex property is for; texture coordinates go by several names.
enum class Role : std::uint8_t { none, x, y, z, nx, ny, nz, u, v };
constexpr std::size_t role_count = 9;

Role role_of(std::string_view name) {
  struct Row {
    std::string_view name;
    Role role;
  };
  constexpr Row rows[] = {{"x", Role::x},         {"y", Role::y},         {"z", Role::z},
                          {"nx", Role::nx},       {"ny", Role::ny},       {"nz", Role::nz},
                          {"u", Role::u},         {"v", Role::v},         {"s", Role::u},
                          {"t", Role::v},         {"texture_u", Role::u}, {"texture_v", Role::v},
                          {"texture_s", Role::u}, {"texture_t", Role::v}};
  for (const Row& row : rows) {
    if (row.name == name) return row.role;
  }
  return Role::none;
}

// Where the values of a vertex lie in its row, when all rows have one size.
struct VertexLayout {
  std::array<std::size_t, role_count> offsets{};
  std::array<bool, role_count> seen{};
  std::size_t row_size = 0;
  bool has_list = false;
  bool only_floats = true;  // of the roles

  void add(Role role, const PlyProperty& property) {
    const auto index = static_cast<std::size_t>(role);
    seen[index] = true;
    offsets[index] = row_size;
    has_list = has_list || property.is_list;
    if (role != Role::none) only_floats = only_floats && property.type == PlyType::float32;
    row_size += size_of(property.type);
  }
  [[nodiscard]] bool has(Role role) const { return seen[static_cast<std::size_t>(role)]; }
  [[nodiscard]] std::size_t offset(Role role) const {
    return offsets[static_cast<std::size_t>(role)];
  }
  [[nodiscard]] bool is_packed_floats() const { return !has_list && only_floats; }
};

template <class Body>
class PlyReader {
 public:
  PlyReader(const PlyHeader& header, Body body, const MeshLimits& limits)
      : header_(header), body_(std::move(body)), limits_(limits) {}

  Result<MeshData, AssetProblem> run() {
    for (const PlyElement& element : header_.elements) {
      if (!read(element)) return Failure{std::move(problem_)};
    }
    if (body_.rest() != 0) {
      return Failure{AssetProblem{
          0,
          fmt::format("{} bytes follow the last element; counts and body disagree", body_.rest())}};
    }
    if (farthest_ >= mesh_.positions.size()) {
      return Failure{
          AssetProblem{farthest_line_, fmt::format("face index {} is beyond the {} vertices",
                                                   farthest_, mesh_.positions.size())}};
    }
    if (auto problem = triangulate(std::move(faces_), limits_, mesh_))
      return Failure{std::move(*problem)};
    return std::move(mesh_);
  }

 private:
  bool fail(const PlyElement& element, std::uint64_t row, std::string_view what,
            std::string_view limit_option = {}) {
    problem_ = {body_.line(),
                fmt::format("{} {}: {}", printable(element.name, shown_text), row, what),
                limit_option};
    return false;
  }

  bool fail(const PlyElement& element, std::uint64_t row, RowProblem problem) {
    switch (problem) {
      case RowProblem::truncated:
        return fail(element, row, "values are missing; the file or the row ends too early");
      case RowProblem::unparsable:
        return fail(element, row, "value is not a number");
      case RowProblem::not_whole:
        return fail(element, row, "value is not a whole number");
      case RowProblem::list_too_long:
        return fail(element, row, "list is longer than what follows");
      case RowProblem::extra:
        return fail(element, row, "more values than properties");
      case RowProblem::none:
        break;
    }
    return true;
  }

  bool read(const PlyElement& element) {
    if (element.name == "vertex") return read_vertices(element);
    if (element.name == "face") return read_faces(element);
    for (std::uint64_t row = 0; row < element.count; ++row) {
      RowProblem problem = body_.begin_row();
      for (const PlyProperty& property : element.properties) {
        if (problem == RowProblem::none) problem = skip(property);
      }
      if (problem == RowProblem::none) problem = body_.end_row();
      if (problem != RowProblem::none) return fail(element, row, problem);
    }
    return true;
  }

  RowProblem list_count(const PlyProperty& property, double& count) {
    const RowProblem problem = body_.value(property.count_type, count);
    if (problem != RowProblem::none) return problem;
    return count >= 0 && body_.can_hold(count, property.type) ? RowProblem::none
                                                              : RowProblem::list_too_long;
  }

  RowProblem skip(const PlyProperty& property) {
    double value = 0;
    if (!property.is_list) return body_.value(property.type, value);
    const RowProblem problem = list_count(property, value);
    return problem == RowProblem::none ? body_.skip(value, property.type) : problem;
  }

  bool read_vertices(const PlyElement& element) {
    if (element.count > most_vertices) return fail(element, 0, "too many vertices");
    std::vector<Role> roles;
    VertexLayout layout;
    for (const PlyProperty& property : element.properties) {
      Role role = property.is_list ? Role::none : role_of(property.name);
      if (layout.has(role)) role = Role::none;
      layout.add(role, property);
      roles.push_back(role);
    }
    const auto has = [&](Role role) { return layout.has(role); };
    if (!has(Role::x) || !has(Role::y) || !has(Role::z)) {
      problem_ = {element.line, "element `vertex` needs the properties `x`, `y` and `z`"};
      return false;
    }
    const bool has_normals = has(Role::nx) && has(Role::ny) && has(Role::nz);
    const bool has_uvs = has(Role::u) && has(Role::v);
    reserve_large(mesh_.positions, element.count);
    if (has_normals) mesh_.normals.reserve(element.count);
    if (has_uvs) mesh_.uvs.reserve(element.count);
    if constexpr (Body::is_binary) {
      if (layout.is_packed_floats() && !has_normals && !has_uvs)
        return read_packed_positions(element, layout);
    }
    for (std::uint64_t row = 0; row < element.count; ++row) {
      if (!read_vertex(element, roles, row)) return false;
      if (!keep_vertex(element, row, has_normals, has_uvs)) return false;
    }
    return true;
  }

  // Rows of one size with the position in single precision: most files.
  bool read_packed_positions(const PlyElement& element, const VertexLayout& layout) {
    const std::string_view rows = body_.take_rows(element.count, layout.row_size);
    if (rows.empty()) return fail(element, 0, RowProblem::truncated);
    const char* row = rows.data();
    mesh_.positions.resize(element.count);
    bool finite = true;
    for (Point3& p : mesh_.positions) {
      p.x = static_cast<double>(Body::template load<float>(row + layout.offset(Role::x)));
      p.y = static_cast<double>(Body::template load<float>(row + layout.offset(Role::y)));
      p.z = static_cast<double>(Body::template load<float>(row + layout.offset(Role::z)));
      // The sum of the magnitudes is finite when each is: they are floats.
      finite = finite && std::isfinite(std::fabs(p.x) + std::fabs(p.y) + std::fabs(p.z));
      row += layout.row_size;
    }
    if (finite) return true;
    const auto bad = std::ranges::find_if_not(mesh_.positions, [](const Point3& p) {
      return std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z);
    });
    return fail(element, static_cast<std::uint64_t>(bad - mesh_.positions.begin()),
                "coordinate is not finite");
  }

  bool read_vertex(const PlyElement& element, const std::vector<Role>& roles, std::uint64_t row) {
    RowProblem problem = body_.begin_row();
    for (std::size_t i = 0; i < roles.size() && problem == RowProblem::none; ++i) {
      const PlyProperty& property = element.properties[i];
      problem = property.is_list
                    ? skip(property)
                    : body_.value(property.type, values_[static_cast<std::size_t>(roles[i])]);
    }
    if (problem == RowProblem::none) problem = body_.end_row();
    return problem == RowProblem::none || fail(element, row, problem);
  }

  bool keep_vertex(const PlyElement& element, std::uint64_t row, bool has_normals, bool has_uvs) {
    const auto value = [&](Role role) { return values_[static_cast<std::size_t>(role)]; };
    const auto narrow = [&](Role role) { return static_cast<float>(value(role)); };
    const Point3 p{value(Role::x), value(Role::y), value(Role::z)};
    bool finite = std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z);
    mesh_.positions.push_back(p);
    if (has_normals) {
      const std::array<float, 3> n{narrow(Role::nx), narrow(Role::ny), narrow(Role::nz)};
      finite = finite && std::isfinite(n[0]) && std::isfinite(n[1]) && std::isfinite(n[2]);
      mesh_.normals.push_back(n);
    }
    if (has_uvs) {
      const std::array<float, 2> t{narrow(Role::u), narrow(Role::v)};
      finite = finite && std::isfinite(t[0]) && std::isfinite(t[1]);
      mesh_.uvs.push_back(t);
    }
    return finite || fail(element, row, "coordinate is not finite");
  }

  bool read_faces(const PlyElement& element) {
    std::size_t indices = element.properties.size();
    for (std::size_t i = 0; i < element.properties.size(); ++i) {
      const PlyProperty& property = element.properties[i];
      const bool named = property.name == "vertex_indices" || property.name == "vertex_index";
      if (named && property.is_list && !is_real(property.type)) indices = i;
    }
    if (indices == element.properties.size()) {
      problem_ = {element.line, "element `face` needs a list of whole numbers `vertex_indices`"};
      return false;
    }
    if (element.count >= no_index) return fail(element, 0, "too many faces");
    std::uint64_t row = 0;
    if constexpr (Body::is_binary) {
      const PlyProperty& list = element.properties[indices];
      const bool usual = list.count_type == PlyType::uint8 &&
                         (list.type == PlyType::int32 || list.type == PlyType::uint32);
      if (element.properties.size() == 1 && usual) row = read_packed_triangles(element, list.type);
    }
    for (; row < element.count; ++row) {
      RowProblem problem = body_.begin_row();
      for (std::size_t i = 0; i < element.properties.size() && problem == RowProblem::none; ++i) {
        if (i != indices) {
          problem = skip(element.properties[i]);
        } else if (!read_face(element, element.properties[i], row)) {
          return false;
        }
      }
      if (problem == RowProblem::none) problem = body_.end_row();
      if (problem != RowProblem::none) return fail(element, row, problem);
    }
    return true;
  }

  // Rows of a count byte and three 32-bit indices, up to the first that is not one or names what
  // cannot be an index; that row and the rest are read, or refused, one value at a time. Returns
  // how many rows were read.
  std::uint64_t read_packed_triangles(const PlyElement& element, PlyType type) {
    constexpr std::size_t row_size = 1 + 3 * sizeof(std::uint32_t);
    const std::string_view bytes = body_.bytes();
    const std::uint64_t most = std::min<std::uint64_t>(element.count, bytes.size() / row_size);
    const std::uint64_t largest = type == PlyType::int32 ? 0x7FFF'FFFF : most_vertices;
    resize_large(faces_.triangles, most);
    std::uint64_t farthest = 0;
    std::uint64_t count = 0;
    for (const char* row = bytes.data(); count < most && *row == 3; row += row_size) {
      TriangleIndices& t = faces_.triangles[count];
      for (std::size_t i = 0; i < 3; ++i)
        t[i] = Body::template load<std::uint32_t>(row + 1 + i * sizeof(std::uint32_t));
      const std::uint64_t farthest_here = std::max({t[0], t[1], t[2]});
      if (farthest_here > largest) break;
      farthest = std::max(farthest, farthest_here);
      ++count;
    }
    faces_.triangles.resize(count);
    farthest_ = std::max(farthest_, farthest);
    body_.advance(count * row_size);
    return count;
  }

  bool read_face(const PlyElement& element, const PlyProperty& property, std::uint64_t row) {
    double count = 0;
    RowProblem problem = list_count(property, count);
    if (problem != RowProblem::none) return fail(element, row, problem);
    if (count < 3) return fail(element, row, fmt::format("{} corners; needs at least 3", count));
    if (count > limits_.polygon_vertices) {
      return fail(
          element, row,
          fmt::format("{} corners; at most {} are allowed", count, limits_.polygon_vertices),
          limit_option::polygon_corners);
    }
    const auto size = static_cast<std::uint32_t>(count);
    for (std::uint32_t i = 0; i < size; ++i) {
      double index = 0;
      problem = body_.value(property.type, index);
      if (problem != RowProblem::none) return fail(element, row, problem);
      if (!(index >= 0 && index <= static_cast<double>(most_vertices))) {
        return fail(element, row, fmt::format("corner {} has the index {}", i + 1, index));
      }
      const auto whole = static_cast<std::uint32_t>(index);
      if (whole > farthest_) {
        farthest_ = whole;
        farthest_line_ = body_.line();
      }
      faces_.corner_positions.push_back(whole);
    }
    faces_.sizes.push_back(size);
    if (header_.format == PlyFormat::ascii) {
      faces_.lines.push_back(
          static_cast<std::uint32_t>(std::min<std::uint64_t>(body_.line(), no_index)));
    }
    return true;
  }

  const PlyHeader& header_;
  Body body_;
  const MeshLimits& limits_;
  MeshData mesh_;
  FaceList faces_;
  std::array<double, role_count> values_{};
  std::uint64_t farthest_ = 0;
  std::uint64_t farthest_line_ = 0;
  AssetProblem problem_;
};

std::optional<AssetProblem> find_missing_element(const PlyHeader& header) {
  for (const std::string_view name : {"vertex", "face"}) {
    const auto found = std::ranges::find(header.elements, name, &PlyElement::name);
    if (found == header.elements.end()) {
      return AssetProblem{0, fmt::format("no element `{}`", name)};
    }
    if (found->count == 0) {
      return AssetProblem{found->line, fmt::format("element `{}` has no rows", name)};
    }
  }
  return std::nullopt;
}

}  // namespace

Result<MeshData, AssetProblem> read_ply(std::string_view bytes, const MeshLimits& limits) {
  if (bytes.empty()) return Failure{AssetProblem{0, "file is empty"}};
  if (bytes.size() > limits.file_bytes) {
    return Failure{AssetProblem{
        0,
        fmt::format("file has {} bytes; at most {} are allowed", bytes.size(), limits.file_bytes),
        limit_option::mesh_bytes}};
  }
  const Result<PlyHeader, AssetProblem> header = read_ply_header(bytes, limits);
  if (!header) return Failure{header.error()};
  if (auto problem = find_missing_element(header.value())) return Failure{std::move(*problem)};
  const std::string_view body = bytes.substr(header.value().body_offset);
  if (header.value().format == PlyFormat::ascii) {
    return PlyReader(header.value(), AsciiBody(body, header.value().body_line, limits), limits)
        .run();
  }
  const bool little = header.value().format == PlyFormat::binary_little_endian;
  if (little == (std::endian::native == std::endian::little))
    return PlyReader(header.value(), BinaryBody<false>(body), limits).run();
  return PlyReader(header.value(), BinaryBody<true>(body), limits).run();
}

}  // namespace scenec::backend
