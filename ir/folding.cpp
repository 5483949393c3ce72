#include "ir/folding.hpp"

namespace scenec::ir {

// Only what folds without a rounding of its own is folded, so that a kernel without textures and
// one with them see the same bits.
std::optional<Folding::Value> Folding::texture(TextureId id) const {
  const TextureKind& kind = scene_.textures[id].kind;
  if (const auto* t = std::get_if<ConstantTexture>(&kind)) return Value{t->color, 1};
  if (const auto* t = std::get_if<CheckerTexture>(&kind)) {
    const std::optional<Color> a = color(t->a);
    if (!a || a != color(t->b)) return std::nullopt;
    return Value{*a, 1};
  }
  if (const auto* t = std::get_if<GridTexture>(&kind)) {
    const std::optional<Color> line = color(t->line);
    if (!line || line != color(t->fill)) return std::nullopt;
    return Value{*line, 1};
  }
  if (const auto* t = std::get_if<RampTexture>(&kind)) {
    if (t->stops.size() != 1) return std::nullopt;
    return Value{t->stops.front().second, 1};
  }
  if (const auto* t = std::get_if<ProductTexture>(&kind)) {
    const std::optional<Color> a = color(t->a);
    const std::optional<Color> b = color(t->b);
    // Black times anything finite is black, whatever the other factor does.
    if (a == black || b == black) return Value{black, 1};
    if (!a || !b) return std::nullopt;
    return Value{{a->r * b->r, a->g * b->g, a->b * b->b}, 1};
  }
  if (const auto* t = std::get_if<MixTexture>(&kind)) {
    const std::optional<double> weight = number(t->t);
    if (!weight) return std::nullopt;
    if (*weight == 0 || *weight == 1) {
      const std::optional<Color> shown = color(*weight == 0 ? t->a : t->b);
      if (!shown) return std::nullopt;
      return Value{*shown, 1};
    }
    return std::nullopt;
  }
  if (const auto* t = std::get_if<ChannelTexture>(&kind)) {
    const bool opaque_image = [&] {
      const auto* image = std::get_if<ImageTexture>(&scene_.textures[t->source].kind);
      return t->channel == Channel::alpha && image != nullptr &&
             image->file.value() < images_.size() && images_[image->file.value()].opaque;
    }();
    if (opaque_image) return Value{white, 1};
    const std::optional<Value> source = texture(t->source);
    if (!source) return std::nullopt;
    switch (t->channel) {
      case Channel::r:
        return Value{{source->color.r, source->color.r, source->color.r}, 1};
      case Channel::g:
        return Value{{source->color.g, source->color.g, source->color.g}, 1};
      case Channel::b:
        return Value{{source->color.b, source->color.b, source->color.b}, 1};
      case Channel::alpha:
        return Value{{source->alpha, source->alpha, source->alpha}, 1};
    }
  }
  return std::nullopt;  // images and fractals vary
}

std::optional<Color> Folding::color(const ColorInput& input) const {
  if (!input.texture.valid()) return input.value;
  const std::optional<Value> value = texture(input.texture);
  if (!value) return std::nullopt;
  return value->color;
}

std::optional<double> Folding::number(const NumberInput& input) const {
  if (!input.texture.valid()) return input.value;
  const std::optional<Value> value = texture(input.texture);
  if (!value) return std::nullopt;
  return value->color.r;
}

}  // namespace scenec::ir
