#include "backend/textures/texture.hpp"

#include <algorithm>
#include <cmath>

#include "backend/math/rng.hpp"
#include "backend/textures/pyramid.hpp"

namespace scenec::backend {
namespace {

TextureValue mixed(const Rgb& a, const Rgb& b, double t) {
  return {a * (1 - t) + b * t, 1};
}

double gradient(std::uint64_t hash, double x, double y) {
  // Eight directions, as in Perlin's improved noise in the plane.
  constexpr double diagonal = 0.70710678118654752440;
  constexpr double gx[8] = {1, -1, 0, 0, diagonal, -diagonal, diagonal, -diagonal};
  constexpr double gy[8] = {0, 0, 1, -1, diagonal, diagonal, -diagonal, -diagonal};
  const std::size_t i = hash & 7U;
  return gx[i] * x + gy[i] * y;
}

double fade(double t) {
  return t * t * t * (t * (t * 6 - 15) + 10);
}

// The fraction of x within its unit cell, 0 for what is not finite.
double cell_fraction(double x) {
  const double f = x - std::floor(x);
  return std::isfinite(f) ? f : 0;
}

bool odd_cell(double x) {
  const double half = x / 2;
  return std::isfinite(half) && half - std::floor(half) >= 0.5;
}

TextureValue ramp(const ir::RampTexture& ramp, double t) {
  const auto color = [](const ir::Color& c) { return Rgb(c.r, c.g, c.b); };
  if (ramp.stops.empty()) return {};
  if (!(t > ramp.stops.front().first)) return {color(ramp.stops.front().second), 1};
  for (std::size_t i = 1; i < ramp.stops.size(); ++i) {
    if (t < ramp.stops[i].first) {
      const double low = ramp.stops[i - 1].first;
      const double width = ramp.stops[i].first - low;
      return mixed(color(ramp.stops[i - 1].second), color(ramp.stops[i].second), (t - low) / width);
    }
  }
  return {color(ramp.stops.back().second), 1};
}

double fractal(const ir::FractalTexture& texture, Sample2 uv) {
  double sum = 0;
  double amplitude = 1;
  double total = 0;
  double frequency = texture.scale;
  for (std::int64_t octave = 0; octave < texture.octaves; ++octave) {
    sum += amplitude * gradient_noise(uv.u * frequency, uv.v * frequency);
    total += amplitude;
    amplitude /= 2;
    frequency *= 2;
  }
  return total > 0 ? std::clamp(0.5 + 0.5 * sum / total, 0.0, 1.0) : 0.5;
}

Rgb single_channel(const TextureValue& value, ir::Channel channel) {
  switch (channel) {
    case ir::Channel::r:
      return Rgb::gray(value.color.r);
    case ir::Channel::g:
      return Rgb::gray(value.color.g);
    case ir::Channel::b:
      return Rgb::gray(value.color.b);
    case ir::Channel::alpha:
      return Rgb::gray(value.alpha);
  }
  return {};
}

// Whether whole numbers are to be decoded.
bool has_curve(const ir::ImageTexture& texture, const DecodedImage& image, TextureUse use) {
  const bool eight_bits = image.encoding == SampleEncoding::srgb;
  return texture.encoding == ir::Encoding::srgb ||
         (texture.encoding == ir::Encoding::automatic && eight_bits && use == TextureUse::color);
}

}  // namespace

double gradient_noise(double x, double y) {
  const double fx = std::floor(x);
  const double fy = std::floor(y);
  // Beyond 2^52 every double is whole, where the noise is 0.
  if (!(std::fabs(fx) < 0x1p52) || !(std::fabs(fy) < 0x1p52)) return 0;
  const auto ix = static_cast<std::int64_t>(fx);
  const auto iy = static_cast<std::int64_t>(fy);
  const double dx = x - fx;
  const double dy = y - fy;
  const auto corner = [&](std::int64_t cx, std::int64_t cy) {
    const std::uint64_t hash = mix_bits(mix_bits(static_cast<std::uint64_t>(ix + cx)) +
                                        static_cast<std::uint64_t>(iy + cy));
    return gradient(hash >> 32, dx - static_cast<double>(cx), dy - static_cast<double>(cy));
  };
  const double u = fade(dx);
  const double v = fade(dy);
  const double low = corner(0, 0) * (1 - u) + corner(1, 0) * u;
  const double high = corner(0, 1) * (1 - u) + corner(1, 1) * u;
  // Gradient noise in the plane reaches sqrt(1/2); scaled to [-1, 1].
  return std::clamp((low * (1 - v) + high * v) * 1.41421356237309504880, -1.0, 1.0);
}

TextureEvaluator::TextureEvaluator(const ir::Scene& scene,
                                   const std::vector<std::shared_ptr<const DecodedImage>>& images)
    : scene_(&scene), images_(&images) {
  for (const ir::TextureNode& node : scene.textures) {
    const auto* texture = std::get_if<ir::ImageTexture>(&node.kind);
    if (texture == nullptr || texture->filter != ir::TextureFilter::trilinear) continue;
    const auto& decoded = images[texture->file.value()];
    if (!decoded) continue;
    Pyramids& pyramids = pyramids_[texture->file];
    for (const TextureUse use : {TextureUse::color, TextureUse::data}) {
      const bool srgb = has_curve(*texture, *decoded, use);
      auto& slot = srgb ? pyramids.srgb : pyramids.linear;
      if (!slot) slot = std::make_unique<const Pyramid>(*decoded, srgb);
    }
  }
}
std::uint64_t TextureEvaluator::memory() const {
  std::uint64_t bytes = 0;
  for (const auto& [asset, pyramids] : pyramids_) {
    for (const Pyramid* one : {pyramids.srgb.get(), pyramids.linear.get()})
      bytes += one != nullptr ? one->memory() : 0;
  }
  return bytes;
}

TextureEvaluator::~TextureEvaluator() = default;

TextureValue TextureEvaluator::image(const ir::ImageTexture& texture, const TexturePlace& at,
                                     TextureUse use) const {
  const auto& decoded = (*images_)[texture.file.value()];
  if (!decoded) return {};
  const bool srgb = has_curve(texture, *decoded, use);
  TexturePlace scaled(at.uv.u * texture.scale.x, at.uv.v * texture.scale.y);
  if (texture.filter != ir::TextureFilter::trilinear)
    return lookup(*decoded, scaled.uv, texture.wrap, texture.filter, srgb);
  scaled.width_u = at.width_u * std::fabs(texture.scale.x);
  scaled.width_v = at.width_v * std::fabs(texture.scale.y);
  const Pyramids& pyramids = pyramids_.at(texture.file);
  return (srgb ? pyramids.srgb : pyramids.linear)->lookup(*decoded, scaled, texture.wrap);
}

TextureValue TextureEvaluator::value(ir::TextureId id, const TexturePlace& at,
                                     TextureUse use) const {
  const Sample2 uv = at.uv;
  const ir::TextureKind& kind = scene_->textures[id].kind;
  const auto of = [&](const ir::ColorInput& input) {
    return input.texture.valid() ? value(input.texture, at, use).color
                                 : Rgb(input.value.r, input.value.g, input.value.b);
  };
  if (const auto* t = std::get_if<ir::ImageTexture>(&kind)) return image(*t, at, use);
  if (const auto* t = std::get_if<ir::CheckerTexture>(&kind)) {
    return {of(odd_cell(std::floor(uv.u * t->scale) + std::floor(uv.v * t->scale)) ? t->b : t->a),
            1};
  }
  if (const auto* t = std::get_if<ir::FractalTexture>(&kind))
    return mixed(of(t->a), of(t->b), fractal(*t, uv));
  if (const auto* t = std::get_if<ir::RampTexture>(&kind)) return ramp(*t, number(t->t, at));
  if (const auto* t = std::get_if<ir::GridTexture>(&kind)) {
    const auto on_line = [&](double x) {
      const double f = cell_fraction(x * t->scale);
      return f < t->width / 2 || f > 1 - t->width / 2;
    };
    return {of(on_line(uv.u) || on_line(uv.v) ? t->line : t->fill), 1};
  }
  if (const auto* t = std::get_if<ir::ConstantTexture>(&kind))
    return {{t->color.r, t->color.g, t->color.b}, 1};
  if (const auto* t = std::get_if<ir::ProductTexture>(&kind)) return {of(t->a) * of(t->b), 1};
  if (const auto* t = std::get_if<ir::MixTexture>(&kind))
    return mixed(of(t->a), of(t->b), number(t->t, at));
  const auto& channel = std::get<ir::ChannelTexture>(kind);
  return {single_channel(value(channel.source, at, TextureUse::data), channel.channel), 1};
}

}  // namespace scenec::backend
