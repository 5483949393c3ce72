#include "backend/film/film.hpp"

#include <algorithm>
#include <cmath>

#include "base/packed_bytes.hpp"

namespace scenec::backend {

ir::Region region_of(const ir::RenderSettings& settings) {
  const ir::Region whole{0, 0, settings.size.width, settings.size.height};
  if (!settings.region) return whole;
  const ir::Region& r = *settings.region;
  return {std::clamp<std::int64_t>(r.x0, 0, whole.x1), std::clamp<std::int64_t>(r.y0, 0, whole.y1),
          std::clamp<std::int64_t>(r.x1, 0, whole.x1), std::clamp<std::int64_t>(r.y1, 0, whole.y1)};
}

Film::Film(const ir::RenderSettings& settings, Squares squares)
    : settings_(settings), region_(region_of(settings)), keep_squares_(squares == Squares::yes) {
  width_ = static_cast<std::size_t>(std::max<std::int64_t>(0, region_.x1 - region_.x0));
  height_ = static_cast<std::size_t>(std::max<std::int64_t>(0, region_.y1 - region_.y0));
  for (const ir::Aov aov : settings.aovs) {
    if (aov == ir::Aov::variance) keep_squares_ = true;
    if (aov != ir::Aov::variance && aov != ir::Aov::samples && aov != ir::Aov::trust)
      keep_extra_ = true;
  }
  const std::size_t pixels = width_ * height_;
  total_.resize(pixels);
  round_.resize(pixels);
  if (keep_squares_) {
    total_squares_.resize(pixels);
    round_squares_.resize(pixels);
  }
  if (keep_extra_) {
    total_extra_.resize(pixels);
    round_extra_.resize(pixels);
  }
}

void Film::Sums::merge(const Sums& other) {
  for (int c = 0; c < 3; ++c) rgb[c] += other.rgb[c];
  weight += other.weight;
  count += other.count;
  covered += other.covered;
  hits += other.hits;
}

void Film::Extra::merge(const Extra& other) {
  for (int c = 0; c < 3; ++c) {
    albedo[c] += other.albedo[c];
    normal[c] += other.normal[c];
    position[c] += other.position[c];
  }
  depth += other.depth;
  for (int c = 0; c < 2; ++c) uv[c] += other.uv[c];
  // The first sample that hit something names the pixel's item.
  if (!identified && other.identified) {
    item = other.item;
    material = other.material;
    identified = true;
  }
}

void Film::add(std::size_t x, std::size_t y, const FilmSample& sample) {
  if (!is_finite(sample.radiance)) {
    dropped_.fetch_add(1, std::memory_order_relaxed);
    return;
  }
  const std::size_t pixel = index(x, y);
  Sums& sums = round_[pixel];
  const double channels[3] = {sample.radiance.r, sample.radiance.g, sample.radiance.b};
  bool fits = true;
  for (int c = 0; c < 3; ++c) {
    fits = sums.rgb[c].add(sample.weight * channels[c]) && fits;
    if (keep_squares_)
      round_squares_[pixel].rgb[c].add(
          std::fmin(channels[c] * channels[c], FixedSum::largest_term));
  }
  if (!fits) saturated_.fetch_add(1, std::memory_order_relaxed);
  sums.weight += sample.weight;
  sums.count += 1;
  if (sample.covered) {
    sums.covered += sample.weight;
    sums.hits += 1;
  }
  if (keep_extra_ && sample.first.hit) add_extra(pixel, sample);
}

void Film::add_extra(std::size_t pixel, const FilmSample& sample) {
  Extra& extra = round_extra_[pixel];
  const FirstHit& first = sample.first;
  const double values[3][3] = {{first.albedo.r, first.albedo.g, first.albedo.b},
                               {first.normal.x, first.normal.y, first.normal.z},
                               {first.position.x, first.position.y, first.position.z}};
  for (int c = 0; c < 3; ++c) {
    extra.albedo[c].add(values[0][c]);
    extra.normal[c].add(values[1][c]);
    extra.position[c].add(values[2][c]);
  }
  extra.depth.add(first.depth);
  extra.uv[0].add(first.u);
  extra.uv[1].add(first.v);
  if (!extra.identified) {
    extra.item = first.item;
    extra.material = first.material;
    extra.identified = true;
  }
}

void Film::finish_round(std::int64_t samples, ThreadPool& pool) {
  pool.for_each(height_, [&](std::size_t y, unsigned) {
    for (std::size_t pixel = y * width_; pixel < (y + 1) * width_; ++pixel) {
      total_[pixel].merge(round_[pixel]);
      round_[pixel] = Sums{};
      if (keep_squares_) {
        for (int c = 0; c < 3; ++c) total_squares_[pixel].rgb[c] += round_squares_[pixel].rgb[c];
        round_squares_[pixel] = Squares3{};
      }
      if (keep_extra_) {
        total_extra_[pixel].merge(round_extra_[pixel]);
        round_extra_[pixel] = Extra{};
      }
    }
  });
  samples_ += samples;
}

void Film::drop_round() {
  std::fill(round_.begin(), round_.end(), Sums{});
  std::fill(round_squares_.begin(), round_squares_.end(), Squares3{});
  std::fill(round_extra_.begin(), round_extra_.end(), Extra{});
}

namespace {
// Filters with negative lobes can leave few samples without a positive sum of weights.
double divisor(std::int32_t weight, std::int32_t count) {
  return weight > 0 ? static_cast<double>(weight) : static_cast<double>(std::max(count, 1));
}
}  // namespace

double Film::estimated_error() const {
  double luminance_sum = 0;
  for (const Sums& s : total_) {
    const double d = divisor(s.weight, s.count);
    luminance_sum += luminance({s.rgb[0].value() / d, s.rgb[1].value() / d, s.rgb[2].value() / d});
  }
  const double mean_luminance =
      luminance_sum / static_cast<double>(std::max<std::size_t>(1, total_.size()));
  const double epsilon = 0.01 * mean_luminance * mean_luminance;
  double sum = 0;
  for (std::size_t i = 0; i < total_.size(); ++i) {
    const double n = static_cast<double>(total_[i].count);
    if (n < 2) continue;
    for (int c = 0; c < 3; ++c) {
      const double mean = total_[i].rgb[c].value() / divisor(total_[i].weight, total_[i].count);
      const double variance =
          std::fmax(0, total_squares_[i].rgb[c].value() / n - mean * mean) / (n - 1);
      const double scale = mean * mean + epsilon;
      if (scale > 0) sum += variance / scale;
    }
  }
  return std::sqrt(sum / (3 * static_cast<double>(std::max<std::size_t>(1, total_.size()))));
}

ErrorEstimate Film::error() const {
  if (samples_ < 2) return {};
  const double error = estimated_error();
  return {true, error, error, error};
}

std::string Film::save() const {
  std::string out;
  append_packed(out, samples_);
  append_packed(out, dropped_.load());
  append_packed(out, saturated_.load());
  out += packed_bytes_of(total_);
  out += packed_bytes_of(total_squares_);
  out += packed_bytes_of(total_extra_);
  return out;
}

bool Film::restore(std::string_view bytes) {
  PackedReader reader(bytes);
  const auto samples = reader.value<std::int64_t>();
  const auto dropped = reader.value<std::uint64_t>();
  const auto saturated = reader.value<std::uint64_t>();
  auto total = reader.list<std::vector<Sums>>(total_.size());
  auto squares = reader.list<std::vector<Squares3>>(total_squares_.size());
  auto extra = reader.list<std::vector<Extra>>(total_extra_.size());
  if (!reader.at_end() || samples < 0) return false;
  drop_round();
  samples_ = samples;
  dropped_ = dropped;
  saturated_ = saturated;
  total_ = std::move(total);
  total_squares_ = std::move(squares);
  total_extra_ = std::move(extra);
  return true;
}

Picture Film::picture() const {
  Picture picture;
  picture.width = static_cast<int>(width_);
  picture.height = static_cast<int>(height_);
  picture.rgb.resize(3 * total_.size());
  picture.alpha.resize(total_.size());
  for (std::size_t i = 0; i < total_.size(); ++i) {
    const Sums& s = total_[i];
    const double d = divisor(s.weight, s.count);
    for (std::size_t c = 0; c < 3; ++c)
      picture.rgb[3 * i + c] = static_cast<float>(s.rgb[c].value() / d);
    picture.alpha[i] = static_cast<float>(std::clamp(static_cast<double>(s.covered) / d, 0.0, 1.0));
  }
  picture.samples = samples_;
  picture.dropped_samples = dropped_.load();
  append_layers(picture);
  return picture;
}

}  // namespace scenec::backend
