// The sums of all samples of a picture. A pixel is written by one worker at a time; sums are fixed
// point, so they do not depend on how the samples were split over rounds, threads or machines.
#pragma once

#include <atomic>
#include <cstdint>
#include <vector>

#include "backend/backend.hpp"
#include "backend/film/fixed_sum.hpp"
#include "backend/math/color.hpp"
#include "backend/math/vec.hpp"
#include "base/parallel.hpp"
#include "ir/render_settings.hpp"

namespace scenec::backend {

// What the camera ray of a sample met; for the extra layers.
struct FirstHit {
  bool hit = false;
  Rgb albedo;
  Vector3 normal{0, 0, 0};
  Point3 position;
  double depth = 0;  // along the ray
  double u = 0;
  double v = 0;
  std::uint32_t item = 0;
  std::uint32_t material = 0;
};

struct FilmSample {
  Rgb radiance;
  int weight = 1;
  bool covered = false;  // something was hit: alpha
  FirstHit first;
};

class Film {
 public:
  // `keep_squares`: for the variance layer and for `stop.error`.
  enum class Squares : std::uint8_t { no, yes };
  Film(const ir::RenderSettings& settings, Squares squares);

  [[nodiscard]] const ir::Region& region() const { return region_; }
  [[nodiscard]] std::size_t region_width() const { return width_; }
  [[nodiscard]] std::size_t region_height() const { return height_; }

  // Pixel of the region, from its top left. Not finite: counted, not added.
  void add(std::size_t x, std::size_t y, const FilmSample& sample);
  // Puts the samples added since the last call (a finished round) among those that count.
  void finish_round(std::int64_t samples, ThreadPool& pool);
  // Forgets the samples added since then (a round that was stopped).
  void drop_round();
  [[nodiscard]] std::int64_t samples() const { return samples_; }

  // Precondition: squares are kept.
  [[nodiscard]] ErrorEstimate error() const;
  [[nodiscard]] Picture picture() const;

  // The finished rounds as bytes; restore() refuses what cannot be sums of this film.
  [[nodiscard]] std::string save() const;
  [[nodiscard]] bool restore(std::string_view bytes);

 private:
  struct Sums {
    FixedSum rgb[3];
    std::int32_t weight = 0;
    std::int32_t count = 0;    // samples, dropped ones left out
    std::int32_t covered = 0;  // sum of the weights of samples that hit something
    std::int32_t hits = 0;
    void merge(const Sums& other);
  };
  struct Squares3 {
    FixedSum rgb[3];
  };
  struct Extra {
    FixedSum albedo[3], normal[3], position[3], depth, uv[2];
    std::uint32_t item = 0, material = 0;
    bool identified = false;
    void merge(const Extra& other);
  };
  [[nodiscard]] std::size_t index(std::size_t x, std::size_t y) const { return y * width_ + x; }
  void add_extra(std::size_t pixel, const FilmSample& sample);
  void append_layers(Picture& picture) const;
  [[nodiscard]] double estimated_error() const;

  ir::RenderSettings settings_;
  ir::Region region_;
  std::size_t width_ = 0;
  std::size_t height_ = 0;
  std::int64_t samples_ = 0;
  bool keep_squares_ = false;
  bool keep_extra_ = false;
  std::vector<Sums> total_, round_;
  std::vector<Squares3> total_squares_, round_squares_;
  std::vector<Extra> total_extra_, round_extra_;
  std::atomic<std::uint64_t> dropped_{0};
  std::atomic<std::uint64_t> saturated_{0};
};

// The pixels to render: the scene's region, or all.
[[nodiscard]] ir::Region region_of(const ir::RenderSettings& settings);

}  // namespace scenec::backend
