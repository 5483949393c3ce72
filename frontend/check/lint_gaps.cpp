// Pairs of surfaces that lie in one place, or so close that rounding decides which is in front:
// flat faces that are parallel and overlap, and spheres about one centre.
//
// Domain:     planes, quads, triangles, disks, boxes, caps of cylinders, spheres; not curved
//             surfaces of other kinds, meshes or instances.
// Method:     flat faces sorted by direction and offset, then swept along an axis inside each
// plane;
//             overlap by separating axes. Spheres by a hash of their centre.
// Degenerate: faces without area and transforms beyond the range give no finding.
// Proof:      tests/unit/frontend/lints_test.cpp.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <span>
#include <unordered_map>

#include "base/text.hpp"
#include "frontend/check/flat_faces.hpp"
#include "frontend/check/lint_scene.hpp"

namespace scenec::frontend {

namespace {

using flat::cross;
using flat::dot;
using flat::Face;
using flat::operator-;

// Do they overlap by more than `margin` along every direction of the plane that could separate
// them? Edges that only touch do not.
bool overlap(const Face& a, const Face& b, double margin) {
  if (a.corner_count == 0 || b.corner_count == 0) return true;
  const auto separated_by_edge_of = [&](const Face& face) {
    for (std::size_t i = 0; i < face.corner_count; ++i) {
      const flat::Vector edge = face.corners[(i + 1) % face.corner_count] - face.corners[i];
      const flat::Vector across = cross(edge, face.normal);
      const double length = std::sqrt(dot(across, across));
      if (!(length > 0)) continue;
      const auto span_of = [&](const Face& f) {
        std::array<double, 2> span{dot(across, f.corners[0]), dot(across, f.corners[0])};
        for (std::size_t k = 1; k < f.corner_count; ++k) {
          span[0] = std::min(span[0], dot(across, f.corners[k]));
          span[1] = std::max(span[1], dot(across, f.corners[k]));
        }
        return span;
      };
      const auto sa = span_of(a), sb = span_of(b);
      if (std::min(sa[1], sb[1]) - std::max(sa[0], sb[0]) <= margin * length) return true;
    }
    return false;
  };
  return !separated_by_edge_of(a) && !separated_by_edge_of(b);
}

class GapLinter {
 public:
  GapLinter(Session& session, const std::vector<ir::Item>& items, const Transparency& transparency)
      : session_(session), items_(items), transparency_(transparency) {}

  void flat(std::vector<Face>& faces);
  void round();

 private:
  // One plane: faces of nearly equal direction and offset.
  void plane(std::span<Face> faces);
  void pair(const Face& a, const Face& b);
  void report(std::uint32_t a, std::uint32_t b, double gap, double spacing, double distance);
  [[nodiscard]] bool interesting(std::uint32_t a, std::uint32_t b) const {
    const ir::MaterialId ma = items_[a].material, mb = items_[b].material;
    return ma != mb || transparency_.refracts(ma);
  }

  Session& session_;
  const std::vector<ir::Item>& items_;
  const Transparency& transparency_;
  std::size_t comparisons_ = 0;
};

void GapLinter::report(std::uint32_t a, std::uint32_t b, double gap, double spacing,
                       double distance) {
  const std::uint32_t first = std::min(a, b), second = std::max(a, b);
  const bool refracts =
      transparency_.refracts(items_[a].material) || transparency_.refracts(items_[b].material);
  // What double precision makes of equal numbers that were computed in two ways.
  const bool one_place = gap <= distance * 0x1p-48;
  const std::string place = one_place
                                ? fmt::format("in one place ({} m apart)", short_number_text(gap))
                                : fmt::format("{} m apart", short_number_text(gap));
  Diagnostic diagnostic(
      one_place && refracts ? DiagnosticKind::coincident_dielectrics : DiagnosticKind::thin_gap, {},
      fmt::format("two surfaces lie {}; single precision steps by {} m at {} m from the origin",
                  place, short_number_text(spacing), short_number_text(distance)));
  diagnostic.notes.push_back(
      {"the other surface is of this item", session_.head_of(items_[first].origin)});
  const std::string step = short_number_text(spacing);
  diagnostic.hints.push_back(
      one_place && refracts
          ? fmt::format("leave a gap of more than {} m, or let the two overlap by as much", step)
          : fmt::format("move them apart by more than {} m, or leave one of them out", step));
  session_.lint_item(std::move(diagnostic), items_[second].origin);
}

void GapLinter::pair(const Face& a, const Face& b) {
  if (a.item == b.item || !interesting(a.item, b.item)) return;
  const bool refracts = transparency_.refracts(items_[a.item].material) ||
                        transparency_.refracts(items_[b.item].material);
  // An opaque thing that stands on another hides both surfaces.
  if (!refracts && a.facing != b.facing) return;
  const double distance = std::max(std::fabs(a.offset), std::min(a.reach, b.reach));
  const double spacing = float_spacing(distance);
  const double gap = std::fabs(a.offset - b.offset);
  if (gap < spacing && overlap(a, b, spacing)) report(a.item, b.item, gap, spacing, distance);
}

void GapLinter::plane(std::span<Face> faces) {
  if (faces.size() < 2) return;
  std::size_t axis = 0;
  double widest = -1;
  for (std::size_t k = 0; k < 3; ++k) {
    double low = std::numeric_limits<double>::infinity(), high = -low;
    for (const Face& face : faces) {
      for (std::size_t i = 0; i < face.corner_count; ++i) {
        low = std::min(low, face.corners[i][k]);
        high = std::max(high, face.corners[i][k]);
      }
    }
    if (high - low > widest) widest = high - low, axis = k;
  }
  for (Face& face : faces) {
    face.low = -std::numeric_limits<double>::infinity();
    face.high = -face.low;
    if (face.corner_count == 0) continue;
    face.low = face.high = face.corners[0][axis];
    for (std::size_t i = 1; i < face.corner_count; ++i) {
      face.low = std::min(face.low, face.corners[i][axis]);
      face.high = std::max(face.high, face.corners[i][axis]);
    }
  }
  std::sort(faces.begin(), faces.end(), [](const Face& a, const Face& b) {
    return a.low != b.low ? a.low < b.low : a.item < b.item;
  });
  for (std::size_t i = 0; i < faces.size(); ++i) {
    for (std::size_t k = i + 1; k < faces.size() && faces[k].low < faces[i].high; ++k) {
      if (comparisons_-- == 0) return void(comparisons_ = 0);
      pair(faces[i], faces[k]);
    }
  }
}

void GapLinter::flat(std::vector<Face>& faces) {
  constexpr std::size_t comparisons_a_face = 16;
  comparisons_ = 10'000 + comparisons_a_face * faces.size();
  // Directions nearer than this count as parallel; the odd part keeps usual numbers off the edges.
  const auto bucket = [](double component) {
    return static_cast<std::int64_t>(std::floor(component * 0x1p20 + 0.37));
  };
  const auto direction = [&](const Face& face) {
    return std::array{bucket(face.normal[0]), bucket(face.normal[1]), bucket(face.normal[2])};
  };
  std::sort(faces.begin(), faces.end(), [&](const Face& a, const Face& b) {
    const auto da = direction(a), db = direction(b);
    if (da != db) return da < db;
    return a.offset != b.offset ? a.offset < b.offset : a.item < b.item;
  });
  for (std::size_t begin = 0; begin < faces.size();) {
    std::size_t end = begin + 1;
    while (end < faces.size() && direction(faces[end]) == direction(faces[begin]) &&
           faces[end].offset - faces[end - 1].offset <
               float_spacing(std::max(faces[end].reach, faces[end - 1].reach))) {
      ++end;
    }
    plane(std::span(faces).subspan(begin, end - begin));
    begin = end;
  }
}

// Spheres about one centre whose radii differ by less than the spacing.
void GapLinter::round() {
  const ir::Scene& scene = session_.builder.scene();
  const auto sphere_of = [&](const ir::Item& item) -> const ir::Sphere* {
    const auto* id = std::get_if<Id<ir::Sphere>>(&item.shape);
    if (id == nullptr || !scene.transforms[item.transform].is_identity()) return nullptr;
    return &scene.shape(*id);
  };
  const auto key_of = [](const ir::Sphere& sphere) {
    std::uint64_t key = 0;
    for (double c : {sphere.center.x, sphere.center.y, sphere.center.z}) {
      // Cells of a millionth of the radius; centres on either side of an edge are not found.
      const double cell = std::floor(c / sphere.radius.value * 0x1p20 + 0.37);
      key = (key ^ static_cast<std::uint64_t>(
                       static_cast<std::int64_t>(std::clamp(cell, -0x1p60, 0x1p60)))) *
            0x9e3779b97f4a7c15ULL;
      key ^= key >> 29;
    }
    return key;
  };
  // First a table of bits, small enough for the cache: most spheres have a centre of their own.
  std::size_t count = 0;
  for (const ir::Item& item : items_) count += sphere_of(item) != nullptr ? 1u : 0u;
  if (count < 2) return;
  std::size_t bits = 1024;
  while (bits < 8 * count) bits *= 2;
  std::vector<std::uint64_t> seen(bits / 64), twice(bits / 64);
  const auto each = [&](auto&& body) {
    for (std::uint32_t i = 0; i < items_.size(); ++i) {
      if (const ir::Sphere* sphere = sphere_of(items_[i])) body(i, *sphere, key_of(*sphere));
    }
  };
  bool any = false;
  each([&](std::uint32_t, const ir::Sphere&, std::uint64_t key) {
    const std::size_t bit = key & (bits - 1);
    const std::uint64_t mask = std::uint64_t{1} << (bit % 64);
    if ((seen[bit / 64] & mask) != 0) twice[bit / 64] |= mask, any = true;
    seen[bit / 64] |= mask;
  });
  if (!any) return;
  std::unordered_map<std::uint64_t, std::uint32_t> first;
  each([&](std::uint32_t i, const ir::Sphere& sphere, std::uint64_t key) {
    const std::size_t bit = key & (bits - 1);
    if ((twice[bit / 64] >> (bit % 64) & 1) == 0) return;
    const auto [place, added] = first.try_emplace(key, i);
    if (added || !interesting(place->second, i)) return;
    const ir::Sphere& other = *sphere_of(items_[place->second]);
    const ir::Point3 &c = sphere.center, &d = other.center;
    const double apart = std::sqrt((c.x - d.x) * (c.x - d.x) + (c.y - d.y) * (c.y - d.y) +
                                   (c.z - d.z) * (c.z - d.z));
    const double gap = apart + std::fabs(sphere.radius.value - other.radius.value);
    const double distance =
        std::max({std::fabs(c.x), std::fabs(c.y), std::fabs(c.z)}) + sphere.radius.value;
    const double spacing = float_spacing(distance);
    if (gap < spacing) report(place->second, i, gap, spacing, distance);
  });
}

}  // namespace

void lint_gaps(Session& session, const std::vector<ir::Item>& items,
               const Transparency& transparency) {
  std::vector<Face> faces;
  flat::append_faces(session.builder.scene(), items, faces);
  GapLinter linter(session, items, transparency);
  linter.flat(faces);
  linter.round();
}

}  // namespace scenec::frontend
