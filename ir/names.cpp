#include "ir/names.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>

namespace scenec::ir {
namespace {

// Functions the dump itself writes: a material of that name would hide them.
constexpr std::array<std::string_view, 17> functions_used{
    "rgb",  "image",  "checker",  "fractal",  "ramp",           "grid",
    "mix",  "matrix", "polyline", "bezier",   "beziers",        "bspline",
    "tent", "box",    "gaussian", "mitchell", "blackman_harris"};

std::string unique_name(std::string wanted, std::set<std::string>& taken) {
  std::replace(wanted.begin(), wanted.end(), '.', '_');
  std::string name = wanted;
  for (int i = 2; !taken.insert(name).second; ++i) name = fmt::format("{}_{}", wanted, i);
  return name;
}

template <class T>
std::string written_name(const Scene& scene, const Table<Declared, T>& table, Id<T> id,
                         std::string_view fallback) {
  const NameId name = table[id].name;
  return name.valid() ? scene.names[name] : std::string(fallback);
}

}  // namespace

DumpNames::DumpNames(const Scene& scene)
    : material_names_(scene.materials.size()),
      proto_names_(scene.protos.size()),
      camera_names_(scene.cameras.size()) {
  std::set<MaterialId> materials;
  std::set<ProtoId> protos;
  use_items(scene, scene.items, materials, protos);
  // Protos refer to earlier protos and mixes to earlier materials: one pass from the back finds
  // all.
  for (std::size_t i = scene.protos.size(); i-- > 0;) {
    const ProtoId id(static_cast<std::uint32_t>(i));
    if (protos.contains(id)) use_items(scene, scene.protos[id].items, materials, protos);
  }
  for (std::size_t i = scene.materials.size(); i-- > 0;) {
    const MaterialId id(static_cast<std::uint32_t>(i));
    const auto* mix = std::get_if<Mix>(&scene.materials[id].kind);
    if (mix != nullptr && materials.contains(id)) materials.insert({mix->a, mix->b});
  }
  std::copy(materials.begin(), materials.end(), std::back_inserter(used_materials_));
  std::copy(protos.begin(), protos.end(), std::back_inserter(used_protos_));

  std::set<std::string> taken(functions_used.begin(), functions_used.end());
  for (MaterialId id : used_materials_) {
    material_names_[id.value()] =
        unique_name(written_name(scene, scene.material_names, id, "plain"), taken);
  }
  for (ProtoId id : used_protos_) {
    proto_names_[id.value()] =
        unique_name(written_name(scene, scene.proto_names, id, "part"), taken);
  }
  std::set<std::string> cameras;
  for (std::uint32_t i = 0; i < scene.cameras.size(); ++i) {
    camera_names_[i] =
        unique_name(written_name(scene, scene.camera_names, CameraId(i), "camera_1"), cameras);
  }
}

void DumpNames::use_items(const Scene& scene, const std::vector<Item>& items,
                          std::set<MaterialId>& materials, std::set<ProtoId>& protos) {
  for (const Item& item : items) {
    if (item.material.valid()) materials.insert(item.material);
    if (const auto* instance = std::get_if<Id<Instance>>(&item.shape))
      protos.insert(scene.shape(*instance).of);
  }
}

}  // namespace scenec::ir
