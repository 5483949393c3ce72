#include "ir/content_hash.hpp"

#include "ir/content_hasher.hpp"

namespace scenec::ir {

Hash128 content_hash(const Scene& scene) {
  return ContentHasher(scene).whole();
}
Hash128 content_hash(const Scene& scene, MaterialId material) {
  return ContentHasher(scene).of(material);
}
Hash128 content_hash(const Scene& scene, TextureId texture) {
  return ContentHasher(scene).of(texture);
}
Hash128 content_hash(const Scene& scene, ProtoId proto) {
  return ContentHasher(scene).of(proto);
}
Hash128 content_hash(const Scene& scene, const ShapeRef& shape) {
  return ContentHasher(scene).of(shape);
}

}  // namespace scenec::ir
