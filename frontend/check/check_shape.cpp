#include "frontend/check/check_shape.hpp"

#include <fmt/format.h>

#include <cmath>

#include "base/text.hpp"
#include "frontend/check/place_of.hpp"
#include "frontend/check/profile.hpp"

namespace scenec::frontend {

namespace {

struct Vector {
  double x, y, z;
};
double dot(const Vector& a, const Vector& b) {
  return a.x * b.x + a.y * b.y + a.z * b.z;
}
Vector cross(const Vector& a, const Vector& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
// Scaled to a largest component of one, so that products stay in range; zero stays zero.
Vector normalised(const Vector& v) {
  const double largest = std::fmax(std::fabs(v.x), std::fmax(std::fabs(v.y), std::fabs(v.z)));
  return largest > 0 ? Vector{v.x / largest, v.y / largest, v.z / largest} : v;
}
bool is_zero(const Vector& v) {
  return v.x == 0 && v.y == 0 && v.z == 0;
}

// The sine of the angle between them is below what rounding leaves of a sideways direction.
bool parallel(const Vector& a, const Vector& b) {
  constexpr double smallest_sine = 0x1p-40;
  const Vector u = normalised(a), v = normalised(b), w = cross(u, v);
  return dot(w, w) <= smallest_sine * smallest_sine * dot(u, u) * dot(v, v);
}

}  // namespace

void check_shape(Session& session, const ir::Box& box, const BlockChecker& checker, Span head) {
  constexpr std::array<std::string_view, 3> axes{"x", "y", "z"};
  const std::array<double, 3> low{box.min.x, box.min.y, box.min.z},
      high{box.max.x, box.max.y, box.max.z};
  for (std::size_t i = 0; i < 3; ++i) {
    if (low[i] <= high[i]) continue;
    session.error(DiagnosticKind::inverted_box, place_of<ir::Box>(checker, &ir::Box::max, head),
                  fmt::format("the {0} of `{3}` is {1} m; needs at least that of `{4}`, {2} m",
                              axes[i], short_number_text(high[i]), short_number_text(low[i]),
                              key_name<ir::Box>(&ir::Box::max), key_name<ir::Box>(&ir::Box::min)));
    return;
  }
}

// The sine of the angle at a corner below which a face has no area to speak of.
bool is_flat(const ir::Point3& a, const ir::Point3& b, const ir::Point3& c) {
  const Vector u{b.x - a.x, b.y - a.y, b.z - a.z}, v{c.x - a.x, c.y - a.y, c.z - a.z};
  return is_zero(u) || is_zero(v) || parallel(u, v);
}

void lint_flat(Session& session, std::string_view kind, Span place, std::string_view why) {
  session.lint(Diagnostic(DiagnosticKind::degenerate_faces, place,
                          fmt::format("the {} has no area: {}", kind, why))
                   .hint("nothing of it can be seen; leave it out or move a corner"));
}

void check_shape(Session& session, const ir::Triangle& triangle, const BlockChecker& checker,
                 Span head) {
  const auto& v = triangle.vertices;
  if (v[0] != v[1] && v[1] != v[2] && v[2] != v[0] && !is_flat(v[0], v[1], v[2])) return;
  lint_flat(session, "triangle", place_of<ir::Triangle>(checker, &ir::Triangle::vertices, head),
            "its corners lie on one line");
}

void check_shape(Session& session, const ir::Quad& quad, const BlockChecker& checker, Span head) {
  if (!is_flat({0, 0, 0}, quad.edge_u, quad.edge_v)) return;
  lint_flat(session, "quad", place_of<ir::Quad>(checker, &ir::Quad::edge_v, head),
            "its edges are parallel or zero");
}

void check_shape(Session& session, const ir::Revolve& revolve, const BlockChecker& checker,
                 Span head) {
  const double radius = smallest_radius(revolve.profile);
  if (!(radius < 0)) return;
  session.lint(
      Diagnostic(DiagnosticKind::negative_radius,
                 place_of<ir::Revolve>(checker, &ir::Revolve::profile, head),
                 fmt::format("the profile reaches a radius of {} m", short_number_text(radius)))
          .hint("move its points to radii of at least 0 m"));
}

void check_shape(Session& session, const ir::Cylinder& cylinder, const BlockChecker& checker,
                 Span head) {
  if (cylinder.base != cylinder.top) return;
  session.error(DiagnosticKind::zero_extent,
                place_of<ir::Cylinder>(checker, &ir::Cylinder::top, head),
                fmt::format("the cylinder has no height: `{}` and `{}` are one point",
                            key_name<ir::Cylinder>(&ir::Cylinder::base),
                            key_name<ir::Cylinder>(&ir::Cylinder::top)));
}

void check_shape(Session& session, const ir::Mesh& mesh, const BlockChecker& checker, Span head) {
  const std::size_t vertices = mesh.vertices.size();
  const auto wrong = [&](Span span, std::string text) {
    session.error(DiagnosticKind::mesh_lists, span, std::move(text));
  };
  const bool from_file = mesh.file.valid();
  const std::size_t normals = mesh.normals.list.size(), uvs = mesh.uvs.size();
  if (normals > 0 && (from_file || normals != vertices)) {
    wrong(place_of<ir::Mesh>(checker, &ir::Mesh::normals, head),
          from_file ? std::string("a mesh from a file takes its normals from there")
                    : fmt::format("there are {} normals for {} vertices", normals, vertices));
  }
  if (uvs > 0 && (from_file || uvs != vertices)) {
    wrong(place_of<ir::Mesh>(checker, &ir::Mesh::uvs, head),
          from_file
              ? std::string("a mesh from a file takes its texture coordinates from there")
              : fmt::format("there are {} texture coordinates for {} vertices", uvs, vertices));
  }
  if (mesh.part && !from_file)
    wrong(place_of<ir::Mesh>(checker, &ir::Mesh::part, head),
          "an inline mesh has no parts; list the faces that are wanted");
  const Span faces = place_of<ir::Mesh>(checker, &ir::Mesh::faces, head);
  if (!from_file && mesh.faces.empty()) wrong(faces, "the mesh has no faces");
  for (std::size_t i = 0; i < mesh.faces.size(); ++i) {
    if (mesh.faces[i].size() < 3)
      return wrong(
          faces, fmt::format("face {} has {} vertices; needs at least 3", i, mesh.faces[i].size()));
    for (std::uint32_t index : mesh.faces[i]) {
      if (index >= vertices)
        return wrong(faces, fmt::format("face {} names vertex {}; there are {}, numbered from 0", i,
                                        index, vertices));
    }
  }
}

void check_light(Session& session, const ir::SpotLight& light, const BlockChecker& checker,
                 Span head) {
  if (light.falloff.value <= light.angle.value / 2) return;
  session.error(DiagnosticKind::wide_falloff,
                place_of<ir::SpotLight>(checker, &ir::SpotLight::falloff, head),
                fmt::format("`{}` is {}; needs at most half of `{}`, {}",
                            key_name<ir::SpotLight>(&ir::SpotLight::falloff),
                            quantity_text(light.falloff.value, dimension::angle),
                            key_name<ir::SpotLight>(&ir::SpotLight::angle),
                            quantity_text(light.angle.value / 2, dimension::angle)));
}

void check_light(Session& session, const ir::QuadLight& light, const BlockChecker& checker,
                 Span head) {
  const Vector u{light.edge_u.x, light.edge_u.y, light.edge_u.z},
      v{light.edge_v.x, light.edge_v.y, light.edge_v.z};
  if (!is_zero(cross(normalised(u), normalised(v)))) return;
  session.error(DiagnosticKind::zero_extent,
                place_of<ir::QuadLight>(checker, &ir::QuadLight::edge_v, head),
                "the light has no area: its edges are parallel or zero");
}

void check_camera_frame(Session& session, const ir::CameraFrame& frame, Span head) {
  Vector view{};
  if (frame.aim)
    view = {frame.aim->x - frame.eye.x, frame.aim->y - frame.eye.y, frame.aim->z - frame.eye.z};
  if (frame.direction) view = {frame.direction->x, frame.direction->y, frame.direction->z};
  if (is_zero(view)) {
    session.error(DiagnosticKind::camera_frame, head,
                  "the camera looks at the point where it stands");
  } else if (parallel(view, {frame.up.x, frame.up.y, frame.up.z})) {
    session.error(
        Diagnostic(DiagnosticKind::camera_frame, head, "the camera looks along its `up` direction")
            .hint("give another `up`, such as `[0, 0, -1]`"));
  }
}

void check_camera(Session& session, const ir::ThinLens& camera, const BlockChecker& checker,
                  Span head) {
  check_camera_frame(session, camera, head);
  if (!camera.focus.at_aim || camera.aim) return;
  session.error(
      DiagnosticKind::camera_frame, place_of<ir::ThinLens>(checker, &ir::ThinLens::focus, head),
      "`.aim` is the distance to the point looked at, but the camera has only a direction");
}

void check_render(Session& session, const ir::RenderSettings& render, const BlockChecker& checker) {
  if (!render.region) return;
  const ir::Region& r = *render.region;
  const bool inside = r.x1 <= render.size.width && r.y1 <= render.size.height;
  if (r.x0 < r.x1 && r.y0 < r.y1 && inside) return;
  session.error(DiagnosticKind::empty_region,
                place_of<ir::RenderSettings>(checker, &ir::RenderSettings::region, {}),
                inside ? std::string("the region holds no pixels; needs x0 < x1 and y0 < y1")
                       : fmt::format("the region leaves the picture of {} x {} pixels",
                                     render.size.width, render.size.height));
}

}  // namespace scenec::frontend
