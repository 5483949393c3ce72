#include "backend/probe.hpp"

#include "backend/cameras/camera.hpp"
#include "backend/render_scene.hpp"

namespace scenec::backend {
namespace {

// Items are numbered the world's first, then those of the protos in their order (build_items.cpp).
ProbeResult::Step step_of(const ir::Scene& scene, std::uint32_t number) {
  if (number < scene.items.size()) return {std::nullopt, number};
  std::size_t first = scene.items.size();
  for (std::uint32_t i = 0; i < scene.protos.size(); ++i) {
    const std::size_t count = scene.protos[ir::ProtoId(i)].items.size();
    if (number < first + count) return {ir::ProtoId(i), static_cast<std::uint32_t>(number - first)};
    first += count;
  }
  return {std::nullopt, 0};
}

}  // namespace

std::optional<ProbeResult> probe(const RenderScene& scene, const ir::RenderSettings& settings,
                                 std::int64_t x, std::int64_t y, const ir::Camera* camera) {
  const CameraSampler sampler(camera != nullptr ? *camera : scene.scene->cameras[settings.camera],
                              settings.size, CameraSampler::Lens::left_out);
  const Ray ray =
      sampler.ray(static_cast<double>(x) + 0.5, static_cast<double>(y) + 0.5, Sample2{0.5, 0.5});
  Hit hit;
  if (!scene.accel.intersect(ray, hit)) return std::nullopt;
  ProbeResult result;
  result.distance = hit.t;
  result.point = {hit.point.x, hit.point.y, hit.point.z};
  const Vector3 normal = hit.geometric_normal.vector();
  result.normal = {normal.x, normal.y, normal.z};
  if (scene.items[hit.item].light != RenderItem::none) return result;
  for (std::uint32_t i = 0; i < hit.instance_count; ++i)
    result.path.push_back(step_of(*scene.scene, hit.instances[i]));
  result.path.push_back(step_of(*scene.scene, hit.item));
  result.material = scene.material_of(hit);
  return result;
}

}  // namespace scenec::backend
