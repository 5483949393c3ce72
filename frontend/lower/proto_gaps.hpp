// Shapes of a proto with no material of their own and none above them inside the proto. What fills
// such a gap is the group round an instance; a proto so filled is a copy, made once a material.
#pragma once

#include <cstddef>
#include <map>
#include <utility>
#include <vector>

#include "base/span.hpp"
#include "ir/builder.hpp"

namespace scenec::frontend {

class ProtoGaps {
 public:
  explicit ProtoGaps(ir::SceneBuilder& builder) : builder_(builder) {}

  // The body of a proto begins; protos do not nest.
  void begin() { open_ = {}; }
  // Item `index` of the proto being read is a gap. `lint`: the shape to name, or invalid when the
  // author allows it.
  void add(std::size_t index, Span lint);
  void finish(ir::ProtoId proto) { gaps_.insert_or_assign(proto, std::move(open_)); }

  [[nodiscard]] bool any(ir::ProtoId proto) const;
  // The first gap its author did not allow; invalid: none.
  [[nodiscard]] Span lint(ir::ProtoId proto) const;
  // The proto with its gaps made of `material`; itself when it has none.
  [[nodiscard]] ir::ProtoId filled(ir::ProtoId proto, ir::MaterialId material);

 private:
  struct Gaps {
    std::vector<std::size_t> items;
    Span lint;
  };
  ir::SceneBuilder& builder_;
  Gaps open_;
  std::map<ir::ProtoId, Gaps> gaps_;
  std::map<std::pair<ir::ProtoId, ir::MaterialId>, ir::ProtoId> filled_;
};

}  // namespace scenec::frontend
