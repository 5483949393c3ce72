#include <limits>
#include <utility>

#include "backend/accel/scene_data.hpp"

namespace scenec::backend {
namespace {

void set(FlatPoint& to, std::size_t lane, double x, double y, double z) {
  to[0][lane] = x;
  to[1][lane] = y;
  to[2][lane] = z;
}
void set(FlatPoint& to, std::size_t lane, const Point3& p) {
  set(to, lane, p.x, p.y, p.z);
}
void set(FlatPoint& to, std::size_t lane, const Vector3& v) {
  set(to, lane, v.x, v.y, v.z);
}

// The block with room for one more.
template <class Block>
Block& block_with_room(std::vector<Block>& blocks, std::size_t count) {
  if (count % flat_width == 0) {
    Block empty;
    // Every member but the last is made of doubles.
    auto* numbers = reinterpret_cast<double*>(&empty);
    const std::size_t many = offsetof(Block, item) / sizeof(double);
    for (std::size_t i = 0; i < many; ++i) numbers[i] = std::numeric_limits<double>::quiet_NaN();
    empty.item = {};
    blocks.push_back(empty);
  }
  return blocks.back();
}

class Flattener {
 public:
  explicit Flattener(const SceneAccel::Data& d) : d_(d) {}

  [[nodiscard]] static bool takes(const PlacedItem& item) {
    return item.transform == SceneAccel::identity && !item.traits.filtered &&
           (item.kind == ShapeKind::sphere || item.kind == ShapeKind::quad ||
            item.kind == ShapeKind::disk || item.kind == ShapeKind::plane);
  }

  // Empty when a coordinate is beyond the domain.
  FlatItems flatten(const std::vector<PlacedItem>& items) {
    for (std::uint32_t i = 0; i < items.size(); ++i) add(items[i], i);
    out_.used = sane_;
    return sane_ ? out_ : FlatItems{};
  }

 private:
  void add(const PlacedItem& item, std::uint32_t number) {
    switch (item.kind) {
      case ShapeKind::sphere:
        return add_sphere(d_.spheres[item.index], number);
      case ShapeKind::quad:
        return add_quad(d_.quads[item.index], number);
      case ShapeKind::disk:
        return add_disk(d_.disks[item.index], number);
      default:
        return add_plane(d_.planes[item.index], number);
    }
  }

  void check(const Vector3& v) { sane_ = sane_ && max_abs(v) <= FlatItems::largest; }

  void add_sphere(const Sphere& s, std::uint32_t number) {
    const std::size_t lane = spheres_ % flat_width;
    FlatSpheres& b = block_with_room(out_.spheres, spheres_++);
    check(as_vector(s.center));
    check({s.radius, 0, 0});
    set(b.center, lane, s.center);
    b.radius[lane] = s.radius;
    b.item[lane] = number;
  }
  void add_quad(const Quad& q, std::uint32_t number) {
    const std::size_t lane = quads_ % flat_width;
    FlatQuads& b = block_with_room(out_.quads, quads_++);
    const std::array<Point3, 4> corners = corners_of(q);
    for (std::size_t k = 0; k < 4; ++k) {
      check(as_vector(corners[k]));
      set(b.corner[k], lane, corners[k]);
    }
    const Vector3 n = cross(q.edge_u, q.edge_v);
    check(n);
    set(b.normal, lane, n);
    b.item[lane] = number;
  }
  void add_disk(const Disk& d, std::uint32_t number) {
    const std::size_t lane = disks_ % flat_width;
    FlatDisks& b = block_with_room(out_.disks, disks_++);
    check(as_vector(d.center));
    check({d.radius, 0, 0});
    set(b.center, lane, d.center);
    set(b.normal, lane, d.normal.vector());
    b.radius[lane] = d.radius;
    b.item[lane] = number;
  }
  void add_plane(const Plane& p, std::uint32_t number) {
    const std::size_t lane = planes_ % flat_width;
    FlatPlanes& b = block_with_room(out_.planes, planes_++);
    check(as_vector(p.normal));
    check({p.offset, 0, 0});
    set(b.normal, lane, as_vector(p.normal));
    b.offset[lane] = p.offset;
    b.item[lane] = number;
  }

  const SceneAccel::Data& d_;
  FlatItems out_;
  bool sane_ = true;
  std::size_t spheres_ = 0, quads_ = 0, disks_ = 0, planes_ = 0;
};

}  // namespace

void take_flat_items(SceneAccel::Data& d, std::vector<PlacedItem>& bounded) {
  std::vector<PlacedItem> taken;
  for (const std::vector<PlacedItem>* items :
       {&std::as_const(bounded), &std::as_const(d.unbounded)})
    for (const PlacedItem& item : *items) {
      if (!Flattener::takes(item)) continue;
      if (taken.size() == FlatItems::most) return;
      taken.push_back(item);
    }
  const bool whole = taken.size() == bounded.size() + d.unbounded.size();
  if (taken.empty() || (!whole && taken.size() > FlatItems::most_beside_others)) return;
  d.flat = Flattener(d).flatten(taken);
  if (!d.flat.used) return;
  d.flat_list = std::move(taken);
  std::erase_if(bounded, Flattener::takes);
  std::erase_if(d.unbounded, Flattener::takes);
}

}  // namespace scenec::backend
