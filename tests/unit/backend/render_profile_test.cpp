// What a profile counts is what a walk by hand would.
#include "backend/render_profile.hpp"

#include "backend/render_scene.hpp"
#include "tests/unit/backend/scene_kit.hpp"

namespace scenec::backend::test {
namespace {

constexpr auto camera = static_cast<std::size_t>(RayKind::camera);
constexpr auto shadow = static_cast<std::size_t>(RayKind::shadow);

RenderProfile profile_of_kit(SceneKit& kit) {
  Ready ready(kit.finish());
  const ir::EffectSet effects = find_effects(*ready.built, ready.scene.render).simulated();
  ThreadPool pool(2);
  return profile_of(*ready.built, ready.scene.render, effects, pool, 16);
}

TEST(RenderProfile, FewShapesAreAllTestedWithoutATree) {
  SceneKit kit;
  kit.pinhole({0, 0, 5}, {0, 0, 0}, 40);
  for (int i = 0; i < 3; ++i) kit.place(ir::Sphere{{0, 0, -2.0 * i}, {1}}, kit.matt(0.5));
  kit.light(ir::PointLight{{0, 3, 5}, 100.0, {}, ir::Decay::inverse_square, ir::white});
  const RenderProfile profile = profile_of_kit(kit);
  EXPECT_GE(profile.samples, 256);
  EXPECT_EQ(profile.rays[camera].nodes, 0);
  EXPECT_EQ(profile.rays[camera].primitives, 3);
  double share = profile.lights + profile.materials + profile.rest;
  for (const auto& rays : profile.rays) share += rays.share;
  EXPECT_NEAR(share, 1, 1e-12);
  EXPECT_GT(profile.rays[camera].share, 0);
  EXPECT_GT(profile.materials, 0);
  EXPECT_EQ(profile.rays[static_cast<std::size_t>(RayKind::refracted)].share, 0);
}

TEST(RenderProfile, AnEmptySceneTestsNothing) {
  SceneKit kit;
  kit.pinhole({0, 0, 5}, {0, 0, 0}, 40);
  const RenderProfile profile = profile_of_kit(kit);
  EXPECT_EQ(profile.rays[camera].nodes, 0);
  EXPECT_EQ(profile.rays[camera].primitives, 0);
}

TEST(RenderProfile, ATreeIsVisitedForPartOfWhatItHolds) {
  SceneKit kit;
  kit.pinhole({0, 0, 30}, {0, 0, 0}, 40);
  constexpr int side = 20;
  for (int y = 0; y < side; ++y)
    for (int x = 0; x < side; ++x)
      kit.place(ir::Sphere{{x - side / 2.0, y - side / 2.0, 0}, {0.4}}, kit.matt(0.5));
  kit.light(ir::PointLight{{0, 3, 20}, 100.0, {}, ir::Decay::inverse_square, ir::white});
  const RenderProfile profile = profile_of_kit(kit);
  for (const std::size_t kind : {camera, shadow}) {
    EXPECT_GT(profile.rays[kind].nodes, 0.5);
    EXPECT_LT(profile.rays[kind].nodes, 20);
    EXPECT_GT(profile.rays[kind].primitives, 0.2);
    EXPECT_LT(profile.rays[kind].primitives, side);
  }
}

}  // namespace
}  // namespace scenec::backend::test
