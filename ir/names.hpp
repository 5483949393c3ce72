// Which declarations a dump prints and what it calls them: the author's names, `ns.x` as `ns_x`, a
// number behind a name that is taken.
#pragma once

#include <set>
#include <string>
#include <vector>

#include "ir/scene.hpp"

namespace scenec::ir {

class DumpNames {
 public:
  explicit DumpNames(const Scene& scene);

  // In table order, so that what is referred to comes first.
  [[nodiscard]] const std::vector<MaterialId>& used_materials() const { return used_materials_; }
  [[nodiscard]] const std::vector<ProtoId>& used_protos() const { return used_protos_; }
  [[nodiscard]] const std::string& of(MaterialId id) const { return material_names_[id.value()]; }
  [[nodiscard]] const std::string& of(ProtoId id) const { return proto_names_[id.value()]; }
  [[nodiscard]] const std::string& of(CameraId id) const { return camera_names_[id.value()]; }

 private:
  void use_items(const Scene& scene, const std::vector<Item>& items,
                 std::set<MaterialId>& materials, std::set<ProtoId>& protos);

  std::vector<MaterialId> used_materials_;
  std::vector<ProtoId> used_protos_;
  std::vector<std::string> material_names_;
  std::vector<std::string> proto_names_;
  std::vector<std::string> camera_names_;
};

}  // namespace scenec::ir
