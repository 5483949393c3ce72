#include "backend/verification.hpp"

#include <algorithm>
#include <cmath>
#include <mutex>

#include "backend/film/film.hpp"
#include "backend/film/mirrored_tests.hpp"
#include "backend/image/write_image.hpp"
#include "backend/math/rng.hpp"
#include "backend/render_session.hpp"
#include "backend/second_look.hpp"

namespace scenec::backend {
namespace {

// The whole frame is rendered twice, each with this part of the samples, no fewer than variances
// need: one picture weighs, the other is weighed against.
constexpr std::int64_t frame_part = 4;
constexpr std::int64_t fewest_samples = 2 * replicate_count;
// The picture is cut into so many cells by so many; each has one tile of half its width and height.
constexpr std::int64_t most_cells = 8;
constexpr std::int64_t smallest_cell = 12;  // pixels
// A picture without chance may be off by no sample at all.
constexpr double samples_of_none = 1e300;
// Numbers of random numbers: two frames, the tiles, and from here on the peers of cells.
constexpr std::uint64_t first_peer = 1000;
// The answers are corrected for as many, whether all are asked or not.
constexpr double most_questions = 7;
constexpr std::size_t frame_blocks[] = {4, 8, 16, 64};
constexpr std::size_t tile_blocks[] = {4, 8, 16};

std::int64_t frame_samples_of(std::int64_t samples) {
  const std::int64_t part = samples / frame_part / static_cast<std::int64_t>(replicate_count) *
                            static_cast<std::int64_t>(replicate_count);
  return std::max(fewest_samples, part);
}

// Pixels of the picture; a quarter of the area at least.
std::vector<ir::Region> tiles_of(std::int64_t width, std::int64_t height, std::uint64_t seed) {
  const std::int64_t columns = std::clamp<std::int64_t>(width / smallest_cell, 1, most_cells);
  const std::int64_t rows = std::clamp<std::int64_t>(height / smallest_cell, 1, most_cells);
  std::vector<ir::Region> tiles;
  const auto draw = [&](std::int64_t choices) {
    seed = mix_bits(seed + 1);
    return static_cast<std::int64_t>(seed % static_cast<std::uint64_t>(choices));
  };
  for (std::int64_t row = 0; row < rows; ++row) {
    for (std::int64_t column = 0; column < columns; ++column) {
      const std::int64_t x0 = column * width / columns;
      const std::int64_t y0 = row * height / rows;
      const std::int64_t cell_width = (column + 1) * width / columns - x0;
      const std::int64_t cell_height = (row + 1) * height / rows - y0;
      const std::int64_t w = (cell_width + 1) / 2;
      const std::int64_t h = (cell_height + 1) / 2;
      const std::int64_t x = x0 + draw(cell_width - w + 1);
      const std::int64_t y = y0 + draw(cell_height - h + 1);
      tiles.push_back({x, y, x + w, y + h});
    }
  }
  return tiles;
}

std::int64_t area_of(const ir::Region& r) {
  return (r.x1 - r.x0) * (r.y1 - r.y0);
}

std::vector<double> part_of(const std::vector<double>& weights, std::size_t width,
                            const ir::Region& part) {
  std::vector<double> result;
  const auto row = static_cast<std::ptrdiff_t>(3 * (part.x1 - part.x0));
  for (std::int64_t y = part.y0; y < part.y1; ++y) {
    const auto at = weights.begin() + 3 * (y * static_cast<std::ptrdiff_t>(width) + part.x0);
    result.insert(result.end(), at, at + row);
  }
  return result;
}

class Verifier {
 public:
  Verifier(const RenderScene& scene, const ir::RenderSettings& settings,
           const ir::EffectSet& effects, const PictureClaim& claim, ThreadPool& pool,
           const VerifyOptions& options, const std::stop_token& stop)
      : scene_(scene),
        settings_(settings),
        effects_(effects),
        claim_(claim),
        pool_(pool),
        options_(options),
        stop_(stop),
        picture_(claim.picture),
        samples_(static_cast<std::int64_t>(claim.picture.samples)),
        frame_samples_(frame_samples_of(samples_)),
        region_(region_of(settings)),
        is_exact_(settings.film == ir::FilmKind::course) {
    settings_.aovs = {ir::Aov::variance};
    settings_.stop = {};
  }

  std::optional<Verification> run() {
    const auto width = static_cast<std::int64_t>(picture_.width);
    const auto height = static_cast<std::int64_t>(picture_.height);
    has_variance_ = !claim_.picture.variance.empty() && samples_ >= fewest_samples;
    const std::vector<ir::Region> tiles = tiles_of(width, height, mix_bits(options_.seed ^ 3));
    result_.tiles = tiles.size();
    for (const ir::Region& tile : tiles) tile_pixels_ += area_of(tile);
    work_ = static_cast<double>(2 * frame_samples_ * width * height +
                                (has_variance_ ? 1 : 2) * samples_ * tile_pixels_);
    if (!is_exact_)
      work_ += static_cast<double>(samples_ * second_look_pixels(picture_.width, picture_.height));
    result_.tile_area = static_cast<double>(tile_pixels_) / static_cast<double>(width * height);
    result_.frame_samples = 2 * frame_samples_;
    result_.tile_samples = samples_;
    if (!look_at_frame() || !look_at_tiles(tiles)) return std::nullopt;
    conclude();
    // What is refused already needs no second look.
    if (!result_.accepted() || is_exact_) return std::move(result_);
    if (!look_again()) return std::nullopt;
    conclude();
    return std::move(result_);
  }

 private:
  [[nodiscard]] ir::RenderSettings settings_for(const ir::Region& part,
                                                std::uint64_t number) const {
    ir::RenderSettings settings = settings_;
    settings.seed = static_cast<std::int64_t>(mix_bits(options_.seed + number) >> 2);
    settings.region = ir::Region{region_.x0 + part.x0, region_.y0 + part.y0, region_.x0 + part.x1,
                                 region_.y0 + part.y1};
    return settings;
  }

  // Renders a part of the picture; empty when it was stopped.
  std::optional<NoisyPicture> render(const ir::Region& part, std::int64_t samples,
                                     std::uint64_t number) {
    const ir::RenderSettings settings = settings_for(part, number);
    RenderSession session(scene_, settings, effects_, pool_);
    const double here = static_cast<double>(samples * area_of(part));
    const auto tell = [&](double share) {
      if (options_.progress) options_.progress((done_ + share * here) / work_);
    };
    if (!session.advance(samples, stop_, tell)) return std::nullopt;
    done_ += here;
    return noisy_picture_of(session.picture());
  }

  bool look_at_frame() {
    const ir::Region whole{0, 0, static_cast<std::int64_t>(picture_.width),
                           static_cast<std::int64_t>(picture_.height)};
    const auto first = render(whole, frame_samples_, 1);
    const auto second = first ? render(whole, frame_samples_, 2) : std::nullopt;
    if (!second) return false;
    own_ = mean_of(*first, *second);
    look_at_contrast(own_);
    look_at_contrast(picture_);
    weights_ = brightness_weights(own_);
    if (is_exact_) {
      picture_.variance.assign(picture_.rgb.size(), 0);
      picture_.samples = own_.samples = samples_of_none;
    } else if (!has_variance_) {
      guess_variance(picture_, own_);  // too few samples give no variances worth the name
    }
    Agreement blocks;
    for (const std::size_t side : frame_blocks) join(blocks, compare_blocks(picture_, own_, side));
    ask("frame", "the picture shows something else", blocks);
    ask("brightness", "the picture is too bright or too dark by a factor",
        compare_brightness(picture_, *first, *second));
    return true;
  }

  bool look_at_tiles(const std::vector<ir::Region>& tiles) {
    Agreement blocks;
    MirroredSums sums;
    std::uint64_t number = 3;
    for (const ir::Region& tile : tiles) {
      const NoisyPicture part = backend::part_of(picture_, tile);
      auto own = render(tile, samples_, number++);
      if (!own) return false;
      if (claim_.is_half) round_to_half(own->rgb);
      if (!has_variance_) {
        auto third = render(tile, samples_, number++);
        if (!third) return false;
        if (claim_.is_half) round_to_half(third->rgb);
        add_middles(sums, part, *own, *third);
      }
      own->samples = part.samples;
      own->contrast = backend::part_of(own_, tile).contrast;
      if (samples_ < fewest_samples && !is_exact_)
        guess_variance(*own, backend::part_of(own_, tile));
      for (const std::size_t side : tile_blocks)
        join(blocks, compare_blocks(part, *own, side), tile.x0, tile.y0);
      add_mirrored(sums, part, *own, part_of(weights_, picture_.width, tile));
    }
    ask("tiles", "the picture shows something else", blocks);
    ask_once("tiles' brightness", "the picture is too bright or too dark by a factor",
             log_p_brightness(sums));
    ask_once("roughness", "the noise between pixels is not that of so many samples",
             log_p_fair(sums.rougher));
    if (has_variance_)
      ask_once("variance", "the layer `variance` is not that of so many samples",
               log_p_fair(sums.noisier));
    else
      ask_once("noise", "the noise is not that of so many samples",
               log_p_fair(sums.middle, 1.0 / 3));
    return true;
  }

  // One worker renders a cell: there are many of them.
  bool look_again() {
    std::mutex telling;
    const RenderPeer peer = [&](const ir::Region& part,
                                std::uint64_t number) -> std::optional<std::vector<float>> {
      ThreadPool alone(1);
      ir::RenderSettings settings = settings_for(part, first_peer + number);
      settings.aovs.clear();
      RenderSession session(scene_, settings, effects_, alone);
      if (!session.advance(samples_, stop_)) return std::nullopt;
      std::vector<float> rgb = session.picture().rgb;
      if (claim_.is_half) round_to_half(rgb);
      const std::scoped_lock lock(telling);
      done_ += static_cast<double>(samples_ * area_of(part));
      if (options_.progress) options_.progress(done_ / work_);
      return rgb;
    };
    auto found = second_look(picture_, own_, pool_, peer);
    if (!found) return false;
    ask("second look", "some places are not what they are time and again", *found);
    return true;
  }

  static NoisyPicture mean_of(const NoisyPicture& a, const NoisyPicture& b) {
    NoisyPicture mean = a;
    mean.samples = a.samples + b.samples;
    for (std::size_t i = 0; i < mean.rgb.size(); ++i) {
      mean.rgb[i] = (a.rgb[i] + b.rgb[i]) / 2;
      mean.variance[i] = (a.variance[i] + b.variance[i]) / 4;
    }
    return mean;
  }

  void conclude() {
    double lowest = 0;
    for (const Question& q : result_.questions) lowest = std::min(lowest, q.log_p);
    result_.log_p = std::min(0.0, lowest + std::log(most_questions));
  }

  void ask(std::string_view name, std::string_view says, const Agreement& answer) {
    result_.questions.push_back({name, says, answer.log_p, answer.tests, answer.worst});
  }
  void ask_once(std::string_view name, std::string_view says, double log_p) {
    result_.questions.push_back({name, says, log_p, 1, {}});
  }

  const RenderScene& scene_;
  ir::RenderSettings settings_;
  const ir::EffectSet& effects_;
  const PictureClaim& claim_;
  ThreadPool& pool_;
  const VerifyOptions& options_;
  const std::stop_token& stop_;
  NoisyPicture picture_;
  std::int64_t samples_;
  std::int64_t frame_samples_;  // of each of the two pictures of the frame
  ir::Region region_;
  bool has_variance_ = false;  // a layer of the file says how sure it is of each pixel
  bool is_exact_;              // all samples of a pixel are the same
  NoisyPicture own_;
  std::vector<double> weights_;
  Verification result_;
  std::int64_t tile_pixels_ = 0;
  double work_ = 1;
  double done_ = 0;
};

}  // namespace

bool Question::refuses() const {
  return log_p + std::log(most_questions) < std::log(false_alarm);
}

bool Verification::accepted() const {
  return log_p >= std::log(false_alarm);
}

std::optional<Verification> verify_picture(const RenderScene& scene,
                                           const ir::RenderSettings& settings,
                                           const ir::EffectSet& effects, const PictureClaim& claim,
                                           ThreadPool& pool, const VerifyOptions& options,
                                           const std::stop_token& stop) {
  return Verifier(scene, settings, effects, claim, pool, options, stop).run();
}

}  // namespace scenec::backend
