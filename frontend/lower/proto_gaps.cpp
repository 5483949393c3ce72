#include "frontend/lower/proto_gaps.hpp"

#include <variant>

namespace scenec::frontend {

void ProtoGaps::add(std::size_t index, Span lint) {
  open_.items.push_back(index);
  if (!open_.lint.valid()) open_.lint = lint;
}

bool ProtoGaps::any(ir::ProtoId proto) const {
  const auto found = gaps_.find(proto);
  return found != gaps_.end() && !found->second.items.empty();
}

Span ProtoGaps::lint(ir::ProtoId proto) const {
  const auto found = gaps_.find(proto);
  return found == gaps_.end() ? Span{} : found->second.lint;
}

ir::ProtoId ProtoGaps::filled(ir::ProtoId proto, ir::MaterialId material) {
  if (!any(proto)) return proto;
  const auto [place, added] = filled_.try_emplace({proto, material});
  if (!added) return place->second;
  ir::Proto copy = builder_.scene().protos[proto];
  for (std::size_t index : gaps_.at(proto).items) {
    ir::Item& item = copy.items[index];
    if (const auto* id = std::get_if<Id<ir::Instance>>(&item.shape)) {
      // At most as deep as instances nest, which the order of protos bounds.
      const ir::ProtoId inner = filled(builder_.scene().shape(*id).of, material);
      item.shape = builder_.add_shape(ir::Instance{.of = inner});
    } else {
      item.material = material;
    }
  }
  const ir::Declared declared = builder_.scene().proto_names[proto];
  return filled_[{proto, material}] = builder_.add_proto(std::move(copy), declared);
}

}  // namespace scenec::frontend
