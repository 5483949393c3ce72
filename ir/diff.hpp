// What has changed from one scene to the next, by the author's names: which part, and which of its
// keys. Positions, comments and the order of declarations are no changes.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "ir/scene.hpp"

namespace scenec::ir {

struct PartChange {
  enum class What : std::uint8_t { added, removed, changed };
  What what = What::changed;
  std::string family;             // "shape", "material", "light", "camera", "render"
  std::string kind;               // "sphere", "ggx", ...; of both sides unless `keys` says "kind"
  std::string name;               // empty: it has none
  std::size_t count = 1;          // of parts alike: all are `kind`, called `name`, with these keys
  std::vector<std::string> keys;  // of a changed one; "transform" and "material" of a shape too
};

// Parts are paired by name, those without one by their kind and order. Equal parts are none of the
// result, wherever they stand; scenes that differ in the order alone give nothing.
[[nodiscard]] std::vector<PartChange> changes_between(const Scene& before, const Scene& after);

}  // namespace scenec::ir
