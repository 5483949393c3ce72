#include "backend/film/film.hpp"

#include <algorithm>
#include <cmath>

namespace scenec::backend {

ir::Region region_of(const ir::RenderSettings& settings) {
  const ir::Region whole{0, 0, settings.size.width, settings.size.height};
  if (!settings.region) return whole;
  const ir::Region& r = *settings.region;
  return {std::clamp<std::int64_t>(r.x0, 0, whole.x1), std::clamp<std::int64_t>(r.y0, 0, whole.y1),
          std::clamp<std::int64_t>(r.x1, 0, whole.x1), std::clamp<std::int64_t>(r.y1, 0, whole.y1)};
}

Film::Film(const ir::RenderSettings& settings) : settings_(settings), region_(region_of(settings)) {
  width_ = static_cast<std::size_t>(std::max<std::int64_t>(0, region_.x1 - region_.x0));
  height_ = static_cast<std::size_t>(std::max<std::int64_t>(0, region_.y1 - region_.y0));
  const auto needs_hits = [](ir::Aov aov) {
    return aov != ir::Aov::variance && aov != ir::Aov::samples && aov != ir::Aov::trust;
  };
  const std::size_t pixels = width_ * height_;
  sums_.resize(pixels);
  if (settings.film != ir::FilmKind::course) replicates_.resize(pixels);
  if (std::any_of(settings.aovs.begin(), settings.aovs.end(), needs_hits)) extra_.resize(pixels);
  if (std::find(settings.aovs.begin(), settings.aovs.end(), ir::Aov::trust) != settings.aovs.end())
    distrust_.resize(pixels);
}

Film::Pixel Film::open(std::size_t x, std::size_t y) {
  Pixel pixel;
  pixel.film_ = this;
  pixel.index_ = y * width_ + x;
  pixel.sums_ = sums_.at(pixel.index_);
  if (keeps_replicates()) pixel.replicates_ = replicates_.at(pixel.index_);
  if (extra_.kept()) extra_.next[pixel.index_] = extra_.at(pixel.index_);
  if (distrust_.kept()) distrust_.next[pixel.index_] = distrust_.at(pixel.index_);
  return pixel;
}

void Film::Pixel::add(std::int64_t number, const FilmSample& sample) {
  if (sample.first.uncertified && film_->distrust_.kept())
    ++film_->distrust_.next[index_].uncertified;
  if (!is_finite(sample.radiance)) {
    film_->refused_.dropped.fetch_add(1, std::memory_order_relaxed);
    if (film_->distrust_.kept()) ++film_->distrust_.next[index_].dropped;
    return;
  }
  const double channels[3] = {sample.weight * sample.radiance.r, sample.weight * sample.radiance.g,
                              sample.weight * sample.radiance.b};
  bool fits = true;
  for (std::size_t c = 0; c < 3; ++c) fits = sums_.rgb[c].add(channels[c]) && fits;
  if (!fits) {
    film_->refused_.saturated.fetch_add(1, std::memory_order_relaxed);
    if (film_->distrust_.kept()) ++film_->distrust_.next[index_].saturated;
  }
  const auto replicate = static_cast<std::size_t>(number) % replicate_count;
  if (replicate < replicates_.rgb.size()) {
    for (std::size_t c = 0; c < 3; ++c)
      replicates_.rgb[replicate][c] +=
          std::clamp(channels[c], -FixedSum::largest_term, FixedSum::largest_term);
    replicates_.weight[replicate] += sample.weight;
  }
  sums_.weight += sample.weight;
  sums_.count += 1;
  if (sample.covered) {
    sums_.covered += sample.weight;
    sums_.hits += 1;
  }
  if (sample.first.hit && film_->extra_.kept())
    film_->add_extra(film_->extra_.next[index_], sample);
}

void Film::Pixel::close() {
  film_->sums_.next[index_] = sums_;
  if (film_->keeps_replicates()) film_->replicates_.next[index_] = replicates_;
}

void Film::add_extra(Extra& extra, const FilmSample& sample) const {
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
  // The first sample that hit something names the pixel's item.
  if (!extra.identified) {
    extra.item = first.item;
    extra.material = first.material;
    extra.identified = true;
  }
}

void Film::begin_round() {
  sums_.open_next();
  replicates_.open_next();
  extra_.open_next();
  distrust_.open_next();
}

void Film::finish_round(std::int64_t samples) {
  sums_.swap();
  replicates_.swap();
  extra_.swap();
  distrust_.swap();
  dropped_ += refused_.dropped.exchange(0);
  saturated_ += refused_.saturated.exchange(0);
  samples_ += samples;
}

void Film::drop_round() {
  refused_.dropped = 0;
  refused_.saturated = 0;
}

namespace {
// Filters with negative lobes can leave few samples without a positive sum of weights.
double divisor(std::int32_t weight, std::int32_t count) {
  return weight > 0 ? static_cast<double>(weight) : static_cast<double>(std::max(count, 1));
}
}  // namespace

Rgb Film::mean(std::size_t pixel) const {
  const PixelSums& s = sums_.at(pixel);
  const double d = divisor(s.weight, s.count);
  return {s.rgb[0].value() / d, s.rgb[1].value() / d, s.rgb[2].value() / d};
}

std::optional<ReplicateMeans> Film::replicate_means(std::size_t pixel) const {
  if (!keeps_replicates()) return std::nullopt;
  const PixelSums& sums = sums_.at(pixel);
  const ReplicateSums& parts = replicates_.at(pixel);
  ReplicateMeans means{};
  std::array<double, 3> rest{sums.rgb[0].value(), sums.rgb[1].value(), sums.rgb[2].value()};
  std::int32_t weight_left = sums.weight;
  for (std::size_t r = 0; r + 1 < replicate_count; ++r) {
    if (parts.weight[r] <= 0) return std::nullopt;
    for (std::size_t c = 0; c < 3; ++c) {
      means[r][c] = parts.rgb[r][c] / parts.weight[r];
      rest[c] -= parts.rgb[r][c];
    }
    weight_left -= parts.weight[r];
  }
  if (weight_left <= 0) return std::nullopt;
  for (std::size_t c = 0; c < 3; ++c) means.back()[c] = rest[c] / weight_left;
  return means;
}

std::uint64_t Film::memory() const {
  return sums_.memory() + replicates_.memory() + extra_.memory() + distrust_.memory();
}

std::string Film::save() const {
  std::string out;
  append_packed(out, samples_);
  append_packed(out, dropped_);
  append_packed(out, saturated_);
  sums_.pack(out);
  replicates_.pack(out);
  extra_.pack(out);
  distrust_.pack(out);
  return out;
}

bool Film::restore(std::string_view bytes) {
  PackedReader reader(bytes);
  const auto samples = reader.value<std::int64_t>();
  const auto dropped = reader.value<std::uint64_t>();
  const auto saturated = reader.value<std::uint64_t>();
  auto sums = reader.list<std::vector<PixelSums>>(sums_.size());
  auto replicates = reader.list<std::vector<ReplicateSums>>(replicates_.size());
  auto extra = reader.list<std::vector<Extra>>(extra_.size());
  auto distrust = reader.list<std::vector<Distrust>>(distrust_.size());
  if (!reader.at_end() || samples < 0) return false;
  drop_round();
  samples_ = samples;
  dropped_ = dropped;
  saturated_ = saturated;
  sums_.done = std::move(sums);
  replicates_.done = std::move(replicates);
  extra_.done = std::move(extra);
  distrust_.done = std::move(distrust);
  return true;
}

Picture Film::picture() const {
  const std::size_t pixels = sums_.size();
  Picture picture;
  picture.width = static_cast<int>(width_);
  picture.height = static_cast<int>(height_);
  picture.rgb.resize(3 * pixels);
  picture.alpha.resize(pixels);
  for (std::size_t i = 0; i < pixels; ++i) {
    const PixelSums& s = sums_.at(i);
    const double d = divisor(s.weight, s.count);
    for (std::size_t c = 0; c < 3; ++c)
      picture.rgb[3 * i + c] = static_cast<float>(s.rgb[c].value() / d);
    picture.alpha[i] = static_cast<float>(std::clamp(static_cast<double>(s.covered) / d, 0.0, 1.0));
  }
  picture.samples = samples_;
  picture.dropped_samples = dropped_;
  picture.saturated_samples = saturated_;
  append_layers(picture);
  return picture;
}

}  // namespace scenec::backend
