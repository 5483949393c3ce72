// `.trilinear`: means over what a pixel sees, by levels and in renders.
#include "backend/textures/pyramid.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "backend/image/tone.hpp"
#include "backend/math/rng.hpp"
#include "tests/unit/backend/scene_kit.hpp"

namespace scenec::backend {
namespace {

DecodedImage random_image(std::uint32_t width, std::uint32_t height, std::uint32_t channels) {
  DecodedImage image;
  image.width = width;
  image.height = height;
  image.channels = channels;
  std::vector<std::uint8_t> bytes(std::size_t{width} * height * channels);
  for (std::size_t i = 0; i < bytes.size(); ++i)
    bytes[i] = static_cast<std::uint8_t>(random_unit(3, i, 0, 0) * 256);
  image.samples = std::move(bytes);
  return image;
}

TextureValue mean_of(const DecodedImage& image, bool srgb) {
  TextureValue sum{{}, 0};
  for (std::uint32_t y = 0; y < image.height; ++y) {
    for (std::uint32_t x = 0; x < image.width; ++x) {
      const TextureValue t = texel(image, x, y, srgb);
      sum.color += t.color;
      sum.alpha += t.alpha;
    }
  }
  const double count = static_cast<double>(image.width) * image.height;
  return {sum.color * (1 / count), sum.alpha / count};
}

TexturePlace place(double u, double v, double width) {
  TexturePlace at(u, v);
  at.width_u = at.width_v = width;
  return at;
}

TEST(Pyramid, TheLastLevelIsTheMeanOfAPictureOfAnySize) {
  const std::uint32_t sizes[][2] = {{1, 1}, {2, 2}, {64, 64}, {5, 7}, {1, 9}, {37, 20}};
  for (const auto& size : sizes) {
    for (const std::uint32_t channels : {1U, 2U, 3U, 4U}) {
      const DecodedImage image = random_image(size[0], size[1], channels);
      for (const bool srgb : {false, true}) {
        const Pyramid pyramid(image, srgb);
        const TextureValue mean = mean_of(image, srgb);
        for (const double width : {1.0, 1e9, std::numeric_limits<double>::infinity()}) {
          const TextureValue v = pyramid.lookup(image, place(0.3, 0.8, width), ir::Wrap::repeat);
          EXPECT_NEAR(v.color.g, mean.color.g, 1e-6) << size[0] << 'x' << size[1];
          EXPECT_NEAR(v.alpha, mean.alpha, 1e-6);
        }
      }
    }
  }
}

TEST(Pyramid, BelowATexelItIsBilinear) {
  const DecodedImage image = random_image(16, 8, 3);
  const Pyramid pyramid(image, true);
  for (int i = 0; i < 100; ++i) {
    const double u = 3 * random_unit(4, static_cast<std::uint64_t>(i), 0, 0) - 1;
    const double v = 3 * random_unit(4, static_cast<std::uint64_t>(i), 1, 0) - 1;
    for (const double width : {0.0, 1.0 / 16}) {
      EXPECT_EQ(pyramid.lookup(image, place(u, v, width), ir::Wrap::mirror).color,
                lookup(image, {u, v}, ir::Wrap::mirror, ir::TextureFilter::bilinear, true).color);
    }
  }
}

// Doubling the width goes up one level; between levels the value is continuous.
TEST(Pyramid, LevelsFollowTheLogarithmOfTheWidth) {
  const DecodedImage image = random_image(64, 64, 1);
  const Pyramid pyramid(image, false);
  double last = pyramid.lookup(image, place(0.4, 0.6, 1.0 / 64), ir::Wrap::repeat).color.r;
  for (double texels = 1; texels < 80; texels *= 1.01) {
    const double now =
        pyramid.lookup(image, place(0.4, 0.6, texels / 64), ir::Wrap::repeat).color.r;
    EXPECT_NEAR(now, last, 0.02) << texels;
    last = now;
  }
}

TEST(Pyramid, ItsMemoryIsKnownBefore) {
  const DecodedImage image = random_image(4, 4, 3);
  EXPECT_EQ(Pyramid::memory_for(image), (2U * 2 + 1) * 3 * sizeof(float));
}

// A fine chequered floor towards the horizon, one sample a pixel: by point lookups far pixels are
// black or white, by trilinear ones they are the mean.
TEST(Pyramid, FarAwayATextureShowsItsMean) {
  const auto spread_of_far_pixels = [](ir::TextureFilter filter) {
    test::SceneKit kit;
    MemoryFileSystem files;
    files.put("board.ppm",
              std::string("P6 2 2 255\n") + "\xff\xff\xff" + std::string(6, '\0') + "\xff\xff\xff");
    ir::ImageTexture texture;
    texture.file = kit.asset("board.ppm");
    texture.filter = filter;
    texture.scale = {400, 400};
    ir::MaterialCommon common;
    common.emission.value = ir::white;
    common.emission.texture = kit.texture(texture);
    kit.place(ir::Quad{{-50, 0, 50}, {100, 0, 0}, {0, 0, -100}},
              kit.material(ir::Diffuse{{ir::black, {}}}, common));
    kit.pinhole({0, 1, 50}, {0, 0.9, 0}, 40);
    kit.settings.size = {32, 32};
    kit.settings.samples = 1;
    kit.settings.method = ir::Method::whitted;
    const Picture picture = test::Ready(kit.finish(), files).render();
    double spread = 0;
    for (int x = 0; x < 32; ++x)  // just below the horizon
      spread = std::fmax(spread, std::fabs(test::pixel(picture, x, 18).g - 0.5));
    return spread;
  };
  EXPECT_GT(spread_of_far_pixels(ir::TextureFilter::bilinear), 0.3);
  EXPECT_LT(spread_of_far_pixels(ir::TextureFilter::trilinear), 0.02);
}

}  // namespace
}  // namespace scenec::backend
