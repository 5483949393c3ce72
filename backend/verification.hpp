// Whether a picture is what its file says: rendered from this scene, with these settings, with so
// many samples and such noise. The scene is rendered again with other random numbers — the whole
// frame with half the samples, and tiles spread over a quarter of its area with all of them — and
// every difference must be explained by the noise of both (backend/film/agreement.hpp). What looks
// worst is then rendered many times (backend/second_look.hpp).
#pragma once

#include <functional>
#include <stop_token>
#include <string_view>
#include <vector>

#include "backend/film/agreement.hpp"
#include "backend/render_scene.hpp"

namespace scenec::backend {

// What a file claims.
struct PictureClaim {
  NoisyPicture picture;  // `variance` empty: the file has no such layer
  bool is_half = false;  // colours were rounded to half precision
};

// One question that was asked of the picture.
struct Question {
  std::string_view name;
  std::string_view says;  // what an answer below the limit means
  double log_p = 0;       // of all places together
  std::size_t tests = 0;
  std::vector<Disagreement> worst;  // in the picture's pixels, worst first
  // Alone enough to refuse the picture, for as many questions as there are.
  [[nodiscard]] bool refuses() const;
};
struct Verification {
  std::vector<Question> questions;
  double log_p = 0;      // of all questions together: an honest picture has less than p with
                         // probability p at most
  double tile_area = 0;  // share of the picture
  std::size_t tiles = 0;
  std::int64_t frame_samples = 0;  // of the whole frame
  std::int64_t tile_samples = 0;
  [[nodiscard]] bool accepted() const;
};
// An honest file is refused once in so many.
inline constexpr double false_alarm = 1e-4;

struct VerifyOptions {
  std::uint64_t seed = 0;                // must have nothing to do with the picture's
  std::function<void(double)> progress;  // part of the work that is done
};
// Nothing when it was stopped. `settings`: those the file claims, with its region and samples.
[[nodiscard]] std::optional<Verification> verify_picture(
    const RenderScene& scene, const ir::RenderSettings& settings, const ir::EffectSet& effects,
    const PictureClaim& claim, ThreadPool& pool, const VerifyOptions& options,
    const std::stop_token& stop);

}  // namespace scenec::backend
