// Content hashes of a scene. Outside: source positions, names, paths, comments, order of fields and
// declarations, unused declarations. Inside: everything that can change the picture, and the order
// of placed items and lights.
#pragma once

#include "base/hash.hpp"
#include "ir/scene.hpp"

namespace scenec::ir {

[[nodiscard]] Hash128 content_hash(const Scene& scene);
[[nodiscard]] Hash128 content_hash(const Scene& scene, MaterialId material);
[[nodiscard]] Hash128 content_hash(const Scene& scene, TextureId texture);
[[nodiscard]] Hash128 content_hash(const Scene& scene, ProtoId proto);
[[nodiscard]] Hash128 content_hash(const Scene& scene, const ShapeRef& shape);

}  // namespace scenec::ir
