#include "backend/film/film.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

#include "backend/film/filter.hpp"
#include "backend/math/rng.hpp"

namespace scenec::backend {
namespace {

TEST(fixed_sum, holds_exact_values_of_both_signs) {
  for (const double value :
       {0.0, 1.0, -1.0, 0.5, 1e6, -12345.678, 0x1p-64, 3 * 0x1p-60, 0x1p41 + 0.25}) {
    FixedSum sum;
    EXPECT_TRUE(sum.add(value));
    EXPECT_EQ(sum.value(), value);
    sum.add(-value);
    EXPECT_EQ(sum.value(), 0);
  }
  FixedSum tiny;
  tiny.add(std::numeric_limits<double>::denorm_min());
  tiny.add(0x1p-70);
  EXPECT_EQ(tiny.value(), 0);
}

TEST(fixed_sum, does_not_depend_on_the_order_of_terms) {
  std::mt19937_64 random(17);
  std::vector<double> terms(4096);
  for (double& t : terms)
    t = std::ldexp(unit_double(random()) - 0.5, static_cast<int>(random() % 60) - 30);
  FixedSum first;
  for (const double t : terms) first.add(t);
  for (int round = 0; round < 4; ++round) {
    std::shuffle(terms.begin(), terms.end(), random);
    FixedSum parts[3];
    for (std::size_t i = 0; i < terms.size(); ++i) parts[i % 3].add(terms[i]);
    parts[2] += parts[0];
    parts[2] += parts[1];
    EXPECT_EQ(parts[2], first);
  }
}

TEST(fixed_sum, saturates_and_says_so) {
  FixedSum sum;
  EXPECT_FALSE(sum.add(1e300));
  EXPECT_EQ(sum.value(), FixedSum::largest_term);
  for (int i = 0; i < 1000; ++i) sum.add(1e300);
  EXPECT_GT(sum.value(), 0);
}

FilmSample sample_of(double radiance, int weight = 1) {
  FilmSample s;
  s.radiance = Rgb::gray(radiance);
  s.weight = weight;
  s.covered = true;
  return s;
}

void give(Film& film, std::size_t x, std::size_t y, std::int64_t first,
          std::initializer_list<FilmSample> samples) {
  film.begin_round();
  Film::Pixel pixel = film.open(x, y);
  for (const FilmSample& sample : samples) pixel.add(first++, sample);
  pixel.close();
}

TEST(film, sixty_four_samples_are_twice_thirty_two) {  // D02
  ir::RenderSettings settings;
  settings.size = {3, 2};
  Film whole(settings);
  Film halves(settings);
  const auto add = [](Film& film, std::int64_t first, std::int64_t end) {
    film.begin_round();
    for (std::size_t x = 0; x < 3; ++x) {
      Film::Pixel pixel = film.open(x, 1);
      for (std::int64_t s = first; s < end; ++s)
        pixel.add(
            s, sample_of(std::exp(20 * random_unit(1, x, static_cast<std::uint64_t>(s), 0) - 10)));
      pixel.close();
    }
    film.finish_round(end - first);
  };
  add(whole, 0, 64);
  add(halves, 0, 31);
  add(halves, 31, 64);
  EXPECT_EQ(whole.replicate_means(4), halves.replicate_means(4));
  EXPECT_EQ(whole.picture().rgb, halves.picture().rgb);
  EXPECT_EQ(whole.picture().samples, halves.picture().samples);
}

TEST(film, a_dropped_round_leaves_no_trace) {
  ir::RenderSettings settings;
  settings.size = {1, 1};
  settings.aovs = {ir::Aov::depth};
  Film film(settings);
  constexpr double infinite = std::numeric_limits<double>::infinity();
  give(film, 0, 0, 0, {sample_of(2)});
  film.finish_round(1);
  give(film, 0, 0, 1, {sample_of(100), sample_of(infinite)});
  film.drop_round();
  EXPECT_EQ(film.picture().dropped_samples, 0U);
  EXPECT_EQ(film.picture().rgb[0], 2.0F);
  EXPECT_EQ(film.picture().samples, 1);
}

TEST(film, samples_that_are_not_finite_are_counted_and_left_out) {  // C08
  ir::RenderSettings settings;
  settings.size = {1, 1};
  Film film(settings);
  give(film, 0, 0, 0,
       {sample_of(3), sample_of(std::numeric_limits<double>::quiet_NaN()),
        sample_of(std::numeric_limits<double>::infinity())});
  film.finish_round(3);
  EXPECT_EQ(film.picture().rgb[0], 3.0F);
  EXPECT_EQ(film.picture().dropped_samples, 2U);
}

TEST(film, the_layer_trust_says_which_pixels_are_not_as_they_were_computed) {
  ir::RenderSettings settings;
  settings.size = {2, 1};
  settings.aovs = {ir::Aov::trust};
  Film film(settings);
  const auto unproven = [](double radiance) {
    FilmSample sample = sample_of(radiance);
    sample.first.hit = sample.first.uncertified = true;
    return sample;
  };
  give(film, 0, 0, 0,
       {sample_of(3), sample_of(std::numeric_limits<double>::quiet_NaN()),
        sample_of(-std::numeric_limits<double>::infinity()), sample_of(1e30)});
  // A sample that is left out was looked at a place not proven all the same.
  give(
      film, 1, 0, 0,
      {sample_of(1), unproven(1), unproven(std::numeric_limits<double>::quiet_NaN()), unproven(1)});
  film.finish_round(4);
  Film other(settings);
  ASSERT_TRUE(other.restore(film.save()));
  for (const Picture& picture : {film.picture(), other.picture()}) {
    ASSERT_EQ(picture.layers.size(), 3U);
    EXPECT_EQ(picture.layers[0].first, "trust.dropped");
    EXPECT_EQ(picture.layers[0].second, (std::vector<float>{2, 1}));
    EXPECT_EQ(picture.layers[1].first, "trust.saturated");
    EXPECT_EQ(picture.layers[1].second, (std::vector<float>{1, 0}));
    EXPECT_EQ(picture.layers[2].first, "trust.uncertified");
    EXPECT_EQ(picture.layers[2].second, (std::vector<float>{0, 3}));
    EXPECT_EQ(picture.dropped_samples, 3U);
    EXPECT_EQ(picture.saturated_samples, 1U);
  }
}

class Filters : public testing::TestWithParam<ir::FilterKind> {};

TEST_P(Filters, sample_their_own_shape_about_the_centre) {  // C06
  const ir::PixelFilter filter{GetParam(), ir::usual_radius(GetParam())};
  const FilterSampler sampler(filter);
  // Along one axis; the filters are products.
  constexpr int n = 20000;
  double weight = 0;
  double moment = 0;
  double second = 0;
  for (int i = 0; i < n; ++i) {
    const FilterSample s = sampler.sample({(i + 0.5) / n, 0.5});
    EXPECT_LE(std::fabs(s.dx), filter.radius);
    weight += s.weight;
    moment += s.weight * s.dx;
    second += s.weight * s.dx * s.dx;
  }
  // The same moments from the filter itself.
  double w = 0;
  double absolute = 0;
  double x2 = 0;
  constexpr int steps = 20000;
  for (int i = 0; i < steps; ++i) {
    const double x = ((i + 0.5) / steps * 2 - 1) * filter.radius;
    const double f = filter_value(filter, x);
    w += f;
    absolute += std::fabs(f);
    x2 += f * x * x;
  }
  EXPECT_NEAR(moment / weight, 0, 1e-3);
  EXPECT_NEAR(weight / n, w / absolute, 2e-3);
  EXPECT_NEAR(second / weight, x2 / w, 5e-3 * filter.radius * filter.radius);
}

TEST_P(Filters, keep_a_constant_exact) {  // C07
  ir::RenderSettings settings;
  settings.size = {1, 1};
  const FilterSampler sampler({GetParam(), ir::usual_radius(GetParam())});
  Film film(settings);
  film.begin_round();
  Film::Pixel pixel = film.open(0, 0);
  for (std::uint64_t s = 0; s < 64; ++s) {
    const FilterSample offset = sampler.sample({random_unit(2, 0, s, 0), random_unit(2, 0, s, 1)});
    pixel.add(static_cast<std::int64_t>(s), sample_of(1e4, offset.weight));
  }
  pixel.close();
  film.finish_round(64);
  EXPECT_EQ(film.picture().rgb[0], 1e4F);
}

INSTANTIATE_TEST_SUITE_P(all, Filters,
                         testing::Values(ir::FilterKind::tent, ir::FilterKind::box,
                                         ir::FilterKind::gaussian, ir::FilterKind::mitchell,
                                         ir::FilterKind::blackman_harris));

}  // namespace
}  // namespace scenec::backend
