// What a tree over items depends on, as one key: two worlds that are filled alike get the same.
#include <type_traits>

#include "backend/accel/scene_data.hpp"

namespace scenec::backend {
namespace {

// Doubles without gaps between them.
template <class T>
concept PlainDoubles = std::is_trivially_copyable_v<T> && sizeof(T) % sizeof(double) == 0;

template <PlainDoubles T>
void add_all(Hasher& hasher, const std::vector<T>& values) {
  hasher.add(values.size());
  hasher.raw(values.data(), values.size() * sizeof(T));
}

void add_all(Hasher& hasher, const std::vector<Cylinder>& values) {
  hasher.add(values.size());
  for (const Cylinder& c : values) {
    hasher.raw(&c.base, sizeof c.base);
    hasher.raw(&c.frame, sizeof c.frame);
    hasher.add(c.height);
    hasher.add(c.radius);
    hasher.add(c.capped);
  }
}

void add_pointer(Hasher& hasher, const void* pointer) {
  hasher.raw(&pointer, sizeof pointer);
}

template <class T>
void add_all(Hasher& hasher, const std::vector<std::shared_ptr<const T>>& values) {
  hasher.add(values.size());
  for (const auto& value : values) add_pointer(hasher, value.get());
}

void add_items(Hasher& hasher, const std::vector<PlacedItem>& items) {
  hasher.add(items.size());
  for (const PlacedItem& item : items) {
    hasher.add(std::uint64_t{item.item} << 32 | item.transform);
    hasher.add(std::uint64_t{item.index} << 16 | static_cast<std::uint64_t>(item.kind) << 8 |
               static_cast<std::uint64_t>(item.traits.filtered) << 1 |
               static_cast<std::uint64_t>(item.traits.textured));
  }
}

}  // namespace

Hash128 SceneAccel::content_key(Target target) const {
  const Data& d = *data_;
  SCENEC_ASSERT(!d.built);
  Hasher hasher;
  hasher.add(target);
  d.places.feed(hasher);
  add_all(hasher, d.spheres);
  add_all(hasher, d.planes);
  add_all(hasher, d.triangles);
  add_all(hasher, d.quads);
  add_all(hasher, d.disks);
  add_all(hasher, d.boxes);
  add_all(hasher, d.cylinders);
  add_all(hasher, d.meshes);
  add_all(hasher, d.revolves);
  hasher.add(d.worlds.size());
  for (const auto& world : d.worlds) add_pointer(hasher, world->data_.get());
  add_items(hasher, d.items);
  return hasher.result();
}

SceneAccel SceneAccel::share() const {
  SCENEC_ASSERT(data_->built);
  SceneAccel other;
  other.data_ = data_;
  other.kernels_ = kernels_;
  return other;
}

}  // namespace scenec::backend
