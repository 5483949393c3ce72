// Tracing a SceneAccel: one walk serves closest and any hit, plain and filtered, tree and brute
// force.
#include <array>
#include <cmath>
#include <limits>
#include <span>

#include "backend/accel/bvh_traverse.hpp"
#include "backend/accel/scene_accel.hpp"
#include "backend/accel/scene_data.hpp"

namespace scenec::backend {
namespace {

enum class Want : std::uint8_t { closest, any };
enum class Walk : std::uint8_t { tree, brute_force };

using World = SceneAccel::Data;

// An item and the world it is placed in.
struct Placement {
  const World* world = nullptr;
  const PlacedItem* item = nullptr;
};

// From the outermost instance down to the shape.
struct Path {
  std::array<Placement, Hit::max_instances + 1> steps;
  std::uint32_t size = 0;
};

Ray to_object(const Placement& place, const Ray& ray) {
  if (place.item->transform == SceneAccel::identity) return ray;
  const Transform& t = place.world->transforms[place.item->transform];
  return {t.apply_inverse(ray.origin), t.apply_inverse(ray.direction), ray.t_min, ray.t_max};
}

Surface object_surface(const Placement& place, const Ray& ray, const ShapeHit& hit) {
  const World& w = *place.world;
  const std::uint32_t i = place.item->index;
  switch (place.item->kind) {
    case ShapeKind::sphere:
      return surface(w.spheres[i], ray, hit);
    case ShapeKind::plane:
      return surface(w.planes[i], ray, hit);
    case ShapeKind::triangle:
      return surface(w.triangles[i], ray, hit);
    case ShapeKind::quad:
      return surface(w.quads[i], ray, hit);
    case ShapeKind::disk:
      return surface(w.disks[i], ray, hit);
    case ShapeKind::box:
      return surface(w.boxes[i], ray, hit);
    case ShapeKind::cylinder:
      return surface(w.cylinders[i], ray, hit);
    case ShapeKind::mesh:
      return surface(w.meshes[i]->mesh(), hit);
    case ShapeKind::revolve:
      return surface(*w.revolves[i], ray, hit);
    case ShapeKind::instance:
      break;
  }
  return {};
}

bool intersect_shape(const World& w, const PlacedItem& item, const Ray& ray, ShapeHit& out) {
  switch (item.kind) {
    case ShapeKind::sphere:
      return intersect(w.spheres[item.index], ray, out);
    case ShapeKind::plane:
      return intersect(w.planes[item.index], ray, out);
    case ShapeKind::triangle:
      return intersect(w.triangles[item.index], ray, out);
    case ShapeKind::quad:
      return intersect(w.quads[item.index], ray, out);
    case ShapeKind::disk:
      return intersect(w.disks[item.index], ray, out);
    case ShapeKind::box:
      return intersect(w.boxes[item.index], ray, out);
    case ShapeKind::cylinder:
      return intersect(w.cylinders[item.index], ray, out);
    case ShapeKind::revolve:
      return intersect(*w.revolves[item.index], ray, out);
    case ShapeKind::mesh:
    case ShapeKind::instance:
      break;
  }
  return false;
}

// One placement outward: from its object space to the space it is placed in.
void to_outer(const Placement& place, Surface& s) {
  if (place.item->transform == SceneAccel::identity) return;
  const Transform& t = place.world->transforms[place.item->transform];
  s.error = t.apply_abs(s.error) + t.round_trip_error(s.point);
  s.point = t.apply(s.point);
  s.geometric_normal = t.apply(s.geometric_normal);
  s.shading_normal = t.apply(s.shading_normal);
  s.dp_du = t.apply(s.dp_du);
  s.dp_dv = t.apply(s.dp_dv);
}

Hit complete(const Path& path, const Ray& world_ray, const ShapeHit& found) {
  Ray ray = world_ray;
  for (std::uint32_t i = 0; i < path.size; ++i) ray = to_object(path.steps[i], ray);
  const Placement& leaf = path.steps[path.size - 1];
  Surface s = object_surface(leaf, ray, found);
  for (std::uint32_t i = path.size; i-- > 0;) to_outer(path.steps[i], s);
  Hit hit;
  hit.t = found.t;
  hit.item = leaf.item->item;
  hit.primitive = found.part;
  hit.instance_count = path.size - 1;
  for (std::uint32_t i = 0; i + 1 < path.size; ++i) hit.instances[i] = path.steps[i].item->item;
  const bool barycentric =
      leaf.item->kind == ShapeKind::triangle || leaf.item->kind == ShapeKind::mesh;
  hit.b1 = barycentric ? found.a : 0;
  hit.b2 = barycentric ? found.b : 0;
  hit.point = s.point;
  hit.error = s.error;
  hit.geometric_normal = normalized(s.geometric_normal);
  hit.shading_normal = normalized(s.shading_normal, hit.geometric_normal);
  hit.u = s.u;
  hit.v = s.v;
  hit.dp_du = s.dp_du;
  hit.dp_dv = s.dp_dv;
  return hit;
}

class Query {
 public:
  Query(const Ray& ray, const HitFilter& filter, Want want, Walk walk)
      : world_ray_(ray), filter_(filter), best_{ray.t_max, 0, 0, 0}, want_(want), walk_(walk) {}

  // True when a search for any hit may stop.
  bool trace(const World& world, const Ray& ray) {
    for (const PlacedItem& item : world.unbounded)
      if (trace_item(world, item, ray)) return true;
    if (walk_ == Walk::brute_force) {
      for (const PlacedItem& item : world.items)
        if (trace_item(world, item, ray)) return true;
      return false;
    }
    const auto leaf = [&](std::uint32_t first, std::uint32_t count) {
      for (std::uint32_t i = first; i < first + count; ++i)
        if (trace_item(world, world.items[i], ray)) return true;
      return false;
    };
    return visit_leaves(world.bvh, RayBoxTest(ray), ray.t_min, best_.t, leaf);
  }

  [[nodiscard]] bool found() const { return found_; }
  [[nodiscard]] Hit hit() const { return complete(best_path_, world_ray_, best_); }

 private:
  bool trace_item(const World& world, const PlacedItem& item, const Ray& ray) {
    path_.steps[path_.size++] = {&world, &item};
    Ray local = to_object(path_.steps[path_.size - 1], ray);
    local.t_max = best_.t;
    bool done = false;
    if (item.kind == ShapeKind::instance) {
      done = trace(World::of(*world.worlds[item.index]), local);
    } else if (item.kind == ShapeKind::mesh) {
      done = trace_mesh(*world.meshes[item.index], item, local);
    } else {
      done = trace_shape(world, item, local);
    }
    --path_.size;
    return done;
  }

  bool trace_shape(const World& world, const PlacedItem& item, Ray ray) {
    ShapeHit hit;
    while (intersect_shape(world, item, ray, hit)) {
      if (!improves(hit)) return false;
      if (passes(item, hit)) return accept(hit);
      // Behind a refused hit the shape may have another.
      ray.t_min = next_up(hit.t);
      if (!(ray.t_min <= ray.t_max)) return false;
    }
    return false;
  }

  bool trace_mesh(const MeshAccel& mesh, const PlacedItem& item, const Ray& ray) {
    const RayShear shear(ray);
    const auto test_face = [&](std::uint32_t face) {
      const TriangleMesh& m = mesh.mesh();
      const Face& f = m.faces[face];
      ShapeHit hit;
      if (!intersect_triangle(shear, m.positions[f[0]], m.positions[f[1]], m.positions[f[2]],
                              ray.t_min, best_.t, hit))
        return false;
      hit.part = face;
      return improves(hit) && passes(item, hit) && accept(hit);
    };
    if (walk_ == Walk::brute_force) {
      for (std::uint32_t i = 0; i < mesh.mesh().faces.size(); ++i)
        if (test_face(i)) return true;
      return false;
    }
    const std::vector<std::uint32_t>& order = mesh.bvh().order();
    const auto leaf = [&](std::uint32_t first, std::uint32_t count) {
      for (std::uint32_t i = first; i < first + count; ++i)
        if (test_face(order[i])) return true;
      return false;
    };
    return visit_leaves(mesh.bvh(), RayBoxTest(ray), ray.t_min, best_.t, leaf);
  }

  // Nearer than the best so far, or as near and earlier in the caller's numbering.
  [[nodiscard]] bool improves(const ShapeHit& hit) const {
    if (!found_ || hit.t < best_.t) return true;
    if (hit.t > best_.t) return false;
    const std::uint32_t common = path_.size < best_path_.size ? path_.size : best_path_.size;
    for (std::uint32_t i = 0; i < common; ++i) {
      const std::uint32_t a = path_.steps[i].item->item;
      const std::uint32_t b = best_path_.steps[i].item->item;
      if (a != b) return a < b;
    }
    if (path_.size != best_path_.size) return path_.size < best_path_.size;
    return hit.part < best_.part;
  }

  [[nodiscard]] bool passes(const PlacedItem& item, const ShapeHit& hit) const {
    if (item.option == ItemOption::plain || !filter_.active()) return true;
    return filter_.keeps(complete(path_, world_ray_, hit));
  }

  bool accept(const ShapeHit& hit) {
    best_ = hit;
    best_path_ = path_;
    found_ = true;
    return want_ == Want::any;
  }

  Ray world_ray_;
  const HitFilter& filter_;
  ShapeHit best_;
  Path path_;
  Path best_path_;
  bool found_ = false;
  Want want_;
  Walk walk_;
};

bool find_hit(const World& world, const Ray& ray, Hit& hit, const HitFilter& filter, Walk walk) {
  if (!is_traceable(ray)) return false;
  Query query(ray, filter, Want::closest, walk);
  query.trace(world, ray);
  if (query.found()) hit = query.hit();
  return query.found();
}

}  // namespace

bool SceneAccel::intersect(const Ray& ray, Hit& hit, const HitFilter& filter) const {
  return find_hit(*data_, ray, hit, filter, Walk::tree);
}

bool SceneAccel::intersect_brute_force(const Ray& ray, Hit& hit, const HitFilter& filter) const {
  return find_hit(*data_, ray, hit, filter, Walk::brute_force);
}

bool SceneAccel::occluded(const Ray& ray, const HitFilter& filter) const {
  if (!is_traceable(ray)) return false;
  Query query(ray, filter, Want::any, Walk::tree);
  query.trace(*data_, ray);
  return query.found();
}

}  // namespace scenec::backend
