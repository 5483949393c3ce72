// The parts of build(): from the IR's tables to accelerators and emitters.
#pragma once

#include <memory>
#include <vector>

#include "backend/backend.hpp"
#include "backend/math/transform.hpp"
#include "backend/render_scene.hpp"
#include "base/parallel.hpp"

namespace scenec::backend {

[[nodiscard]] Transform transform_of(const ir::Scene& scene, ir::TransformId id);

[[nodiscard]] Sphere kernel_of(const ir::Sphere& shape);
[[nodiscard]] Plane kernel_of(const ir::Plane& shape);
[[nodiscard]] Triangle kernel_of(const ir::Triangle& shape);
[[nodiscard]] Quad kernel_of(const ir::Quad& shape);
[[nodiscard]] Disk kernel_of(const ir::Disk& shape);
[[nodiscard]] Box kernel_of(const ir::Box& shape);
[[nodiscard]] Cylinder kernel_of(const ir::Cylinder& shape);
// A triangle with normals or texture coordinates is a mesh of one face.
[[nodiscard]] TriangleMesh mesh_of(const ir::Triangle& shape);
[[nodiscard]] Revolve revolve_of(const ir::Revolve& shape);

// What the images of a scene show to those who fold constants.
[[nodiscard]] ir::ImageFacts image_facts(const RenderScene& scene);

// Adds every item of the world (numbers from 0) and of the protos, and fills `scene.items`.
void add_items(const PreparedScene& prepared, RenderScene& scene, ThreadPool& pool,
               const BuildOptions& options);
// Builds the tree over a world's items, or takes the one that has been kept.
void build_world(SceneAccel& world, ThreadPool& pool, const BuildOptions& options);
// Adds the lights, their shapes, and every emissive item that can be sampled.
void add_lights(const PreparedScene& prepared, RenderScene& scene);

// Finds the spheres that throw light, after materials, items and lights are known.
void add_casters(RenderScene& scene);

// The emitters of one shape, in the order of Hit::primitive; empty: cannot be sampled.
[[nodiscard]] std::vector<Emitter> emitters_of(const RenderScene& scene, const ir::ShapeRef& shape,
                                               const Transform& world_from_object);

}  // namespace scenec::backend
