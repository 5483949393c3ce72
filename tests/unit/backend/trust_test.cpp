// The layer `trust` of whole renders: which camera rays met a surface where it is not proven, and
// that asking for the layer changes nothing else.
#include <gtest/gtest.h>

#include <cmath>
#include <string_view>
#include <vector>

#include "tests/unit/backend/scene_kit.hpp"

namespace scenec::backend::test {
namespace {

ir::Revolve baluster(ir::RevolveSolver solver) {
  ir::Revolve shape;
  shape.profile = {ir::CurveKind::bezier, true, {{0.3, -1}, {1.1, -0.4}, {0.1, 0.3}, {0.5, 1}}};
  shape.solver = solver;
  return shape;
}

enum class Placing { plain, instanced };

Picture picture_of(ir::RevolveSolver solver, Placing placing, ir::Method method,
                   std::vector<ir::Aov> aovs) {
  SceneKit kit;
  const ir::MaterialId matt = kit.matt(0.5);
  if (placing == Placing::plain) {
    kit.place(baluster(solver), matt);
  } else {
    const ir::TransformId turned =
        kit.transform({0, -1, 0, 0.25, 1, 0, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1});
    const ir::ProtoId proto = kit.proto({kit.item(baluster(solver), matt, kit.identity())});
    kit.place(ir::Instance{proto}, matt, turned);
  }
  kit.light(ir::PointLight{{2, 3, 5}, 100.0, {}, ir::Decay::inverse_square, ir::white});
  kit.pinhole({0, 0.4, 4}, {0, 0, 0}, 45);
  kit.settings.samples = 8;
  kit.settings.filter = {ir::FilterKind::box, 0.5};
  kit.settings.method = method;
  kit.settings.aovs = std::move(aovs);
  return render(kit);
}

const std::vector<float>& layer(const Picture& picture, std::string_view name) {
  for (const auto& [own, values] : picture.layers)
    if (own == name) return values;
  static const std::vector<float> none;
  ADD_FAILURE() << name;
  return none;
}

class Trust : public testing::TestWithParam<ir::Method> {};

TEST_P(Trust, CountsEveryHitOfTheCoursesIterationAndNoneThatIsCertified) {
  for (const Placing placing : {Placing::plain, Placing::instanced}) {
    for (const ir::RevolveSolver solver : {ir::RevolveSolver::certified, ir::RevolveSolver::newton,
                                           ir::RevolveSolver::tessellated}) {
      const Picture picture = picture_of(solver, placing, GetParam(), {ir::Aov::trust});
      const std::vector<float>& uncertified = layer(picture, "trust.uncertified");
      ASSERT_EQ(uncertified.size(), picture.alpha.size());
      float hits = 0;
      for (std::size_t i = 0; i < uncertified.size(); ++i) {
        const float of_pixel = std::round(8 * picture.alpha[i]);
        EXPECT_EQ(uncertified[i], solver == ir::RevolveSolver::newton ? of_pixel : 0) << i;
        hits += of_pixel;
      }
      EXPECT_GT(hits, 200);
    }
  }
}

TEST_P(Trust, ChangesNothingElse) {
  const auto render_with = [](std::vector<ir::Aov> aovs) {
    return picture_of(ir::RevolveSolver::newton, Placing::plain, GetParam(), std::move(aovs));
  };
  const Picture plain = render_with({});
  const Picture alone = render_with({ir::Aov::trust});
  EXPECT_EQ(alone.rgb, plain.rgb);
  EXPECT_EQ(alone.alpha, plain.alpha);
  const std::vector<ir::Aov> others{ir::Aov::albedo, ir::Aov::normal,   ir::Aov::depth,
                                    ir::Aov::uv,     ir::Aov::position, ir::Aov::ids};
  std::vector<ir::Aov> all = others;
  all.push_back(ir::Aov::trust);
  const Picture without = render_with(others);
  const Picture with = render_with(all);
  EXPECT_EQ(with.rgb, plain.rgb);
  ASSERT_EQ(with.layers.size(), without.layers.size() + 3);
  for (std::size_t i = 0; i < without.layers.size(); ++i)
    EXPECT_EQ(with.layers[i], without.layers[i]);
}

INSTANTIATE_TEST_SUITE_P(Methods, Trust,
                         testing::Values(ir::Method::path, ir::Method::whitted, ir::Method::phong));

}  // namespace
}  // namespace scenec::backend::test
