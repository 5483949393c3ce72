// Checks of placed items that need the whole scene.
#include <algorithm>
#include <string>
#include <vector>

#include "backend/build.hpp"
#include "backend/geometry/kernel.hpp"
#include "backend/geometry/revolve_mesh.hpp"
#include "backend/prepare.hpp"
#include "backend/scene_facts.hpp"

namespace scenec::backend {
namespace {

Span span_of(const ir::Scene& scene, const ir::Item& item) {
  return item.origin.valid() ? scene.origins[item.origin].span : Span{};
}

// Levels of instances within each proto. Protos refer to earlier ones only, in the order of the
// table.
std::vector<std::uint32_t> depths_of_protos(const ir::Scene& scene) {
  std::vector<std::uint32_t> depths;
  for (const ir::Proto& proto : scene.protos) {
    std::uint32_t depth = 0;
    for (const ir::Item& item : proto.items) {
      if (const auto* id = std::get_if<Id<ir::Instance>>(&item.shape)) {
        const std::size_t inner = scene.shape(*id).of.value();
        if (inner < depths.size()) depth = std::max(depth, depths[inner] + 1);
      }
    }
    depths.push_back(depth);
  }
  return depths;
}

void warn_emission(const ir::Scene& scene, const MaterialFacts& facts, const ir::Item& item,
                   DiagnosticSink& sink) {
  const bool plane = std::holds_alternative<Id<ir::Plane>>(item.shape);
  if (!plane && !std::holds_alternative<Id<ir::Revolve>>(item.shape)) return;
  if (!item.material.valid() || !facts.emissive(item.material)) return;
  sink.report(
      Diagnostic(DiagnosticKind::emission_found_by_chance, span_of(scene, item),
                 std::string(plane ? "this plane is unbounded" : "this surface of revolution") +
                     (plane ? " and emits light: " : " emits light: ") +
                     "paths find it by chance only, so the picture will be noisy")
          .hint("use a quad, disk or sphere light for what shall light the scene"));
}

// As many triangles as one tessellated surface may be made of: about 2 GiB with its tree.
constexpr std::uint64_t max_tessellated_faces = 16'777'216;

void check_tessellation(const ir::Scene& scene, const ir::Item& item, DiagnosticSink& sink) {
  const auto* id = std::get_if<Id<ir::Revolve>>(&item.shape);
  if (id == nullptr) return;
  const ir::Revolve& revolve = scene.shape(*id);
  if (revolve.solver != ir::RevolveSolver::tessellated) return;
  const std::uint64_t faces =
      tessellated_face_count(revolve_of(revolve), static_cast<std::uint32_t>(revolve.steps));
  if (faces <= max_tessellated_faces) return;
  sink.report(Diagnostic(DiagnosticKind::out_of_range, span_of(scene, item),
                         "`steps` is " + std::to_string(revolve.steps) + ", which makes " +
                             std::to_string(faces) + " triangles of this profile; at most " +
                             std::to_string(max_tessellated_faces) + " are made")
                  .hint("`solver = .certified` meets the surface itself"));
}

}  // namespace

void check_items(const ir::Scene& scene, DiagnosticSink& sink) {
  const std::vector<std::uint32_t> depths = depths_of_protos(scene);
  const MaterialFacts facts(scene);
  const auto check = [&](const ir::Item& item) {
    warn_emission(scene, facts, item, sink);
    check_tessellation(scene, item, sink);
    const auto* id = std::get_if<Id<ir::Instance>>(&item.shape);
    if (id == nullptr) return;
    const std::uint32_t depth = depths[scene.shape(*id).of.value()] + 1;
    if (depth <= Hit::max_instances) return;
    sink.report(Diagnostic(DiagnosticKind::instances_nested_too_deep, span_of(scene, item),
                           "instances are nested " + std::to_string(depth) + " deep; at most " +
                               std::to_string(Hit::max_instances) + " levels can be traced"));
  };
  for (const ir::Item& item : scene.items) check(item);
  for (const ir::Proto& proto : scene.protos) {
    for (const ir::Item& item : proto.items) {
      warn_emission(scene, facts, item, sink);
      check_tessellation(scene, item, sink);
    }
  }
}

}  // namespace scenec::backend
