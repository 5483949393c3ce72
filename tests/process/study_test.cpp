// `scenec study`: every effect and every choice is in the report, as a row or with a reason.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <set>
#include <string>

#include "tests/process/child.hpp"

namespace {

using nlohmann::json;
using scenec::test::bytes_of;
using scenec::test::ChildResult;
using scenec::test::Sandbox;
using testing::HasSubstr;

constexpr std::string_view rough_scene = R"(sdl 1;
camera main: pinhole { eye = [0m, 1m, 4m]; aim = [0m, 1m, 0m]; fov = 40deg; }
material gold: conductor { preset = .gold; roughness = 1; }
material floor: diffuse { color = gray(0.5); }
sphere { center = [0m, 1m, 0m]; radius = 1m; material = gold; }
quad { corner = [-4m, 0m, 4m]; edge_u = [8m, 0m, 0m]; edge_v = [0m, 0m, -8m]; material = floor; }
light lamp: sphere { center = [2m, 4m, 2m]; radius = 1m; radiance = 6; }
render { size = [16, 12]; samples = 16; }
)";

class Study : public testing::Test {
 protected:
  json study(const std::string& seconds) const {
    sandbox_.write("scene.sdl", std::string(rough_scene));
    const ChildResult result = scenec::test::run_child(
        {"study", "scene.sdl", "-o", "out", "--time", seconds, "--threads", "1"},
        {.directory = sandbox_.path(), .file_size_limit = {}, .standard_output = {}});
    EXPECT_EQ(result.exit_code, 0) << result.err;
    return json::parse(bytes_of(sandbox_.path() / "out" / "report.json"), nullptr, false);
  }
  Sandbox sandbox_;
};

TEST_F(Study, EveryChoiceHasARowOrAReasonAndBiasIsTold) {
  json report = study("2s");
  // What a loaded machine had no time for is done by the same command again.
  for (int again = 0; again < 8 && report.contains("left_out"); ++again) report = study("2s");
  ASSERT_TRUE(report.is_object());
  std::set<std::string> rows;
  for (const json& row : report["knobs"]) {
    rows.insert(row["name"]);
    EXPECT_TRUE(row.contains("brightness")) << row;
    EXPECT_TRUE(row.contains("error_before") && row.contains("error_after")) << row;
    if (row["name"] == "again") {
      EXPECT_EQ(row["brightness"]["value"], 0.0);
    }
    // Light lost between the facets of the metal is a bias, and told.
    if (row["name"] == "energy compensation off") {
      EXPECT_LT(row["brightness"]["high"], 0.0) << row;
    }
  }
  std::set<std::string> reasons;
  for (const json& row : report["inapplicable"]) {
    reasons.insert(row["name"]);
    EXPECT_FALSE(row["why"].get<std::string>().empty());
  }
  EXPECT_EQ(rows,
            (std::set<std::string>{
                "again", "light by aiming only", "light by chance only", "sampler .independent",
                "max_depth 2", "max_depth 4", "max_depth 8", "roulette off, max_depth 8",
                "roulette off, max_depth 32", "filter .box", "filter .gaussian", "filter .mitchell",
                "clamp at 3 × mean", "clamp at 10 × mean", "clamp at 30 × mean", "--adaptive",
                "Fresnel by Schlick", "energy compensation off"}));
  EXPECT_EQ(reasons,
            (std::set<std::string>{"--precision double", "solver .certified", "solver .newton",
                                   "solver .tessellated, 16 steps", "solver .tessellated, 64 steps",
                                   "solver .tessellated, 256 steps"}));
  const std::string page = bytes_of(sandbox_.path() / "out" / "report.html");
  for (const std::string& name : rows) EXPECT_THAT(page, HasSubstr("<b>" + name + "</b>"));
  for (const std::string& name : reasons) EXPECT_THAT(page, HasSubstr("<b>" + name + "</b>"));
  EXPECT_THAT(page, HasSubstr("does not apply: no body of revolution in this scene"));
}

}  // namespace
