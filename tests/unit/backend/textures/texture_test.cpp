#include "backend/textures/texture.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "backend/image/tone.hpp"
#include "tests/unit/backend/scene_kit.hpp"

namespace scenec::backend {
namespace {

DecodedImage image_2x2() {
  DecodedImage image;
  image.width = 2;
  image.height = 2;
  image.channels = 4;
  // Top row: 0 255; bottom row: 51 102 in red; alpha 255 0 / 128 255.
  image.samples =
      std::vector<std::uint8_t>{0, 10, 20, 255, 255, 30, 40, 0, 51, 50, 60, 128, 102, 70, 80, 255};
  return image;
}

TEST(texture, texel_centres_are_exact_and_v_goes_up) {  // T04
  const DecodedImage image = image_2x2();
  for (const auto filter : {ir::TextureFilter::nearest, ir::TextureFilter::bilinear}) {
    EXPECT_EQ(lookup(image, {0.25, 0.25}, ir::Wrap::repeat, filter, false).color.r, 51 / 255.0);
    EXPECT_EQ(lookup(image, {0.75, 0.75}, ir::Wrap::repeat, filter, false).color.r, 1);
    EXPECT_EQ(lookup(image, {0.25, 0.25}, ir::Wrap::repeat, filter, true).color.r,
              linear_of_srgb8(51));
    EXPECT_EQ(lookup(image, {0.25, 0.25}, ir::Wrap::repeat, filter, true).alpha, 128 / 255.0);
  }
  EXPECT_NEAR(
      lookup(image, {0.5, 0.25}, ir::Wrap::clamp, ir::TextureFilter::bilinear, false).color.r,
      76.5 / 255, 1e-15);
}

TEST(texture, every_coordinate_finds_a_texel) {  // T01
  const DecodedImage image = image_2x2();
  const double infinity = std::numeric_limits<double>::infinity();
  for (const double u : {-0.0, -1e-9, 1 - 0x1p-24, 1.0, -1.0, 1e9, -1e30, 1e300, infinity,
                         -infinity, std::numeric_limits<double>::quiet_NaN()}) {
    for (const auto wrap : {ir::Wrap::repeat, ir::Wrap::clamp, ir::Wrap::mirror}) {
      for (const auto filter : {ir::TextureFilter::nearest, ir::TextureFilter::bilinear}) {
        const Rgb c = lookup(image, {u, u}, wrap, filter, false).color;
        EXPECT_TRUE(c.r >= 0 && c.r <= 1) << u;
      }
    }
  }
}

TEST(texture, one_texel_is_the_same_everywhere) {  // T02
  DecodedImage image;
  image.width = image.height = image.channels = 1;
  image.samples = std::vector<std::uint16_t>{65535};
  for (const auto wrap : {ir::Wrap::repeat, ir::Wrap::clamp, ir::Wrap::mirror}) {
    for (double u = -2; u < 2; u += 0.13) {
      EXPECT_NEAR(lookup(image, {u, 3 * u}, wrap, ir::TextureFilter::bilinear, true).color.g, 1,
                  1e-12);
    }
  }
}

struct Evaluated {
  test::SceneKit kit;
  Rgb at(ir::TextureId id, double u, double v) {
    const std::vector<std::shared_ptr<const DecodedImage>> images;
    return TextureEvaluator(kit.builder().scene(), images)
        .value(id, {u, v}, TextureUse::color)
        .color;
  }
};

TEST(texture, expressions_give_what_they_say) {
  Evaluated e;
  const ir::ColorInput black{ir::black, {}};
  const ir::ColorInput white{ir::white, {}};
  const ir::TextureId checker = e.kit.texture(ir::CheckerTexture{black, white, 2});
  EXPECT_EQ(e.at(checker, 0.1, 0.1).r, 0);
  EXPECT_EQ(e.at(checker, 0.6, 0.1).r, 1);
  EXPECT_EQ(e.at(checker, 0.6, 0.6).r, 0);
  EXPECT_EQ(e.at(checker, -0.1, 0.1).r, 1);
  const ir::TextureId grid = e.kit.texture(ir::GridTexture{white, black, 1, 0.1});
  EXPECT_EQ(e.at(grid, 0.04, 0.5).r, 1);
  EXPECT_EQ(e.at(grid, 0.06, 0.5).r, 0);
  EXPECT_EQ(e.at(grid, 0.5, 2.96).r, 1);
  const ir::TextureId number = e.kit.texture(ir::ConstantTexture{{0.25, 0.25, 0.25}});
  const ir::TextureId ramp = e.kit.texture(
      ir::RampTexture{{0, number}, {{0, ir::black}, {0.5, {1, 0, 0}}, {1, ir::white}}});
  EXPECT_NEAR(e.at(ramp, 0, 0).r, 0.5, 1e-15);
  const ir::TextureId product = e.kit.texture(ir::ProductTexture{{{}, number}, {{2, 4, 8}, {}}});
  EXPECT_EQ(e.at(product, 0, 0).b, 2);
  const ir::TextureId mix = e.kit.texture(ir::MixTexture{black, white, {0, number}});
  EXPECT_EQ(e.at(mix, 0, 0).g, 0.25);
  const ir::TextureId channel = e.kit.texture(ir::ChannelTexture{product, ir::Channel::b});
  EXPECT_EQ(e.at(channel, 0, 0).r, 2);
}

TEST(texture, fractal_is_bounded_continuous_and_repeatable) {
  Evaluated e;
  const ir::TextureId id =
      e.kit.texture(ir::FractalTexture{5, 4, {ir::black, {}}, {ir::white, {}}});
  double low = 1;
  double high = 0;
  for (double u = -3; u < 3; u += 0.01) {
    const double a = e.at(id, u, 0.3 * u).r;
    EXPECT_NEAR(a, e.at(id, u + 1e-6, 0.3 * u).r, 1e-3);
    low = std::fmin(low, a);
    high = std::fmax(high, a);
  }
  EXPECT_GE(low, 0);
  EXPECT_LE(high, 1);
  EXPECT_GT(high - low, 0.3);
  EXPECT_EQ(gradient_noise(3, -7), 0);
}

}  // namespace
}  // namespace scenec::backend
