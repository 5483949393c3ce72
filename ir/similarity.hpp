// A scene moved, turned about the y axis and scaled as a whole, camera and lights with it, so that
// its picture stays the same but for rounding; and a scene whose items are displaced by an ulp.
#pragma once

#include <cstdint>

#include "ir/scene.hpp"

namespace scenec::ir {

// The scale first, then the turn, then the move.
struct Similarity {
  double scale = 1;
  Angle turn;  // about +y, which every light can take
  Vec3 move;   // metres
};
// Changes every placed item, light, camera and density. The content hash stays that of before: the
// scene is for rendering, not for keeping.
void transform(Scene& scene, const Similarity& by);

// Moves every placed item by about an ulp of its coordinates, each by numbers of its own that
// follow from `seed`.
void jitter(Scene& scene, std::uint64_t seed);

}  // namespace scenec::ir
