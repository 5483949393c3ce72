// `--stats`: every figure adds up to the one it is a part of.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "tests/process/child.hpp"
#include "tests/support/paths.hpp"

namespace {

using nlohmann::json;
using scenec::test::bytes_of;
using scenec::test::ChildResult;
using scenec::test::Sandbox;
using testing::HasSubstr;

class Stats : public testing::Test {
 protected:
  [[nodiscard]] json of(const std::string& scene, std::vector<std::string> more) const {
    const auto path = scenec::test::source_directory() / "stdlib-scenes" / scene;
    std::vector<std::string> words{path.string(), "-o", "a.exr", "--stats=json:s.json"};
    words.insert(words.end(), more.begin(), more.end());
    const ChildResult result = scenec::test::run_child(
        words, {.directory = sandbox_.path(), .file_size_limit = {}, .standard_output = {}});
    EXPECT_EQ(result.exit_code, 0) << result.err;
    return json::parse(bytes_of(sandbox_.path() / "s.json"), nullptr, false);
  }
  Sandbox sandbox_;
};

void expect_consistent(const json& stats, double samples) {
  double rays = 0;
  for (const auto& [kind, count] : stats["rays_by_kind"].items()) rays += count.get<double>();
  EXPECT_EQ(stats["rays"].get<double>(), rays);
  EXPECT_EQ(stats["rays_by_kind"]["camera"].get<double>(), samples);
  EXPECT_NEAR(stats["samples_per_second"].get<double>() * stats["seconds"]["render"].get<double>(),
              samples, 1e-6 * samples);
  double share = 0;
  for (const auto& [kind, row] : stats["profile"]["rays"].items()) {
    share += row["share_of_time"].get<double>();
    EXPECT_GE(row["nodes_per_ray"].get<double>() + row["tests_per_ray"].get<double>(), 0);
  }
  for (const auto& [stage, part] : stats["profile"]["share_of_time"].items()) {
    EXPECT_GE(part.get<double>(), 0);
    share += part.get<double>();
  }
  EXPECT_NEAR(share, 1, 1e-9);
  for (const auto& [phase, parts] : stats["seconds_within"].items()) {
    double sum = 0;
    for (const auto& [name, seconds] : parts.items()) sum += seconds.get<double>();
    EXPECT_LE(sum, stats["seconds"][phase].get<double>() * (1 + 1e-9)) << phase;
  }
  // What lives at the same time fits into the peak; the tree is gone when the film comes.
  double memory = 0;
  for (const auto& [consumer, bytes] : stats["memory_bytes"].items())
    memory += consumer == "syntax tree" ? 0 : bytes.get<double>();
  EXPECT_LE(memory, stats["peak_mebibytes"].get<double>() * 1024 * 1024);
  double before = 0;
  for (const char* phase : {"compile", "prepare", "build", "render", "write"}) {
    const double peak = stats["peak_mebibytes_after"][phase];
    EXPECT_GE(peak, before) << phase;
    before = peak;
  }
}

TEST_F(Stats, PartsAddUpToTheWhole) {
  for (const char* scene : {"showcase/cornell.sdl", "showcase/whitted.sdl", "showcase/knot.sdl",
                            "showcase/mapping.sdl"}) {
    SCOPED_TRACE(scene);
    const json stats = of(scene, {"--size", "40x30", "--samples", "8"});
    ASSERT_TRUE(stats.is_object());
    expect_consistent(stats, 40 * 30 * 8);
    EXPECT_GT(stats["memory_bytes"]["film"], 40 * 30 * 64);
  }
}

TEST_F(Stats, AdaptiveSamplesAreCountedToo) {
  const json stats = of("showcase/cornell.sdl",
                        {"--size", "40x30", "--samples", "24", "--adaptive", "--threads", "2"});
  const double mean = stats["rays_by_kind"]["camera"].get<double>() / (40 * 30);
  EXPECT_NEAR(mean, 24, 1);
}

TEST_F(Stats, TheProfileChangesNoSample) {
  const std::vector<std::string> words{"--size", "40x30", "--samples", "8"};
  ASSERT_TRUE(of("showcase/still-life.sdl", words).is_object());
  const std::string with = bytes_of(sandbox_.path() / "a.exr");
  const auto path = scenec::test::source_directory() / "stdlib-scenes/showcase/still-life.sdl";
  ASSERT_EQ(scenec::test::run_child(
                {path.string(), "-o", "a.exr", "--size", "40x30", "--samples", "8"},
                {.directory = sandbox_.path(), .file_size_limit = {}, .standard_output = {}})
                .exit_code,
            0);
  EXPECT_EQ(with, bytes_of(sandbox_.path() / "a.exr"));
}

}  // namespace
