#include "backend/second_look.hpp"

#include <gtest/gtest.h>

#include <atomic>
#include <cmath>
#include <random>

namespace scenec::backend {
namespace {

constexpr std::int64_t width = 48;
constexpr std::int64_t height = 36;

// Noise round 1 with a standard deviation of 0.1, the same for the same peer and place.
std::vector<float> noise(const ir::Region& part, std::uint64_t peer) {
  std::mt19937_64 random(1000000 * peer + 1000 * static_cast<std::uint64_t>(part.y0) +
                         static_cast<std::uint64_t>(part.x0));
  std::normal_distribution<float> value(1, 0.1f);
  std::vector<float> rgb(static_cast<std::size_t>(3 * (part.x1 - part.x0) * (part.y1 - part.y0)));
  for (float& v : rgb) v = value(random);
  return rgb;
}

NoisyPicture picture(std::uint64_t number) {
  NoisyPicture p;
  p.width = width;
  p.height = height;
  p.samples = 64;
  p.rgb = noise({0, 0, width, height}, number);
  p.variance.assign(p.rgb.size(), 0.01f);
  return p;
}

struct Looked {
  std::optional<Agreement> found;
  std::int64_t pixels = 0;
};
Looked look(const NoisyPicture& suspect) {
  ThreadPool pool(2);
  std::atomic<std::int64_t> pixels{0};
  Looked looked;
  looked.found =
      second_look(suspect, picture(501), pool, [&](const ir::Region& part, std::uint64_t peer) {
        pixels += (part.x1 - part.x0) * (part.y1 - part.y0);
        return std::optional(noise(part, peer));
      });
  looked.pixels = pixels.load();
  return looked;
}

TEST(SecondLook, LeavesHonestPicturesAloneSoon) {
  const Looked looked = look(picture(500));
  ASSERT_TRUE(looked.found);
  EXPECT_GT(looked.found->log_p, std::log(1e-3));
  EXPECT_LT(looked.pixels, second_look_pixels(width, height) / 4);
}

TEST(SecondLook, FindsAnEdgeAndNamesItsPlace) {
  NoisyPicture suspect = picture(500);
  // Nine pixels of 1,728, on a slope.
  for (std::size_t i = 0; i < 9; ++i)
    for (std::size_t c = 0; c < 3; ++c)
      suspect.rgb[3 * ((17 + i / 2) * width + 17 + (i + 1) / 2) + c] += 0.6f;
  const Looked looked = look(suspect);
  ASSERT_TRUE(looked.found);
  EXPECT_LT(looked.found->log_p, std::log(1e-5));
  ASSERT_FALSE(looked.found->worst.empty());
  const ir::Region& place = looked.found->worst[0].place;
  EXPECT_EQ(place.x0, 16);
  EXPECT_EQ(place.y0, 16);
  EXPECT_LE(looked.pixels, second_look_pixels(width, height));
}

TEST(SecondLook, SaysNothingWhenItWasStopped) {
  ThreadPool pool(2);
  const auto stopped = [](const ir::Region&, std::uint64_t) {
    return std::optional<std::vector<float>>();
  };
  EXPECT_FALSE(second_look(picture(500), picture(501), pool, stopped));
}

}  // namespace
}  // namespace scenec::backend
