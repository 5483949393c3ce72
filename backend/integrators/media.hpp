// The bodies a path is in, and what an interface between them means for it. The body entered last
// is the one the path is in: where two overlap, the boundary of the other one is passed unseen, so
// a liquid that reaches a little into its glass and one that fits it exactly look the same.
//
// Domain:     clear bodies with closed surfaces; up to eight round a place.
// Method:     a stack of what was entered and not left (a priority stack whose priority is the
//             order of entering).
// Degenerate: a body that is left without having been entered (the path began inside) borders on
//             the innermost known one; beyond eight the outermost is forgotten, and counted.
// Proof:      tests/unit/backend/nested_media_test.cpp (S15).
#pragma once

#include <array>
#include <cstdint>
#include <optional>

#include "ir/scene.hpp"

namespace scenec::backend {

class MediumStack {
 public:
  struct Body {
    ir::MaterialId material;
    double ior = 1;
  };

  MediumStack() : count_(0) {}  // the places are of no meaning until taken

  // `nested`: bodies may lie in each other; else the one that is entered is the only one. False
  // when the outermost had to be forgotten.
  bool enter(ir::MaterialId material, double ior, bool nested) {
    if (!nested) count_ = 0;
    const bool fits = count_ < bodies_.size();
    if (!fits) {
      for (std::size_t i = 1; i < bodies_.size(); ++i) bodies_[i - 1] = bodies_[i];
      --count_;
    }
    bodies_[count_++] = {material, ior};
    return fits;
  }
  void leave(ir::MaterialId material) {
    for (std::size_t i = count_; i-- > 0;) {
      if (bodies_[i].material != material) continue;
      for (std::size_t j = i + 1; j < count_; ++j) bodies_[j - 1] = bodies_[j];
      --count_;
      return;
    }
  }
  [[nodiscard]] bool empty() const { return count_ == 0; }
  [[nodiscard]] ir::MaterialId innermost() const { return bodies_[count_ - 1].material; }

  // The index behind the surface over the one before it; nothing when a body is left that another
  // one hides. Precondition: the bodies may lie in each other.
  [[nodiscard]] std::optional<double> relative_ior(ir::MaterialId material, double ior,
                                                   bool entering) const {
    if (entering) return ior / outer_ior(count_);
    for (std::size_t i = count_; i-- > 0;) {
      if (bodies_[i].material != material) continue;
      if (i + 1 != count_) return std::nullopt;
      return outer_ior(i) / ior;
    }
    return outer_ior(count_) / ior;
  }

 private:
  // Of what the first `count` bodies leave one in.
  [[nodiscard]] double outer_ior(std::size_t count) const {
    return count == 0 ? 1 : bodies_[count - 1].ior;
  }

  std::array<Body, 8> bodies_;
  std::size_t count_;
};

}  // namespace scenec::backend
