// What the inputs of materials come to when they do not vary: textures whose every place has the
// same value fold to it.
#pragma once

#include <optional>
#include <vector>

#include "ir/scene.hpp"

namespace scenec::ir {

// What reading an image has shown; without it an image counts as varying.
struct ImageFact {
  bool opaque = false;  // no texel has an alpha below 1
};
// By asset; may be shorter than the table of assets.
using ImageFacts = std::vector<ImageFact>;

class Folding {
 public:
  explicit Folding(const Scene& scene, const ImageFacts& images = {})
      : scene_(scene), images_(images) {}

  // The value everywhere, or nothing when it can vary.
  [[nodiscard]] std::optional<Color> color(const ColorInput& input) const;
  [[nodiscard]] std::optional<double> number(const NumberInput& input) const;

  [[nodiscard]] bool is_black(const ColorInput& input) const {
    const std::optional<Color> c = color(input);
    return c && *c == black;
  }
  [[nodiscard]] bool is(const NumberInput& input, double value) const {
    const std::optional<double> n = number(input);
    return n && *n == value;
  }

 private:
  struct Value {
    Color color;
    double alpha = 1;
  };
  [[nodiscard]] std::optional<Value> texture(TextureId id) const;

  const Scene& scene_;
  const ImageFacts& images_;
};

}  // namespace scenec::ir
