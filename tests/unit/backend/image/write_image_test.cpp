#include "backend/image/write_image.hpp"

#include <gtest/gtest.h>

#include <bit>
#include <cstring>
#include <limits>

#include "backend/image/exr.hpp"
#include "backend/image/read_image.hpp"

namespace scenec::backend {
namespace {

using Bytes = std::vector<std::uint8_t>;

Bytes noise(std::size_t size) {
  Bytes bytes(size);
  std::uint32_t state = 1;
  for (std::uint8_t& byte : bytes) {
    state = state * 1'664'525 + 1'013'904'223;
    byte = static_cast<std::uint8_t>(state >> 24);
  }
  return bytes;
}

TEST(WriteImage, PngGivesBackItsSamples) {
  for (const auto& [width, height] : {std::pair{1u, 1u}, std::pair{7u, 3u}, std::pair{640u, 97u}}) {
    const Bytes rgb = noise(std::size_t{3} * width * height);
    const std::string bytes = encode_png({width, height, rgb}).value();
    const auto image = read_image(bytes, "png");
    ASSERT_TRUE(image.ok()) << image.error().message;
    EXPECT_EQ(image.value().width, width);
    EXPECT_EQ(std::get<Bytes>(image.value().samples), rgb);
  }
}

TEST(WriteImage, PngCarriesItsTextsAndNoTime) {
  const Bytes rgb = noise(3);
  const std::string bytes =
      encode_png({1, 1, rgb},
                 {{"Software", "scenec"}, {"scenec/seed", "7"}, {"Author", "Zo\xC3\xAB"}})
          .value();
  EXPECT_NE(bytes.find(std::string("tEXtSoftware\0scenec", 19)), std::string::npos);
  EXPECT_NE(bytes.find("iTXtAuthor"), std::string::npos);
  EXPECT_NE(bytes.find("sRGB"), std::string::npos);
  EXPECT_EQ(bytes.find("tIME"), std::string::npos);
  EXPECT_FALSE(encode_png({1, 1, rgb}, {{"", "x"}}).ok());
  EXPECT_FALSE(encode_png({1, 1, rgb}, {{std::string(80, 'k'), "x"}}).ok());
  EXPECT_FALSE(encode_png({1, 1, rgb}, {{"k", std::string("a\0b", 3)}}).ok());
}

TEST(WriteImage, BmpHasTheCoursesLayout) {
  const Bytes rgb = noise(200 * 200 * 3);
  const std::string bytes = encode_bmp({200, 200, rgb}).value();
  const unsigned char header[54] = {0x42, 0x4D, 0xF6, 0xD4, 0x01, 0x00, 0,    0,   0,    0,
                                    0x36, 0,    0,    0,    0x28, 0,    0,    0,   0xC8, 0,
                                    0,    0,    0xC8, 0,    0,    0,    1,    0,   0x18, 0,
                                    0,    0,    0,    0,    0xC0, 0xD4, 0x01, 0x00};
  ASSERT_EQ(bytes.size(), 120'054u);
  EXPECT_EQ(std::memcmp(bytes.data(), header, sizeof header), 0);
  // Bottom row first, blue first.
  EXPECT_EQ(static_cast<std::uint8_t>(bytes[54]), rgb[199 * 600 + 2]);
  for (const std::uint32_t width : {1u, 2u, 3u, 4u, 5u}) {
    const Bytes narrow = noise(std::size_t{3} * width * 3);
    const auto image = read_image(encode_bmp({width, 3, narrow}).value(), "");
    ASSERT_TRUE(image.ok()) << image.error().message;
    EXPECT_EQ(std::get<Bytes>(image.value().samples), narrow);
  }
}

std::vector<float> odd_floats(std::size_t size) {
  std::vector<float> values(size);
  const Bytes bytes = noise(size * sizeof(float));
  std::memcpy(values.data(), bytes.data(), bytes.size());  // NaNs and infinities among them
  return values;
}

const std::vector<ExrAttribute> attributes = {{"chromaticities", Chromaticities{}},
                                              {"scenec/exposure", 0.5f},
                                              {"scenec/seed", std::string("18446744073709551615")},
                                              {"scenec/spp", std::int32_t{64}}};

TEST(WriteImage, ExrGivesBackItsBits) {
  const std::uint32_t width = 33, height = 300;
  const std::vector<float> colour = odd_floats(std::size_t{3} * width * height);
  const std::vector<float> depth = odd_floats(std::size_t{width} * height);
  const std::span<const float> all(colour);
  const ExrChannel channels[] = {
      {"R", all, 3}, {"G", all.subspan(1), 3}, {"B", all.subspan(2), 3}, {"N.X", depth}};
  const std::string bytes = encode_exr(width, height, channels, attributes).value();
  const auto image = read_exr(bytes);
  ASSERT_TRUE(image.ok()) << image.error().message;
  ASSERT_EQ(image.value().planes.size(), 4u);
  EXPECT_EQ(image.value().planes[1].name, "G");
  EXPECT_EQ(image.value().planes[2].name, "N.X");
  for (std::size_t i = 0; i < depth.size(); ++i) {
    ASSERT_EQ(std::bit_cast<std::uint32_t>(image.value().planes[1].samples[i]),
              std::bit_cast<std::uint32_t>(colour[3 * i + 1]));
    ASSERT_EQ(std::bit_cast<std::uint32_t>(image.value().planes[2].samples[i]),
              std::bit_cast<std::uint32_t>(depth[i]));
  }
}

TEST(WriteImage, ExrCarriesItsAttributesAndNoDate) {
  const float pixel[] = {1};
  const ExrChannel channels[] = {{"Y", pixel}};
  const std::string bytes = encode_exr(1, 1, channels, attributes).value();
  EXPECT_EQ(bytes.find("capDate"), std::string::npos);
  const auto image = read_exr(bytes);
  ASSERT_TRUE(image.ok()) << image.error().message;
  for (const ExrAttribute& wanted : attributes) {
    bool found = false;
    for (const ExrAttribute& read : image.value().attributes) {
      found = found || (read.name == wanted.name && read.value == wanted.value);
    }
    EXPECT_TRUE(found) << wanted.name;
  }
}

TEST(WriteImage, ExrRoundsToHalfWhereAsked) {
  const float pixels[] = {0.1f, 65504.0f, 1e6f, -0.25f};
  const ExrChannel channels[] = {{"Y", pixels, 1, ExrDepth::half}};
  const auto image = read_exr(encode_exr(2, 2, channels, {}).value());
  ASSERT_TRUE(image.ok());
  EXPECT_EQ(image.value().planes[0].depth, ExrDepth::half);
  EXPECT_EQ(image.value().planes[0].samples,
            (std::vector<float>{0.0999755859375f, 65504.0f, std::numeric_limits<float>::infinity(),
                                -0.25f}));
}

TEST(WriteImage, TwoEncodingsAreTheSameBytes) {
  const Bytes rgb = noise(64 * 48 * 3);
  const std::vector<float> plane = odd_floats(64 * 48);
  const ExrChannel channels[] = {{"Y", plane}, {"A", plane, 1, ExrDepth::half}};
  EXPECT_EQ(encode_png({64, 48, rgb}, {{"a", "b"}}).value(),
            encode_png({64, 48, rgb}, {{"a", "b"}}).value());
  EXPECT_EQ(encode_bmp({64, 48, rgb}).value(), encode_bmp({64, 48, rgb}).value());
  EXPECT_EQ(encode_exr(64, 48, channels, attributes).value(),
            encode_exr(64, 48, channels, attributes).value());
}

}  // namespace
}  // namespace scenec::backend
