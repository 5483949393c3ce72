#include "frontend/check/lint_scene.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>

#include "base/text.hpp"

namespace scenec::frontend {

namespace {

using Vector = std::array<double, 3>;

struct Extent {
  Vector low, high;

  [[nodiscard]] bool contains(const Vector& p) const {
    for (std::size_t i = 0; i < 3; ++i) {
      if (!(low[i] <= p[i] && p[i] <= high[i])) return false;
    }
    return true;
  }
};

Vector vector_of(const ir::Point3& p) {
  return {p.x, p.y, p.z};
}

// Closed shapes whose inside is known without looking at a file, in their own space.
std::optional<Extent> closed_extent(const ir::Sphere& s) {
  const double r = s.radius.value;
  return Extent{{s.center.x - r, s.center.y - r, s.center.z - r},
                {s.center.x + r, s.center.y + r, s.center.z + r}};
}
std::optional<Extent> closed_extent(const ir::Box& box) {
  return Extent{vector_of(box.min), vector_of(box.max)};
}
std::optional<Extent> closed_extent(const ir::Cylinder& c) {
  if (!c.capped) return std::nullopt;
  const double r = c.radius.value;
  Extent extent;
  const Vector a = vector_of(c.base), b = vector_of(c.top);
  for (std::size_t i = 0; i < 3; ++i) {
    extent.low[i] = std::min(a[i], b[i]) - r;
    extent.high[i] = std::max(a[i], b[i]) + r;
  }
  return extent;
}
template <class T>
std::optional<Extent> closed_extent(const T&) {
  return std::nullopt;
}

bool encloses(const ir::Sphere& s, const Vector& p) {
  const double x = p[0] - s.center.x, y = p[1] - s.center.y, z = p[2] - s.center.z;
  return x * x + y * y + z * z < s.radius.value * s.radius.value;
}
bool encloses(const ir::Box& box, const Vector& p) {
  return box.min.x < p[0] && p[0] < box.max.x && box.min.y < p[1] && p[1] < box.max.y &&
         box.min.z < p[2] && p[2] < box.max.z;
}
bool encloses(const ir::Cylinder& c, const Vector& p) {
  const Vector base = vector_of(c.base), top = vector_of(c.top);
  double along = 0, length = 0, distance = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    along += (p[i] - base[i]) * (top[i] - base[i]);
    length += (top[i] - base[i]) * (top[i] - base[i]);
    distance += (p[i] - base[i]) * (p[i] - base[i]);
  }
  return along > 0 && along < length &&
         distance - along * along / length < c.radius.value * c.radius.value;
}
template <class T>
bool encloses(const T&, const Vector&) {
  return false;
}

// `extent` moved by the transform: the box round its moved corners.
Extent moved(const ir::Transform& transform, const Extent& extent) {
  Extent result;
  for (std::size_t row = 0; row < 3; ++row) {
    double middle = transform.m[row * 4 + 3], reach = 0;
    for (std::size_t i = 0; i < 3; ++i) {
      const double entry = transform.m[row * 4 + i];
      middle += entry * (extent.low[i] + extent.high[i]) / 2;
      reach += std::fabs(entry) * (extent.high[i] - extent.low[i]) / 2;
    }
    result.low[row] = middle - reach;
    result.high[row] = middle + reach;
  }
  return result;
}

// The point that `transform` moves to p (Cramer's rule; transforms of a scene can be inverted).
Vector taken_back(const ir::Transform& transform, const Vector& p) {
  const auto& m = transform.m;
  const Vector d{p[0] - m[3], p[1] - m[7], p[2] - m[11]};
  const double determinant = ir::determinant(transform);
  const auto with_column = [&](std::size_t column) {
    ir::Transform replaced = transform;
    for (std::size_t row = 0; row < 3; ++row) replaced.m[row * 4 + column] = d[row];
    return ir::determinant(replaced) / determinant;
  };
  return {with_column(0), with_column(1), with_column(2)};
}

// ---- objects tiny for their distance

// Steps of single precision across an object below which nothing is left of its form.
constexpr double fewest_steps = 16;

void lint_tiny(Session& session, const ir::Item& item, const Extent& extent) {
  double size = 0, distance = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    size = std::max(size, extent.high[i] - extent.low[i]);
    distance = std::max(distance, std::max(std::fabs(extent.low[i]), std::fabs(extent.high[i])));
  }
  // No spacing is wider than this, so nearly every object is done here.
  if (size >= fewest_steps * 0x1p-23 * distance || size == 0) return;
  const double steps = size / float_spacing(distance);
  if (steps >= fewest_steps) return;
  session.lint_item(
      Diagnostic(DiagnosticKind::tiny_far_object, {},
                 fmt::format("the object is {} m across and {} m from the origin, {} steps of "
                             "single precision at that distance",
                             short_number_text(size), short_number_text(distance),
                             short_number_text(steps)))
          .hint(fmt::format("make it larger than {} m, or move the scene towards the origin",
                            short_number_text(fewest_steps * float_spacing(distance)))),
      item.origin);
}

// ---- lights inside shapes

struct PlacedLight {
  Vector at;
  ir::OriginId origin;
};

std::vector<PlacedLight> lights_of(const ir::Scene& scene) {
  std::vector<PlacedLight> lights;
  for (std::uint32_t i = 0; i < scene.lights.size(); ++i) {
    const Id<ir::Light> id(i);
    const ir::LightKind& kind = scene.lights[id].kind;
    const ir::OriginId origin = scene.light_names[id].origin;
    if (const auto* point = std::get_if<ir::PointLight>(&kind))
      lights.push_back({vector_of(point->position), origin});
    if (const auto* spot = std::get_if<ir::SpotLight>(&kind))
      lights.push_back({vector_of(spot->position), origin});
    if (const auto* sphere = std::get_if<ir::SphereLight>(&kind))
      lights.push_back({vector_of(sphere->center), origin});
  }
  std::sort(lights.begin(), lights.end(),
            [](const PlacedLight& a, const PlacedLight& b) { return a.at < b.at; });
  return lights;
}

template <class T>
void lint_enclosed(Session& session, const ir::Item& item, const T& shape, const Extent& extent,
                   const std::vector<PlacedLight>& lights) {
  const ir::Scene& scene = session.builder.scene();
  const ir::Transform& transform = scene.transforms[item.transform];
  auto light =
      std::lower_bound(lights.begin(), lights.end(), extent.low[0],
                       [](const PlacedLight& candidate, double x) { return candidate.at[0] < x; });
  for (; light != lights.end() && light->at[0] <= extent.high[0]; ++light) {
    if (!extent.contains(light->at) || !encloses(shape, taken_back(transform, light->at))) continue;
    session.lint_item(
        Diagnostic(DiagnosticKind::light_inside_geometry, {},
                   fmt::format("the light at [{}, {}, {}] stands inside an opaque `{}`",
                               short_number_text(light->at[0]), short_number_text(light->at[1]),
                               short_number_text(light->at[2]), ir::Schema<T>::name))
            .note("which is placed here", session.head_of(item.origin))
            .hint("move the light, or give the shape a material that light passes"),
        light->origin);
  }
}

}  // namespace

double float_spacing(double magnitude) {
  if (!(magnitude > 0) || !std::isfinite(magnitude)) return 0;
  int exponent = 0;
  static_cast<void>(std::frexp(magnitude, &exponent));
  constexpr int digits = std::numeric_limits<float>::digits;
  return std::ldexp(1.0, std::max(exponent, std::numeric_limits<float>::min_exponent) - digits);
}

Transparency::Transparency(const ir::Scene& scene) {
  const auto is_some = [](const ir::ColorInput& color) {
    return color.texture.valid() || color.value != ir::black;
  };
  // A mix comes behind what it mixes.
  for (std::uint32_t i = 0; i < scene.materials.size(); ++i) {
    const ir::Material& material = scene.materials[ir::MaterialId(i)];
    Kind kind = Kind::opaque;
    const auto* phong = std::get_if<ir::Phong>(&material.kind);
    const auto* mix = std::get_if<ir::Mix>(&material.kind);
    if (mix != nullptr) kind = std::max(of(mix->a), of(mix->b));
    if (std::holds_alternative<ir::Dielectric>(material.kind) ||
        (phong != nullptr && is_some(phong->refract))) {
      kind = Kind::refracts;
    }
    const ir::NumberInput& opacity = material.common.opacity;
    if (opacity.texture.valid() || opacity.value < 1) kind = std::max(kind, Kind::passes);
    kinds_.push_back(kind);
  }
}

void lint_scene(Session& session) {
  const ir::Scene& scene = session.builder.scene();
  const Transparency transparency(scene);
  const std::vector<PlacedLight> lights = lights_of(scene);
  for (const ir::Item& item : scene.items) {
    std::visit(
        [&](auto id) {
          const auto& shape = scene.shape(id);
          const std::optional<Extent> own = closed_extent(shape);
          if (!own) return;
          const ir::Transform& transform = scene.transforms[item.transform];
          const Extent extent = transform.is_identity() ? *own : moved(transform, *own);
          lint_tiny(session, item, extent);
          if (!lights.empty() && transparency.blocks_light(item.material))
            lint_enclosed(session, item, shape, extent, lights);
        },
        item.shape);
  }
  lint_gaps(session, scene.items, transparency);
  for (std::uint32_t i = 0; i < scene.protos.size(); ++i)
    lint_gaps(session, scene.protos[ir::ProtoId(i)].items, transparency);
}

}  // namespace scenec::frontend
