#include "backend/image/exr_header.hpp"

#include <gtest/gtest.h>

#include "backend/image/exr.hpp"

namespace scenec::backend {
namespace {

using namespace std::string_literals;

std::string sample() {
  const float pixels[4] = {};
  const ExrChannel channels[] = {{"Y", pixels}};
  return encode_exr(2, 2, channels, {}).value();
}

// The first byte of an attribute's value.
std::size_t value_of(const std::string& bytes, const std::string& name, const std::string& type) {
  const std::string key = name + '\0' + type + '\0';
  return bytes.find(key) + key.size() + 4;
}

std::string problem_of(const std::string& bytes) {
  const auto problem = find_exr_header_problem(bytes, {});
  EXPECT_EQ(read_exr(bytes).ok(), !problem);
  return problem ? problem->message : "fine";
}

void put32(std::string& bytes, std::size_t at, std::uint32_t value) {
  for (std::size_t i = 0; i < 4; ++i) bytes[at + i] = static_cast<char>(value >> (8 * i));
}

TEST(ExrHeader, RefusesWindowsThatLie) {
  EXPECT_EQ(problem_of(sample()), "fine");
  std::string bytes = sample();
  const std::size_t window = value_of(bytes, "dataWindow", "box2i");
  put32(bytes, window + 8, 0x7FFF'FFFF);
  EXPECT_EQ(problem_of(bytes),
            "declared size 2147483648 x 2; at most 16384 pixels a side are allowed");
  put32(bytes, window, 0x8000'0000);
  EXPECT_EQ(problem_of(bytes),
            "declared size 4294967296 x 2; at most 16384 pixels a side are allowed");
  put32(bytes, window + 8, 0x8000'0000);
  put32(bytes, window, 5);
  EXPECT_EQ(problem_of(bytes), "EXR data window is empty");
  bytes = sample();
  put32(bytes, window + 12, 16'000);
  EXPECT_EQ(problem_of(bytes), "EXR chunk table ends too early");
}

TEST(ExrHeader, RefusesWhatIsNotOneFlatPart) {
  std::string bytes = sample();
  bytes[5] = '\x10';
  EXPECT_EQ(problem_of(bytes), "EXR with several parts is not supported");
  bytes[5] = '\x08';
  EXPECT_EQ(problem_of(bytes), "deep EXR is not supported");
  bytes[5] = '\x02';
  EXPECT_EQ(problem_of(bytes), "tiled EXR without a tile size");
  bytes[4] = '\x01';
  EXPECT_EQ(problem_of(bytes), "EXR version 1 is not known");
}

TEST(ExrHeader, RefusesAttributesThatLieAboutTheirSize) {
  std::string bytes = sample();
  put32(bytes, value_of(bytes, "dataWindow", "box2i") - 4, 15);
  EXPECT_EQ(problem_of(bytes), "EXR attribute `dataWindow` has the wrong size");
  bytes = sample();
  put32(bytes, value_of(bytes, "channels", "chlist") - 4, 0x7FFF'FFFF);
  EXPECT_EQ(problem_of(bytes), "EXR header is damaged or ends too early");
  bytes = sample();
  const std::size_t channel = value_of(bytes, "channels", "chlist");
  put32(bytes, channel + 2 + 8, 2);
  EXPECT_EQ(problem_of(bytes), "EXR channel `Y` is subsampled, which is not supported");
}

TEST(ExrHeader, RefusesAttributesThatComeTwice) {
  std::string bytes = sample();
  const std::size_t at = bytes.find("dataWindow");
  bytes.insert(at, bytes.substr(at, "dataWindow"s.size() + 1 + "box2i"s.size() + 1 + 4 + 16));
  EXPECT_EQ(problem_of(bytes), "EXR attribute `dataWindow` is damaged or there twice");
}

}  // namespace
}  // namespace scenec::backend
