// Lights and emissive items to the table of lights.
#include <algorithm>
#include <array>

#include "backend/build.hpp"
#include "base/elementary.hpp"

namespace scenec::backend {
namespace {

Rgb rgb_of(const ir::Color& c) {
  return {c.r, c.g, c.b};
}

Emitter flat(EmitterShape shape, const Transform& t, const Point3& origin, const Vector3& a,
             const Vector3& b) {
  Emitter e;
  e.shape = shape;
  e.origin = t.apply(origin);
  e.a = t.apply(a);
  e.b = t.apply(b);
  e.flipped = t.flips();
  return e;
}

Emitter ellipse(const Transform& t, const Point3& center, const Frame& frame, double radius) {
  return flat(EmitterShape::ellipse, t, center, frame.x.vector() * radius,
              frame.y.vector() * radius);
}

// Columns of equal length at right angles, up to rounding: spheres stay spheres.
bool is_similarity(const Vector3& a, const Vector3& b, const Vector3& c) {
  const double scale = length_squared(a);
  const double tolerance = gamma(64) * scale;
  return std::fabs(length_squared(b) - scale) <= tolerance &&
         std::fabs(length_squared(c) - scale) <= tolerance && std::fabs(dot(a, b)) <= tolerance &&
         std::fabs(dot(b, c)) <= tolerance && std::fabs(dot(c, a)) <= tolerance;
}

Emitter sphere(const Transform& t, const Sphere& s) {
  Emitter e;
  e.origin = t.apply(s.center);
  const Vector3 a = t.apply(Vector3{s.radius, 0, 0});
  const Vector3 b = t.apply(Vector3{0, s.radius, 0});
  const Vector3 c = t.apply(Vector3{0, 0, s.radius});
  if (is_similarity(a, b, c)) {
    e.shape = EmitterShape::sphere;
    e.radius = length(a);
  } else {
    e.shape = EmitterShape::ellipsoid;
    e.a = a;
    e.b = b;
    e.c = c;
    e.flipped = t.flips();
  }
  return e;
}

std::vector<Emitter> box(const Transform& t, const Box& box) {
  const Vector3 d = box.max - box.min;
  const Vector3 x{d.x, 0, 0};
  const Vector3 y{0, d.y, 0};
  const Vector3 z{0, 0, d.z};
  const auto quad = [&](const Point3& corner, const Vector3& a, const Vector3& b) {
    return flat(EmitterShape::parallelogram, t, corner, a, b);
  };
  // Hit::primitive: -x, +x, -y, +y, -z, +z; a x b points outwards.
  return {quad(box.min, z, y),     quad(box.min + x, y, z), quad(box.min, x, z),
          quad(box.min + y, z, x), quad(box.min, y, x),     quad(box.min + z, x, y)};
}

std::vector<Emitter> cylinder(const Transform& t, const Cylinder& c) {
  const Vector3 axis = c.frame.z.vector() * c.height;
  Emitter side = flat(EmitterShape::tube, t, c.base, c.frame.x.vector() * c.radius,
                      c.frame.y.vector() * c.radius);
  side.c = t.apply(axis);
  std::vector<Emitter> out{side};
  if (c.capped) {
    Emitter base = ellipse(t, c.base, c.frame, c.radius);
    base.flipped = !base.flipped;  // the base faces away from the top
    out.push_back(base);
    out.push_back(ellipse(t, c.base + axis, c.frame, c.radius));
  }
  return out;
}

std::vector<Emitter> mesh(const Transform& t, const TriangleMesh& mesh) {
  std::vector<Emitter> out;
  out.reserve(mesh.faces.size());
  for (std::uint32_t face = 0; face < mesh.faces.size(); ++face) {
    const Triangle tri = triangle_of(mesh, face);
    out.push_back(flat(EmitterShape::triangle, t, tri.a, tri.b - tri.a, tri.c - tri.a));
  }
  return out;
}

class LightAdder {
 public:
  LightAdder(const PreparedScene& prepared, RenderScene& out) : scene_(*prepared.scene), out_(out) {
    for (const ir::Proto& proto : scene_.protos) {
      first_of_proto_.push_back(next_item_);
      next_item_ += static_cast<std::uint32_t>(proto.items.size());
      emissive_proto_.push_back(any_emissive(proto.items));
    }
  }

  void add_all() {
    for (const ir::Item& item : scene_.items)
      if (const auto* id = std::get_if<Id<ir::Plane>>(&item.shape))
        add_wall(kernel_of(scene_.shape(*id)), item);
    add_item_list(scene_.items, 0, Transform{}, ir::MaterialId{});
    for (const ir::Light& light : scene_.lights) add_light(light.kind);
  }

 private:
  [[nodiscard]] bool any_emissive(const std::vector<ir::Item>& items) const {
    return std::any_of(items.begin(), items.end(), [&](const ir::Item& item) {
      if (item.material.valid() && out_.facts.emissive(item.material)) return true;
      const auto* id = std::get_if<Id<ir::Instance>>(&item.shape);
      // Protos refer to earlier ones, whose answer is known.
      return id != nullptr && scene_.shape(*id).of.value() < emissive_proto_.size() &&
             emissive_proto_[scene_.shape(*id).of.value()];
    });
  }

  // Planes that no light passes, of the world itself: nothing is seen through them.
  void add_wall(const Plane& plane, const ir::Item& item) {
    if (!item.material.valid() || out_.facts.transparent(item.material) ||
        out_.facts.clear(item.material) || !transform_of(scene_, item.transform).is_identity())
      return;
    walls_.push_back(plane);
  }
  void cut_by_walls(Emitter& e) const {
    if (e.shape != EmitterShape::sphere) return;
    for (const Plane& wall : walls_) cut_by_plane(e, as_vector(wall.normal), wall.offset);
  }

  void add_item_list(const std::vector<ir::Item>& items, std::uint32_t first,
                     const Transform& outer, ir::MaterialId replaced) {
    for (std::size_t i = 0; i < items.size(); ++i) {
      const ir::Item& item = items[i];
      const std::uint32_t number = first + static_cast<std::uint32_t>(i);
      const ir::MaterialId material = replaced.valid() ? replaced : item.material;
      if (const auto* id = std::get_if<Id<ir::Instance>>(&item.shape)) {
        const ir::ProtoId proto = scene_.shape(*id).of;
        const bool lit =
            material.valid() ? out_.facts.emissive(material) : emissive_proto_[proto.value()];
        if (!lit) continue;
        path_.push_back(number);
        add_item_list(scene_.protos[proto].items, first_of_proto_[proto.value()],
                      outer * transform_of(scene_, item.transform), material);
        path_.pop_back();
      } else if (material.valid() && out_.facts.emissive(material)) {
        add_emissive(item, number, outer * transform_of(scene_, item.transform), material);
      }
    }
  }

  void add_emissive(const ir::Item& item, std::uint32_t number, const Transform& place,
                    ir::MaterialId material) {
    std::vector<Emitter> emitters = emitters_of(out_, item.shape, place);
    if (emitters.empty()) return;
    const auto base = static_cast<std::uint32_t>(out_.lights.emitters.size());
    const bool textured = out_.facts.textured_emission(material);
    const Rgb radiance = mean_emission(material);
    for (Emitter& e : emitters) {
      e.material = material;
      e.two_sided = out_.facts.two_sided(material);
      e.textured = textured;
      e.radiance = radiance;
      cut_by_walls(e);
      measure(e);
      out_.lights.emitters.push_back(e);
    }
    if (path_.empty())
      out_.items[number].emitters = base;
    else
      out_.instanced_emitters[path_key(path_.data(), static_cast<std::uint32_t>(path_.size()),
                                       number)] = base;
  }

  // Over a grid of texture coordinates; only weighs the choice between lights.
  [[nodiscard]] Rgb mean_emission(ir::MaterialId id) const {
    const ir::Material& material = scene_.materials[id];
    Rgb sum;
    constexpr int steps = 8;
    const int used = material.common.emission.texture.valid() ? steps : 1;
    for (int i = 0; i < used * used; ++i) {
      sum += out_.textures.color(material.common.emission,
                                 {(i % used + 0.5) / used, (i / used + 0.5) / used});
    }
    sum = sum / (used * used);
    if (const auto* mix = std::get_if<ir::Mix>(&material.kind)) {
      const double w = out_.textures.number(mix->weight, {0.5, 0.5});
      // Even a part that is off in the middle may shine elsewhere: it must stay choosable.
      sum += mean_emission(mix->a) * std::fmax(1 - w, 0.01) +
             mean_emission(mix->b) * std::fmax(w, 0.01);
    }
    return sum;
  }

  template <class L>
  [[nodiscard]] static Rgb radiance_of(const L& light, double area_factor) {
    return rgb_of(light.color) * (light.radiance ? *light.radiance
                                  : light.power  ? light.power->value / area_factor
                                                 : 0);
  }

  template <class Kernel>
  void add_shape(const Kernel& kernel, Emitter emitter, Rgb radiance, bool visible) {
    emitter.radiance = radiance;
    emitter.visible = visible;
    cut_by_walls(emitter);
    measure(emitter);
    const auto number = static_cast<std::uint32_t>(out_.items.size());
    RenderItem item;
    item.light = static_cast<std::uint32_t>(out_.lights.emitters.size());
    out_.items.push_back(item);
    out_.lights.emitters.push_back(emitter);
    out_.accel.add(number, kernel, SceneAccel::identity, {.filtered = !visible, .textured = false});
  }

  void add_light(const ir::LightKind& kind) {
    const Transform world;
    if (const auto delta = delta_light_of(kind)) {
      out_.lights.deltas.push_back(*delta);
    } else if (const auto* s = std::get_if<ir::SphereLight>(&kind)) {
      const Sphere kernel{{s->center.x, s->center.y, s->center.z}, s->radius.value};
      Emitter e = sphere(world, kernel);
      // Inside it, light comes from all round. One that is not visible is passed by, so only the
      // side that is met first may count.
      e.two_sided = s->visible;
      add_shape(kernel, e, radiance_of(*s, 4 * pi * pi * kernel.radius * kernel.radius),
                s->visible);
    } else if (const auto* q = std::get_if<ir::QuadLight>(&kind)) {
      const Quad kernel{{q->corner.x, q->corner.y, q->corner.z},
                        {q->edge_u.x, q->edge_u.y, q->edge_u.z},
                        {q->edge_v.x, q->edge_v.y, q->edge_v.z}};
      Emitter e =
          flat(EmitterShape::parallelogram, world, kernel.corner, kernel.edge_u, kernel.edge_v);
      measure(e);
      add_shape(kernel, e, radiance_of(*q, pi * e.area), q->visible);
    } else if (const auto* d = std::get_if<ir::DiskLight>(&kind)) {
      const Disk kernel{{d->center.x, d->center.y, d->center.z},
                        normalized(Vector3{d->normal.x, d->normal.y, d->normal.z}),
                        d->radius.value};
      Emitter e = ellipse(world, kernel.center, frame_about(kernel.normal), kernel.radius);
      measure(e);
      add_shape(kernel, e, radiance_of(*d, pi * e.area), d->visible);
    } else if (const auto* env = std::get_if<ir::EnvironmentLight>(&kind)) {
      std::shared_ptr<const DecodedImage> image;
      if (env->image.valid()) {
        const auto* texture = std::get_if<ir::ImageTexture>(&scene_.textures[env->image].kind);
        if (texture != nullptr) image = out_.images[texture->file.value()];
      }
      out_.lights.environments.emplace_back(*env, std::move(image));
    }
  }

  const ir::Scene& scene_;
  RenderScene& out_;
  std::uint32_t next_item_ = static_cast<std::uint32_t>(scene_.items.size());
  std::vector<std::uint32_t> first_of_proto_;
  std::vector<bool> emissive_proto_;
  std::vector<std::uint32_t> path_;
  std::vector<Plane> walls_;
};

}  // namespace

std::vector<Emitter> emitters_of(const RenderScene& out, const ir::ShapeRef& shape,
                                 const Transform& t) {
  const ir::Scene& scene = *out.scene;
  if (const auto* id = std::get_if<Id<ir::Sphere>>(&shape))
    return {sphere(t, kernel_of(scene.shape(*id)))};
  if (const auto* id = std::get_if<Id<ir::Triangle>>(&shape)) {
    const Triangle k = kernel_of(scene.shape(*id));
    return {flat(EmitterShape::triangle, t, k.a, k.b - k.a, k.c - k.a)};
  }
  if (const auto* id = std::get_if<Id<ir::Quad>>(&shape)) {
    const Quad k = kernel_of(scene.shape(*id));
    return {flat(EmitterShape::parallelogram, t, k.corner, k.edge_u, k.edge_v)};
  }
  if (const auto* id = std::get_if<Id<ir::Disk>>(&shape)) {
    const Disk k = kernel_of(scene.shape(*id));
    return {ellipse(t, k.center, frame_about(k.normal), k.radius)};
  }
  if (const auto* id = std::get_if<Id<ir::Box>>(&shape)) return box(t, kernel_of(scene.shape(*id)));
  if (const auto* id = std::get_if<Id<ir::Cylinder>>(&shape))
    return cylinder(t, kernel_of(scene.shape(*id)));
  if (const auto* id = std::get_if<Id<ir::Mesh>>(&shape)) return mesh(t, *out.meshes[id->value()]);
  return {};  // planes and surfaces of revolution: found by chance
}

void add_lights(const PreparedScene& prepared, RenderScene& scene) {
  LightAdder(prepared, scene).add_all();
}

}  // namespace scenec::backend
