#include "backend/lights/environment.hpp"

#include <algorithm>
#include <cmath>

#include "backend/textures/texture.hpp"
#include "base/elementary.hpp"

namespace scenec::backend {
namespace {

struct Step {
  std::size_t index = 0;
  double within = 0;
  double mass = 0;
};

// The step of a cumulative table (from 0 to 1) that u falls into.
Step find_step(const double* cumulative, std::size_t count, double u) {
  const double* above = std::upper_bound(cumulative + 1, cumulative + count, u);
  const auto index = static_cast<std::size_t>(above - cumulative) - 1;
  const double mass = cumulative[index + 1] - cumulative[index];
  return {index, mass > 0 ? std::clamp((u - cumulative[index]) / mass, 0.0, 1.0) : 0.5, mass};
}

double accumulate_and_normalise(double* cumulative, std::size_t count) {
  for (std::size_t i = 0; i < count; ++i) cumulative[i + 1] += cumulative[i];
  const double sum = cumulative[count];
  if (sum > 0) {
    for (std::size_t i = 0; i <= count; ++i) cumulative[i] /= sum;
  }
  return sum;
}

}  // namespace

Environment::Environment(const ir::EnvironmentLight& light,
                         std::shared_ptr<const DecodedImage> image)
    : image_(std::move(image)) {
  factor_ = Rgb(light.color.r, light.color.g, light.color.b) * light.gain;
  if (light.constant) factor_ *= Rgb(light.constant->r, light.constant->g, light.constant->b);
  const SinCos turn = sin_cos(light.rotation.value);
  turn_sin_ = turn.sin;
  turn_cos_ = turn.cos;
  mean_ = factor_;
  if (image_) {
    srgb_ = image_->encoding == SampleEncoding::srgb;
    build_tables();
  }
}

void Environment::build_tables() {
  width_ = image_->width;
  height_ = image_->height;
  rows_.assign(height_ + 1, 0);
  columns_.assign(height_ * (width_ + 1), 0);
  std::vector<double> bright(width_ * height_);
  Rgb sum;
  double sines = 0;
  for (std::size_t y = 0; y < height_; ++y) {
    const double sine = sin(pi * (static_cast<double>(y) + 0.5) / static_cast<double>(height_));
    for (std::size_t x = 0; x < width_; ++x) {
      const Rgb c =
          texel(*image_, static_cast<std::int64_t>(x), static_cast<std::int64_t>(y), srgb_).color;
      bright[y * width_ + x] = std::fmax(0, luminance(c * factor_));
      sum += c * sine;
    }
    sines += sine * static_cast<double>(width_);
  }
  mean_ = sum / sines * factor_;
  for (std::size_t y = 0; y < height_; ++y) {
    const double sine = sin(pi * (static_cast<double>(y) + 0.5) / static_cast<double>(height_));
    double* row = &columns_[y * (width_ + 1)];
    for (std::size_t x = 0; x < width_; ++x) {
      double largest = 0;
      for (std::size_t dy = y == 0 ? 0 : y - 1; dy <= std::min(y + 1, height_ - 1); ++dy) {
        for (const std::size_t dx : {(x + width_ - 1) % width_, x, (x + 1) % width_}) {
          largest = std::fmax(largest, bright[dy * width_ + dx]);
        }
      }
      row[x + 1] = largest * sine;
    }
    rows_[y + 1] = accumulate_and_normalise(row, width_);
  }
  if (!(accumulate_and_normalise(rows_.data(), height_) > 0)) rows_.clear();
}

Sample2 Environment::uv_of(const Vector3& d) const {
  // Turned back about +y by the light's rotation.
  const double x = d.x * turn_cos_ - d.z * turn_sin_;
  const double z = d.x * turn_sin_ + d.z * turn_cos_;
  const double horizontal = std::sqrt(x * x + z * z);
  return {0.5 + atan2(x, -z) / (2 * pi), 0.5 + atan2(d.y, horizontal) / pi};
}

Rgb Environment::radiance(const Vector3& direction) const {
  if (!image_) return factor_;
  // Repeats sideways; the poles' rows must not wrap to each other.
  Sample2 uv = uv_of(direction);
  const double half = 0.5 / static_cast<double>(height_);
  uv.v = std::clamp(uv.v, half, 1 - half);
  return lookup(*image_, uv, ir::Wrap::repeat, ir::TextureFilter::bilinear, srgb_).color * factor_;
}

Environment::Choice Environment::sample(Sample2 u) const {
  if (!image_) return {sample_uniform_sphere(u), pdf_uniform_sphere()};
  if (rows_.empty()) return {};
  const Step row = find_step(rows_.data(), height_, u.v);
  const Step column = find_step(&columns_[row.index * (width_ + 1)], width_, u.u);
  const double across =
      (static_cast<double>(column.index) + column.within) / static_cast<double>(width_);
  const double down = (static_cast<double>(row.index) + row.within) / static_cast<double>(height_);
  const SinCos azimuth = sin_cos_of_turns(across - 0.5);
  const SinCos polar = sin_cos_of_turns(0.5 * down);
  const double x = polar.sin * azimuth.sin;
  const double z = -polar.sin * azimuth.cos;
  const Vector3 d{x * turn_cos_ + z * turn_sin_, polar.cos, z * turn_cos_ - x * turn_sin_};
  if (!(polar.sin > 0)) return {};
  const double cells = static_cast<double>(width_) * static_cast<double>(height_);
  return {normalized(d), row.mass * column.mass * cells / (2 * pi * pi * polar.sin)};
}

double Environment::pdf(const Vector3& direction) const {
  if (!image_) return pdf_uniform_sphere();
  if (rows_.empty()) return 0;
  const Sample2 uv = uv_of(direction);
  const auto index = [](double t, std::size_t n) {
    return std::min(static_cast<std::size_t>(std::clamp(t, 0.0, 1.0) * static_cast<double>(n)),
                    n - 1);
  };
  const std::size_t y = index(1 - uv.v, height_);
  const std::size_t x = index(uv.u, width_);
  const double* row = &columns_[y * (width_ + 1)];
  const double sine = std::sqrt(direction.x * direction.x + direction.z * direction.z);
  if (!(sine > 0)) return 0;
  const double cells = static_cast<double>(width_) * static_cast<double>(height_);
  return (rows_[y + 1] - rows_[y]) * (row[x + 1] - row[x]) * cells / (2 * pi * pi * sine);
}

}  // namespace scenec::backend
