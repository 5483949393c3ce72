// From what a query found to a hit in the world: target-independent, once a ray.
#include "backend/accel/scene_data.hpp"

namespace scenec::backend {
namespace {

using World = SceneAccel::Data;

Surface object_surface(const Placement& place, const Ray& ray, const ShapeHit& hit,
                       HitDetail detail) {
  const World& w = *place.world;
  const std::uint32_t i = place.item->index;
  switch (place.item->kind) {
    case ShapeKind::sphere:
      return surface(w.spheres[i], ray, hit, detail);
    case ShapeKind::plane:
      return surface(w.planes[i], ray, hit);
    case ShapeKind::triangle:
      return surface(w.triangles[i], ray, hit);
    case ShapeKind::quad:
      return surface(w.quads[i], ray, hit);
    case ShapeKind::disk:
      return surface(w.disks[i], ray, hit, detail);
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

// One placement outward: from its object space to the space it is placed in.
void to_outer(const Placement& place, Surface& s, HitDetail detail) {
  if (place.item->transform == SceneAccel::identity) return;
  const Transform t = place.world->places[place.item->transform];
  s.error = t.apply_abs(s.error) + t.round_trip_error(s.point);
  s.point = t.apply(s.point);
  s.geometric_normal = t.apply(s.geometric_normal);
  s.shading_normal = t.apply(s.shading_normal);
  if (detail == HitDetail::place) return;
  s.dp_du = t.apply(s.dp_du);
  s.dp_dv = t.apply(s.dp_dv);
}

}  // namespace

Ray to_object(const Placement& place, const Ray& ray) {
  return place.world->places.to_object(place.item->transform, ray);
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

void complete(const ItemPath& path, const Ray& world_ray, const ShapeHit& found, HitDetail detail,
              Hit& hit) {
  Ray ray = world_ray;
  for (std::uint32_t i = 0; i < path.size; ++i) ray = to_object(path.steps[i], ray);
  const Placement& leaf = path.leaf();
  if (detail == HitDetail::where_textured)
    detail = leaf.item->traits.textured ? HitDetail::texture : HitDetail::place;
  Surface s = object_surface(leaf, ray, found, detail);
  for (std::uint32_t i = path.size; i-- > 0;) to_outer(path.steps[i], s, detail);
  hit.t = found.t;
  hit.item = leaf.item->item;
  hit.primitive = found.part;
  hit.instance_count = path.size - 1;
  for (std::uint32_t i = 0; i + 1 < path.size; ++i) hit.instances[i] = path.steps[i].item->item;
  hit.uncertified = leaf.item->kind == ShapeKind::revolve && !is_certified(found);
  const bool barycentric =
      leaf.item->kind == ShapeKind::triangle || leaf.item->kind == ShapeKind::mesh;
  hit.b1 = barycentric ? found.a : 0;
  hit.b2 = barycentric ? found.b : 0;
  hit.point = s.point;
  hit.error = s.error;
  hit.geometric_normal = normalized(s.geometric_normal);
  hit.shading_normal = normalized(s.shading_normal, hit.geometric_normal);
  if (detail == HitDetail::place) return;
  hit.u = s.u;
  hit.v = s.v;
  hit.dp_du = s.dp_du;
  hit.dp_dv = s.dp_dv;
}

}  // namespace scenec::backend
