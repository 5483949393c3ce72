#include "frontend/course/lobes.hpp"

#include <algorithm>

namespace scenec::frontend::course {

namespace {

Lobes weighted(double diffuse, double mirror, double glass, double glossy) {
  const std::array weights{diffuse, mirror, glass, glossy};
  Lobes lobes;
  double sum = 0;
  for (const double weight : weights) sum += std::max(weight, 0.0);
  if (!(sum > 0)) return {{{LobeKind::diffuse, 1}}, 1};
  for (std::size_t i = 0; i < weights.size(); ++i) {
    if (weights[i] > 0) lobes.list.push_back({static_cast<LobeKind>(i), weights[i]});
  }
  lobes.factor = std::min(sum, 1.0);
  return lobes;
}

Lobes single(LobeKind kind) {
  return {{{kind, 1}}, 1};
}

Lobes lobes_by_number(double number) {
  if (number == 1) return single(LobeKind::mirror);
  if (number == 2) return single(LobeKind::glass);
  return single(LobeKind::diffuse);
}

Lobes lobes_of_type(const Entry& type) {
  if (!type.name.empty()) {
    const int lobe = find_lobe(type.name).value_or(0);
    return lobe == 3 ? single(LobeKind::glossy) : lobes_by_number(lobe);
  }
  if (type.numbers.size() == 1) return lobes_by_number(type.numbers[0].value);
  Lobes lobes = weighted(type.numbers[0].value, type.numbers[1].value, type.numbers[2].value, 0);
  lobes.factor = 1;
  return lobes;
}

double weight_of(const MaterialData& material, Role role) {
  return material.find(role) == nullptr ? 0 : material.value(role, 1);
}

Lobes lobes_of_plain(const MaterialData& material) {
  if (material.find(Role::material_type) != nullptr) {
    const double type = material.value(Role::material_type, 0);
    if (type == 2) return single(LobeKind::glossy);
    if (type == 1) return lobes_by_number(std::min(material.value(Role::surface_type, 0), 2.0));
    return single(LobeKind::phong);
  }
  if (const Entry* const type = material.find(Role::lobe)) return lobes_of_type(*type);
  const Entry* const transparent = material.find(Role::transparent);
  double glass = weight_of(material, Role::weight_glass);
  if (transparent != nullptr && transparent->numbers.empty()) glass = 1;
  if (material.value(Role::refr, 2) <= 1) glass = material.value(Role::refr, 0);
  const bool weights = material.find(Role::weight_diffuse) != nullptr ||
                       material.find(Role::weight_mirror) != nullptr ||
                       material.find(Role::weight_glossy) != nullptr || glass > 0;
  if (weights) {
    return weighted(weight_of(material, Role::weight_diffuse),
                    weight_of(material, Role::weight_mirror), glass,
                    weight_of(material, Role::weight_glossy));
  }
  if (const Entry* const reflection = material.find(Role::reflection);
      reflection != nullptr && reflection->numbers.size() == 1) {
    return lobes_by_number(reflection->numbers[0].value);
  }
  return single(LobeKind::phong);
}

}  // namespace

Lobes lobes_of(const MaterialData& material) {
  switch (material.kind) {
    case Role::material_diffuse:
    case Role::material_light:
      return single(LobeKind::diffuse);
    case Role::material_mirror:
      return single(LobeKind::mirror);
    case Role::material_glass:
      return single(LobeKind::glass);
    case Role::material_glossy:
    case Role::material_metal:
      return single(LobeKind::glossy);
    default:
      return lobes_of_plain(material);
  }
}

}  // namespace scenec::frontend::course
