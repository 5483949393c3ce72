// The sums of all samples of a picture. A pixel is written by one worker at a time; its samples are
// added in the order of their numbers and the picture's sums are fixed point, so nothing depends on
// how the samples were split over rounds, threads or machines.
//
// A pixel's samples are dealt out to `replicate_count` replicates, each with a scramble of its own:
// what their means differ by tells how far the pixel is from settled (film/error.hpp).
#pragma once

#include <array>
#include <atomic>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "backend/backend.hpp"
#include "backend/film/fixed_sum.hpp"
#include "backend/film/replicates.hpp"
#include "backend/math/color.hpp"
#include "backend/math/vec.hpp"
#include "base/packed_bytes.hpp"
#include "base/parallel.hpp"
#include "ir/render_settings.hpp"

namespace scenec::backend {

// What the camera ray of a sample met; for the extra layers.
struct FirstHit {
  bool hit = false;
  bool uncertified = false;  // the root of the ray and the surface
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

// The sums of one pixel.
struct PixelSums {
  FixedSum rgb[3];
  std::int32_t weight = 0;
  std::int32_t count = 0;    // samples, dropped ones left out
  std::int32_t covered = 0;  // sum of the weights of samples that hit something
  std::int32_t hits = 0;
};
// The sums of its replicates but the last, which is what is left of the pixel's.
struct ReplicateSums {
  std::array<std::array<double, 3>, replicate_count - 1> rgb{};
  std::array<std::int32_t, replicate_count - 1> weight{};
};

class Film {
 public:
  explicit Film(const ir::RenderSettings& settings);

  [[nodiscard]] const ir::Region& region() const { return region_; }
  [[nodiscard]] std::size_t region_width() const { return width_; }
  [[nodiscard]] std::size_t region_height() const { return height_; }

  // One visit to a pixel in a round: add the samples, then close().
  class Pixel {
   public:
    // Not finite: counted, not added.
    void add(std::int64_t number, const FilmSample& sample);
    void close();

   private:
    friend class Film;
    Film* film_ = nullptr;
    std::size_t index_ = 0;
    PixelSums sums_;
    ReplicateSums replicates_;
  };
  // Before the first pixel of a round.
  void begin_round();
  // Of the region, from its top left. Once a round for every pixel.
  [[nodiscard]] Pixel open(std::size_t x, std::size_t y);
  // Puts the samples added since the last call (a finished round) among those that count.
  void finish_round(std::int64_t samples);
  // Forgets the samples added since then (a round that was stopped).
  void drop_round();
  [[nodiscard]] std::int64_t samples() const { return samples_; }

  [[nodiscard]] Picture picture() const;
  // The means of a pixel's replicates; nullopt when one has no samples.
  [[nodiscard]] std::optional<ReplicateMeans> replicate_means(std::size_t pixel) const;
  [[nodiscard]] Rgb mean(std::size_t pixel) const;

  [[nodiscard]] std::uint64_t memory() const;  // bytes of all sums
  // The finished rounds as bytes; restore() refuses what cannot be sums of this film.
  [[nodiscard]] std::string save() const;
  [[nodiscard]] bool restore(std::string_view bytes);

 private:
  struct Extra {
    FixedSum albedo[3], normal[3], position[3], depth, uv[2];
    std::uint32_t item = 0, material = 0;
    bool identified = false;
  };
  // Sums of finished rounds, and the same with what the running round added: a worker takes a pixel
  // from `done` and puts it into `next`; a finished round swaps the two, a stopped one swaps
  // nothing. Neither is there before it is needed: a picture of one round takes one of them.
  template <class T>
  struct Buffers {
    std::vector<T> done, next;
    std::size_t pixels = 0;

    void resize(std::size_t size) { pixels = size; }
    [[nodiscard]] std::size_t size() const { return pixels; }
    [[nodiscard]] bool kept() const { return pixels > 0; }
    // Of the finished rounds.
    [[nodiscard]] const T& at(std::size_t i) const {
      static const T nothing{};
      return done.empty() ? nothing : done[i];
    }
    void pack(std::string& out) const {
      if (done.empty())
        out += packed_bytes_of(std::vector<T>(pixels));
      else
        out += packed_bytes_of(done);
    }
    [[nodiscard]] std::uint64_t memory() const {
      return (done.capacity() + next.capacity()) * sizeof(T);
    }
    void open_next() {
      if (next.size() != pixels) next.resize(pixels);
    }
    void swap() { done.swap(next); }
  };
  // Samples of a pixel that the sums do not hold as they were, or that look at a place not proven.
  struct Distrust {
    std::uint32_t dropped = 0;      // not finite
    std::uint32_t saturated = 0;    // beyond what a sum holds
    std::uint32_t uncertified = 0;  // the camera ray's first hit
  };
  struct Refused {
    std::atomic<std::uint64_t> dropped{0};    // not finite
    std::atomic<std::uint64_t> saturated{0};  // beyond what a sum holds
  };
  [[nodiscard]] bool keeps_replicates() const { return replicates_.kept(); }
  void add_extra(Extra& extra, const FilmSample& sample) const;
  void append_layers(Picture& picture) const;

  ir::RenderSettings settings_;
  ir::Region region_;
  std::size_t width_ = 0;
  std::size_t height_ = 0;
  std::int64_t samples_ = 0;
  Buffers<PixelSums> sums_;
  Buffers<ReplicateSums> replicates_;  // empty: film .course, whose samples are all the same
  Buffers<Extra> extra_;               // empty: no layer needs them
  Buffers<Distrust> distrust_;         // empty: the layer `trust` is not asked for
  std::uint64_t dropped_ = 0;          // of finished rounds
  std::uint64_t saturated_ = 0;
  Refused refused_;  // in the running round
};

// The pixels to render: the scene's region, or all.
[[nodiscard]] ir::Region region_of(const ir::RenderSettings& settings);

}  // namespace scenec::backend
