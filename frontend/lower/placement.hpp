// Where an item stands: the groups above it, and what they do to lights and cameras, which the IR
// stores in world space.
#pragma once

#include <vector>

#include "base/span.hpp"
#include "frontend/session.hpp"
#include "ir/cameras.hpp"
#include "ir/lights.hpp"
#include "ir/scene.hpp"

namespace scenec::frontend {

struct Surroundings {
  ir::Transform transform;                 // world (or proto) from here
  ir::MaterialId material;                 // of the nearest group that has one
  std::vector<ir::Item>* items = nullptr;  // the proto being filled; nullptr: the world
  bool in_proto = false;
};

// The parameters of a light or camera moved by `transform`. False (reported at `span`) when its
// kind cannot take the transform.
bool bake(Session& session, const ir::Transform& transform, ir::LightKind& light, Span span);
bool bake(Session& session, const ir::Transform& transform, ir::CameraKind& camera, Span span);

}  // namespace scenec::frontend
