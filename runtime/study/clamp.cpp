// What a clamp would do: a sample of a pixel is what one more round adds to its sum, so a picture
// of clamped samples can be made beside the true one without a renderer that clamps.
#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "backend/image/compare.hpp"
#include "runtime/study/variant.hpp"

namespace scenec::runtime {

namespace {

constexpr std::size_t replicates = 4;
constexpr std::int64_t first_look = 16;  // samples that tell the picture's mean

// Sums of the samples of a picture, dealt out to replicates.
class Sums {
 public:
  explicit Sums(std::size_t size) : size_(size) {
    for (auto& sum : sums_) sum.resize(size);
  }
  void add(std::int64_t number, std::size_t value, double x) {
    sums_[static_cast<std::size_t>(number) % replicates][value] += x;
  }
  [[nodiscard]] std::vector<float> mean(std::int64_t samples) const {
    std::vector<float> means(size_);
    for (std::size_t i = 0; i < size_; ++i) {
      double sum = 0;
      for (const auto& part : sums_) sum += part[i];
      means[i] = static_cast<float>(sum / static_cast<double>(samples));
    }
    return means;
  }
  // Square root of the mean of variance / (R^2 + dark).
  [[nodiscard]] double noise(std::int64_t samples, const std::vector<float>& r, double dark) const {
    const double each = static_cast<double>(samples) / replicates;
    double all = 0;
    for (std::size_t i = 0; i < size_; ++i) {
      double mean = 0;
      for (const auto& part : sums_) mean += part[i] / each / replicates;
      double squares = 0;
      for (const auto& part : sums_) squares += std::pow(part[i] / each - mean, 2);
      const double level = static_cast<double>(r[i]);
      all += squares / (replicates * (replicates - 1)) / (level * level + dark);
    }
    return std::sqrt(all / static_cast<double>(size_));
  }

 private:
  std::size_t size_;
  std::array<std::vector<double>, replicates> sums_;
};

struct Clamped {
  std::vector<float> plain, clamped;
  double plain_noise = 0, clamped_noise = 0;
};

std::optional<Clamped> clamp_samples(const Variant& base, double times, std::int64_t samples,
                                     std::int64_t seed, const std::stop_token& stop,
                                     ThreadPool& pool) {
  ir::RenderSettings settings = base.settings;
  settings.seed = seed;
  backend::RenderSession look(*base.scene, settings, base.effects, pool);
  if (!look.advance(first_look, stop)) return std::nullopt;
  const double limit = times * mean_of(look.picture().rgb);
  backend::RenderSession session(*base.scene, settings, base.effects, pool);
  std::vector<float> before;
  Sums plain(look.picture().rgb.size());
  Sums clamped = plain;
  for (std::int64_t n = 0; n < samples; ++n) {
    if (!session.advance(1, stop)) return std::nullopt;
    std::vector<float> now = session.picture().rgb;
    before.resize(now.size());
    for (std::size_t i = 0; i + 2 < now.size(); i += 3) {
      std::array<double, 3> x{};
      for (std::size_t c = 0; c < 3; ++c)
        x[c] = static_cast<double>(n + 1) * static_cast<double>(now[i + c]) -
               static_cast<double>(n) * static_cast<double>(before[i + c]);
      const double most = std::max({x[0], x[1], x[2]});
      const double scale = most > limit ? limit / most : 1;
      for (std::size_t c = 0; c < 3; ++c) {
        plain.add(n, i + c, x[c]);
        clamped.add(n, i + c, scale * x[c]);
      }
    }
    before = std::move(now);
  }
  Clamped result;
  result.plain = plain.mean(samples);
  result.clamped = clamped.mean(samples);
  const double mean = mean_of(result.plain);
  const double dark = 0.01 * mean * mean;
  result.plain_noise = plain.noise(samples, result.plain, dark);
  result.clamped_noise = clamped.noise(samples, result.plain, dark);
  return result;
}

}  // namespace

Json clamp_row(const Variant& base, const Variant& other, double times, std::int64_t samples,
               const StudyPlan& plan, ThreadPool& pool) {
  std::vector<double> errors, means;
  double distance = 0;
  double before = 0;
  double after = 0;
  for (int run = 0; run < pairs; ++run) {
    const auto one = clamp_samples(base, times, samples, base.settings.seed + run, plan.stop, pool);
    if (!one) return nullptr;
    const double mean = mean_of(one->plain);
    if (!(mean > 0) || !(one->plain_noise > 0)) return nullptr;
    errors.push_back(one->clamped_noise / one->plain_noise);
    means.push_back(mean_of(one->clamped) / mean - 1);
    const auto width = static_cast<std::uint32_t>(base.settings.size.width);
    const auto height = static_cast<std::uint32_t>(base.settings.size.height);
    distance += std::sqrt(backend::difference_of({width, height, 3, one->clamped},
                                                 {width, height, 3, one->plain})
                              .rel_mse) /
                pairs;
    before += one->plain_noise / pairs;
    after += one->clamped_noise / pairs;
  }
  Json row{{"name", other.name}, {"what", other.what}, {"samples", samples}};
  row["error_ratio"] = spread_of(errors);
  row["brightness"] = mean_band_of(means);
  row["difference"] = distance;
  row["error_before"] = {{"value", before}};
  row["error_after"] = {{"value", after}};
  return row;
}

}  // namespace scenec::runtime
