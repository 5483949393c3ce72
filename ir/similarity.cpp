#include "ir/similarity.hpp"

#include <cmath>

#include "base/elementary.hpp"
#include "base/hash.hpp"

namespace scenec::ir {
namespace {

Transform matrix_of(const Similarity& by) {
  const double c = cos(by.turn.value) * by.scale;
  const double s = sin(by.turn.value) * by.scale;
  Transform t;
  t.m = {c, 0, s, by.move.x, 0, by.scale, 0, by.move.y, -s, 0, c, by.move.z, 0, 0, 0, 1};
  return t;
}

template <class V>
V turned(const Transform& t, const V& v) {
  const Vec3 result = apply_linear(t, {v.x, v.y, v.z});
  return {result.x, result.y, result.z};
}

// What is given off by lengths of another scale so that the picture stays: an area's radiance is
// kept; what falls off with the square of the distance, and what is given as a total, is not.
struct LightChange {
  const Similarity& by;
  Transform t;
  double area = by.scale * by.scale;

  template <class L>
  void scale_source(L& light) const {
    if (light.decay == Decay::none) return;
    if (light.intensity) *light.intensity *= area;
    if (light.power) light.power->value *= area;
  }
  void operator()(PointLight& light) const {
    light.position = apply(t, light.position);
    scale_source(light);
  }
  void operator()(SpotLight& light) const {
    light.position = apply(t, light.position);
    light.direction = turned(t, light.direction);
    scale_source(light);
  }
  void operator()(DirectionalLight& light) const { light.direction = turned(t, light.direction); }
  void operator()(SphereLight& light) const {
    light.center = apply(t, light.center);
    light.radius.value *= by.scale;
    if (light.power) light.power->value *= area;
  }
  void operator()(QuadLight& light) const {
    light.corner = apply(t, light.corner);
    light.edge_u = turned(t, light.edge_u);
    light.edge_v = turned(t, light.edge_v);
    if (light.power) light.power->value *= area;
  }
  void operator()(DiskLight& light) const {
    light.center = apply(t, light.center);
    light.normal = turned(t, light.normal);
    light.radius.value *= by.scale;
    if (light.power) light.power->value *= area;
  }
  void operator()(EnvironmentLight& light) const { light.rotation.value += by.turn.value; }
};

void scale_lens(double, Pinhole&) {}
void scale_lens(double, Panorama&) {}
void scale_lens(double scale, Orthographic& camera) {
  camera.height.value *= scale;
}
void scale_lens(double scale, ThinLens& camera) {
  camera.focus.distance.value *= scale;
  if (camera.aperture) camera.aperture->value *= scale;
  if (camera.f_stop) *camera.f_stop /= scale;
}

void change_camera(const Similarity& by, const Transform& t, Camera& camera) {
  std::visit(
      [&](auto& kind) {
        kind.eye = apply(t, kind.eye);
        if (kind.aim) kind.aim = apply(t, *kind.aim);
        if (kind.direction) kind.direction = turned(t, *kind.direction);
        kind.up = turned(t, kind.up);
        scale_lens(by.scale, kind);
      },
      camera.kind);
}

Transform placed(const Scene& scene, const Item& item) {
  return item.transform.valid() ? scene.transforms[item.transform] : Transform{};
}

}  // namespace

void transform(Scene& scene, const Similarity& by) {
  const Transform t = matrix_of(by);
  for (Item& item : scene.items)
    item.transform = scene.transforms.push(multiply(t, placed(scene, item)));
  const LightChange change{by, t};
  for (std::uint32_t i = 0; i < scene.lights.size(); ++i)
    std::visit(change, scene.lights[Id<Light>(i)].kind);
  for (std::uint32_t i = 0; i < scene.cameras.size(); ++i)
    change_camera(by, t, scene.cameras[CameraId(i)]);
  for (std::uint32_t i = 0; i < scene.materials.size(); ++i) {
    auto* const clear = std::get_if<Dielectric>(&scene.materials[MaterialId(i)].kind);
    if (clear == nullptr) continue;
    Color& sigma = clear->absorption;
    sigma = {sigma.r / by.scale, sigma.g / by.scale, sigma.b / by.scale};
  }
}

void jitter(Scene& scene, std::uint64_t seed) {
  std::uint64_t number = 0;
  for (Item& item : scene.items) {
    Transform t = placed(scene, item);
    Hasher hasher;
    hasher.add(seed);
    hasher.add(++number);
    std::uint64_t bits = hasher.result().low;
    for (std::size_t i = 0; i < 12; ++i, bits >>= 2) {
      // Zeroes stay: an ulp of nothing is nothing.
      if (t.m[i] == 0 || (bits & 3) == 0) continue;
      t.m[i] = std::nextafter(t.m[i], (bits & 1) != 0 ? 2 * t.m[i] : 0);
    }
    item.transform = scene.transforms.push(t);
  }
}

}  // namespace scenec::ir
