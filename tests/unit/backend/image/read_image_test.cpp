#include "backend/image/read_image.hpp"

#include <gtest/gtest.h>
#include <turbojpeg.h>

#include "backend/image/write_image.hpp"
#include "tests/support/hostile.hpp"
#include "tests/unit/backend/image/png_bytes.hpp"

namespace scenec::backend {
namespace {

using namespace std::string_literals;
using Bytes = std::vector<std::uint8_t>;

bool readable(std::string_view bytes) {
  return read_image(bytes, "tga").ok();
}

std::string problem_of(std::string_view bytes, std::string_view hint = "",
                       const ImageLimits& limits = {}) {
  const Result<DecodedImage, AssetProblem> image = read_image(bytes, hint, limits);
  return image ? "read" : image.error().message;
}

DecodedImage image_of(std::string_view bytes, std::string_view hint = "") {
  Result<DecodedImage, AssetProblem> image = read_image(bytes, hint);
  EXPECT_TRUE(image.ok()) << image.error().message;
  return image ? std::move(image).value() : DecodedImage{};
}

Bytes bytes_of(const DecodedImage& image) {
  const auto* bytes = std::get_if<Bytes>(&image.samples);
  EXPECT_NE(bytes, nullptr);
  return bytes == nullptr ? Bytes{} : *bytes;
}

std::string small_png() {
  Bytes rgb;
  for (int i = 0; i < 5 * 4 * 3; ++i) rgb.push_back(static_cast<std::uint8_t>(i * 37));
  return encode_png({5, 4, rgb}, {{"Title", "test"}}).value();
}

std::string small_bmp() {
  Bytes rgb(5 * 4 * 3, 99);
  return encode_bmp({5, 4, rgb}).value();
}

std::string small_exr() {
  std::vector<float> plane(20 * 20);
  for (std::size_t i = 0; i < plane.size(); ++i) plane[i] = static_cast<float>(i) * 0.25f;
  const ExrChannel channels[] = {{"R", plane}, {"G", plane}, {"B", plane, 1, ExrDepth::half}};
  return encode_exr(20, 20, channels, {}).value();
}

std::string small_jpeg(int width, int height) {
  Bytes rgb(static_cast<std::size_t>(width * height * 3));
  for (std::size_t i = 0; i < rgb.size(); ++i) rgb[i] = static_cast<std::uint8_t>(i * i);
  unsigned char* data = nullptr;
  unsigned long size = 0;
  tjhandle handle = tjInitCompress();
  tjCompress2(handle, rgb.data(), width, 0, height, TJPF_RGB, &data, &size, TJSAMP_444, 90, 0);
  const std::string bytes(reinterpret_cast<const char*>(data), size);
  tjFree(data);
  tjDestroy(handle);
  return bytes;
}

std::string tga_header(int type, int width, int height, int bits) {
  std::string bytes(18, '\0');
  bytes[2] = static_cast<char>(type);
  bytes[12] = static_cast<char>(width & 0xFF);
  bytes[13] = static_cast<char>(width >> 8);
  bytes[14] = static_cast<char>(height & 0xFF);
  bytes[15] = static_cast<char>(height >> 8);
  bytes[16] = static_cast<char>(bits);
  bytes[17] = '\x20';  // from the top
  return bytes;
}

const std::string tga_raw = tga_header(2, 2, 2, 24) + "abcdefghijkl";
const std::string tga_runs = tga_header(10, 4, 2, 24) +
                             "\x83"
                             "abc"
                             "\x03"
                             "abcdefghijkl";
const std::string hdr =
    "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 2 +X 2\n"
    "\x80\x40\x20\x81"
    "\x80\x80\x80\x80"
    "\1\2\3\x88"
    "\0\0\0\0"s;
// Run-length coded: width 8, four planes of one run each.
const std::string hdr_runs =
    "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 1 +X 8\n"
    "\2\2\0\x08"
    "\x88\x80\x88\x40\x88\x20\x88\x81"s;

TEST(ReadImage, ReadsPngOfEveryKind) {
  const DecodedImage rgb = image_of(small_png(), "jpg");  // the name may be wrong
  EXPECT_EQ(rgb.width, 5u);
  EXPECT_EQ(rgb.channels, 3u);
  EXPECT_EQ(rgb.encoding, SampleEncoding::srgb);
  EXPECT_EQ(bytes_of(rgb)[7], static_cast<std::uint8_t>(7 * 37));

  EXPECT_EQ(bytes_of(image_of(png_file(png_header(4, 1, 2, 0), "\0\x1B"s))),
            (Bytes{0, 85, 170, 255}));
  const std::string palette = png_chunk("PLTE", "\1\2\3\4\5\6") + png_chunk("tRNS", "\x80");
  const DecodedImage indexed = image_of(png_file(png_header(2, 1, 8, 3), "\0\1\0"s, palette));
  EXPECT_EQ(bytes_of(indexed), (Bytes{4, 5, 6, 255, 1, 2, 3, 128}));
  const DecodedImage deep = image_of(png_file(png_header(1, 1, 16, 4), "\0\x12\x34\xFF\xFF"s));
  EXPECT_EQ(std::get<std::vector<std::uint16_t>>(deep.samples),
            (std::vector<std::uint16_t>{0x1234, 0xFFFF}));
  // Interlaced 2 x 2: passes 1 (0,0), 6 (1,0), 7 (row 1).
  const DecodedImage woven = image_of(png_file(png_header(2, 2, 8, 0, 1), "\0\1\0\2\0\3\4"s));
  EXPECT_EQ(bytes_of(woven), (Bytes{1, 2, 3, 4}));
}

TEST(ReadImage, RefusesDamagedPng) {
  const std::string header = png_header(2, 1, 8, 0);
  EXPECT_EQ(problem_of(png_file(header, "\0\1\2"s)), "read");
  EXPECT_NE(problem_of(png_file(header, "\0\1"s)), "read") << "too few rows";
  EXPECT_NE(problem_of(png_file(header, "\0\1\2\3\4\5\6\7"s)), "read") << "too many rows";
  EXPECT_NE(problem_of(png_file(header, "\7\1\2"s)), "read") << "unknown filter";
  const std::string palette = png_chunk("PLTE", "\1\2\3");
  EXPECT_NE(problem_of(png_file(png_header(2, 1, 8, 3), "\0\0\7"s, palette)), "read");
  EXPECT_NE(problem_of(png_file(png_header(2, 1, 8, 3), "\0\0\0"s)), "read") << "no palette";
  std::string crc = png_file(header, "\0\1\2"s);
  crc[29] = static_cast<char>(crc[29] ^ 1);
  EXPECT_NE(problem_of(crc), "read");
  crc = png_file(header, "\0\1\2"s, png_chunk("tEXt", "a\0b"s));
  crc[crc.find("tEXt") + 4] = 'z';
  EXPECT_NE(problem_of(crc), "read") << "checksum of an unused chunk";
  std::string length = header +
                       "\x7F\xFF\xFF\xFF"
                       "IDAT";
  EXPECT_NE(problem_of(length), "read");
}

TEST(ReadImage, SkipsProfilesAndTexts) {
  // Profiles and texts that are bombs or plain wrong are never unpacked.
  const std::string odd = png_chunk("iCCP", "x\0\0broken"s) + png_chunk("zTXt", "k\0\0broken"s) +
                          png_chunk("gAMA", "\0\0\0\0"s) + png_chunk("acTL", "\0\0\0\1\0\0\0\0"s);
  EXPECT_EQ(problem_of(png_file(png_header(2, 1, 8, 0), "\0\1\2"s, odd)), "read");
}

TEST(ReadImage, BelievesNoSize) {
  EXPECT_NE(problem_of(png_file(png_header(0x7FFF'FFFF, 0x7FFF'FFFF, 8, 6), "\0"s)), "read");
  EXPECT_EQ(problem_of(png_file(png_header(16'384, 16'384, 8, 2), "\0"s)),
            "PNG file of 69 bytes cannot hold 16384 x 16384 pixels");
  EXPECT_EQ(problem_of(png_file(png_header(16'384, 16'384, 16, 2), "\0"s)),
            "16384 x 16384 pixels take 1610612736 bytes; at most 1073741824 are allowed");
  std::string bmp = small_bmp();
  bmp[18 + 1] = '\x20';  // width 0x2005
  EXPECT_EQ(problem_of(bmp), "BMP file ends too early for 8197 x 4 pixels");
  EXPECT_EQ(problem_of(tga_header(2, 16'000, 16'000, 24), "tga"),
            "TGA file ends too early for 16000 x 16000 pixels");
  EXPECT_EQ(problem_of(tga_header(10, 16'000, 16'000, 24), ".TGA"),
            "TGA file ends too early for 16000 x 16000 pixels");
  EXPECT_EQ(problem_of("#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 9000 +X 9000\n"),
            "HDR file ends too early for 9000 x 9000 pixels");
  EXPECT_EQ(problem_of("P5 99999 2 255 "),
            "declared size 99999 x 2; at most 16384 pixels a side are allowed");
  EXPECT_EQ(problem_of("P5 999 999 255 "), "999 x 999 pixels need 998001 bytes, 0 follow");
  EXPECT_EQ(problem_of("P5 0 2 255 "), "declared size 0 x 2 has no pixels");
  std::string jpeg = small_jpeg(16, 16);
  const std::size_t frame = jpeg.find("\xFF\xC0");
  jpeg[frame + 5] = jpeg[frame + 7] = '\x3F';
  EXPECT_TRUE(problem_of(jpeg).starts_with("damaged JPEG: ")) << problem_of(jpeg);
  jpeg[frame + 5] = '\xFF';
  EXPECT_TRUE(problem_of(jpeg).starts_with("declared size ")) << problem_of(jpeg);
}

TEST(ReadImage, HoldsItsLimits) {
  ImageLimits limits;
  limits.side = 4;
  EXPECT_NE(problem_of(small_png(), "", limits), "read");
  limits.side = 5;
  EXPECT_EQ(problem_of(small_png(), "", limits), "read");
  limits.decoded_bytes = 60;
  EXPECT_EQ(problem_of(small_png(), "", limits), "read");
  limits.decoded_bytes = 59;
  EXPECT_EQ(problem_of(small_png(), "", limits),
            "5 x 4 pixels take 60 bytes; at most 59 are allowed");
  limits.file_bytes = 10;
  EXPECT_NE(problem_of(small_png(), "", limits), "read");
}

TEST(ReadImage, ReadsJpeg) {
  const DecodedImage image = image_of(small_jpeg(17, 9), "png");
  EXPECT_EQ(image.width, 17u);
  EXPECT_EQ(image.height, 9u);
  EXPECT_EQ(bytes_of(image).size(), 17u * 9 * 3);
}

TEST(ReadImage, ReadsTga) {
  EXPECT_EQ(bytes_of(image_of(tga_raw, "tga")),
            (Bytes{'c', 'b', 'a', 'f', 'e', 'd', 'i', 'h', 'g', 'l', 'k', 'j'}));
  EXPECT_EQ(bytes_of(image_of(tga_runs + "TRUEVISION-XFILE.\0"s))[9], 'c');
  EXPECT_TRUE(problem_of(tga_raw).starts_with("no known picture format begins with"));
}

TEST(ReadImage, ReadsHdrInLinearLight) {
  const DecodedImage image = image_of(hdr);
  EXPECT_EQ(image.encoding, SampleEncoding::linear);
  const auto& samples = std::get<std::vector<float>>(image.samples);
  EXPECT_EQ(samples[0], 1.0f);
  EXPECT_EQ(samples[1], 0.5f);
  EXPECT_EQ(samples[2], 0.25f);
  EXPECT_EQ(samples.back(), 0.0f);
  EXPECT_EQ(std::get<std::vector<float>>(image_of(hdr_runs).samples)[21], 1.0f);
}

TEST(ReadImage, ReadsPnm) {
  EXPECT_EQ(bytes_of(image_of("P2 # gray\n2 2\n100\n0 50\n100 1")), (Bytes{0, 128, 255, 3}));
  EXPECT_EQ(bytes_of(image_of("P3 1 1 255 1 2 3 ")), (Bytes{1, 2, 3}));
  EXPECT_EQ(bytes_of(image_of("P6\n1 2\n255\nabcdef")), (Bytes{'a', 'b', 'c', 'd', 'e', 'f'}));
  EXPECT_EQ(std::get<std::vector<std::uint16_t>>(image_of("P5 1 1 65535 \x12\x34").samples)[0],
            0x1234);
  EXPECT_EQ(problem_of("P5 1 1 100 \x65"), "value 101 at byte 12 is above the declared 100");
  EXPECT_EQ(problem_of("P2 2 2 9 1 2 3"), "2 x 2 pixels need 7 bytes, 5 follow");
  EXPECT_EQ(problem_of("P4 8 1 a"), "bilevel PBM is not supported");
  EXPECT_EQ(problem_of("P5 1 1 70000 a"), "largest value is 70000; needs 1 to 65535");
}

TEST(ReadImage, ReplacesAndCountsWhatIsNotFiniteInExr) {
  const float plane[] = {1.0f, INFINITY, NAN, -2.0f};
  const ExrChannel channels[] = {{"Y", plane}};
  const DecodedImage image = image_of(encode_exr(2, 2, channels, {}).value());
  EXPECT_EQ(image.channels, 1u);
  EXPECT_EQ(image.replaced_samples, 2u);
  EXPECT_EQ(std::get<std::vector<float>>(image.samples), (std::vector<float>{1, 0, 0, -2}));
  const ExrChannel depth[] = {{"Z", plane}};
  EXPECT_EQ(problem_of(encode_exr(2, 2, depth, {}).value()),
            "EXR has no channels `R`, `G`, `B` or `Y`; it has `Z`");
}

// Found by fuzz_image: stb asked for the rest of such a header for ever.
TEST(ReadImage, RefusesAnHdrHeaderWithoutAnEnd) {
  const std::string start = "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n";
  EXPECT_EQ(problem_of(start), "damaged HDR: its header has no end");
  EXPECT_EQ(problem_of(start + "-Y 1 +X 8\n"), "damaged HDR: its header has no end");
  EXPECT_EQ(problem_of(start + "\n-Y 1 +X 8"), "damaged HDR: its header has no end");
  EXPECT_EQ(problem_of("#?RADIANCE\n" + std::string(300, 'x') + "\n-Y 1 +X 8\n"),
            "damaged HDR: its header has no end");
  EXPECT_NE(problem_of("#?RADIANCE\n\n-Y 1 +X 8\n"), "read");
}

TEST(ReadImage, RefusesWhatItDoesNotKnow) {
  EXPECT_EQ(problem_of(""), "file is empty");
  EXPECT_EQ(problem_of("GIF89a......"),
            "no known picture format begins with `GIF89a..`; needs PNG, JPEG, EXR, HDR, BMP, TGA "
            "or PNM");
}

TEST(ReadImage, RefusesEveryPrefix) {
  const std::pair<const char*, std::string> files[] = {
      {"png", small_png()},   {"bmp", small_bmp()},       {"exr", small_exr()},
      {"tga raw", tga_raw},   {"tga runs", tga_runs},     {"hdr", hdr},
      {"hdr runs", hdr_runs}, {"pgm", "P5 2 2 255 abcd"}, {"ppm", "P3 1 1 255 1 2 3"}};
  for (const auto& [name, bytes] : files) {
    EXPECT_TRUE(readable(bytes)) << name;
    EXPECT_EQ(scenec::test::read_every_prefix(bytes, readable), 0u) << name;
  }
  // What follows a JPEG's last coded block (its end mark) carries no pixels.
  EXPECT_LE(scenec::test::read_every_prefix(small_jpeg(16, 16), readable), 2u);
}

TEST(ReadImage, SurvivesRandomDamage) {
  std::uint32_t seed = 100;
  for (const std::string& bytes : {small_png(), small_bmp(), small_jpeg(16, 16), tga_raw, tga_runs,
                                   hdr, hdr_runs, "P6 2 2 255 abcdefghijkl"s}) {
    scenec::test::read_with_random_damage(bytes, ++seed, 4'000, readable);
  }
  scenec::test::read_with_random_damage(small_exr(), ++seed, 4'000, readable);
  // Past the checksums: damage inside a PNG whose checksums are right.
  for (int at = 0; at < 13; ++at) {
    for (int value = 0; value < 256; value += 5) {
      std::string header = png_header(3, 3, 8, 2);
      std::string data = header.substr(16, 13);
      data[static_cast<std::size_t>(at)] = static_cast<char>(value);
      static_cast<void>(readable("\x89PNG\r\n\x1a\n" + png_chunk("IHDR", data) +
                                 png_chunk("IDAT", stored_zlib(std::string(30, '\0'))) +
                                 png_chunk("IEND", "")));
    }
  }
}

}  // namespace
}  // namespace scenec::backend
