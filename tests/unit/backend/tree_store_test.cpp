// Builds that follow each other share the trees of meshes that have not changed.
#include "backend/accel/tree_store.hpp"

#include <gtest/gtest.h>

#include "backend/backend.hpp"
#include "base/file_system.hpp"
#include "tests/unit/backend/scene_kit.hpp"

namespace scenec::backend::test {
namespace {

// A tetrahedron of some height beside a square, moved aside.
Picture picture_of(double height, double aside, TreeStore* trees) {
  SceneKit kit;
  kit.pinhole({0, 1, 4}, {0, 0.5, 0}, 40);
  ir::Mesh peak;
  peak.vertices = {{-1, 0, -1}, {1, 0, -1}, {0, 0, 1}, {0, height, 0}};
  peak.faces = {{0, 1, 2}, {0, 3, 1}, {1, 3, 2}, {2, 3, 0}};
  ir::Mesh square;
  square.vertices = {{-1, 0, -2}, {1, 0, -2}, {1, 2, -2}, {-1, 2, -2}};
  square.faces = {{0, 1, 2, 3}};
  const ir::TransformId place = kit.transform({1, 0, 0, aside, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1});
  kit.place(peak, kit.matt(0.5), place);
  kit.place(square, kit.matt(0.8));
  kit.light(ir::PointLight{{2, 3, 3}, 40, {}, ir::Decay::inverse_square, ir::white});
  const ir::Scene scene = kit.finish();
  MemoryFileSystem files;
  DiagnosticSink sink;
  ThreadPool pool(2);
  const PreparedPtr prepared = prepare(scene, files, pool, sink);
  EXPECT_TRUE(prepared);
  const RenderScenePtr built = build(*prepared, pool, {.trees = trees});
  ir::RenderSettings settings = scene.render;
  settings.size = {24, 16};
  settings.samples = 2;
  return render(*built, settings, pool, {}, [](const Progress&) {});
}

TEST(TreeStore, OnlyWhatChangedIsBuiltAgain) {
  TreeStore trees;
  const auto check = [&](double height, double aside) {
    EXPECT_EQ(picture_of(height, aside, &trees).rgb, picture_of(height, aside, nullptr).rgb);
    EXPECT_EQ(trees.size(), 2U);
  };
  check(1, 0);
  TriangleMesh square;
  square.positions = {{-1, 0, -2}, {1, 0, -2}, {1, 2, -2}, {-1, 2, -2}};
  square.faces = {{0, 1, 2}, {0, 2, 3}};
  const Hash128 key = TreeStore::key_of(square, Precision::mixed);
  const auto kept = trees.find(key);
  ASSERT_NE(kept, nullptr);
  check(1, 0.25);  // moved: both trees stay
  EXPECT_EQ(trees.find(key), kept);
  check(1.5, 0.25);  // another shape: its old tree goes
  EXPECT_EQ(trees.find(key), kept);
  EXPECT_EQ(trees.find(TreeStore::key_of(square, Precision::full)), nullptr);
}

// What an edit may touch of a scene of many things: one place, a look, a lamp, the camera.
struct Edit {
  double aside = 0;
  double gray = 0.5;
  double power = 40;
  double eye = 4;
  double radius = 0.5;
};

ir::Scene busy_scene(const Edit& edit) {
  SceneKit kit;
  kit.pinhole({0, 1, edit.eye}, {0, 0.5, 0}, 40);
  const auto at = [&](double x, double y) {
    return kit.transform({1, 0, 0, x, 0, 1, 0, y, 0, 0, 1, 0, 0, 0, 0, 1});
  };
  ir::Sphere ball;
  ball.radius = Length{edit.radius};
  kit.place(ball, kit.matt(edit.gray), at(edit.aside, 0.5));
  ir::Cylinder post;
  post.base = {-1, 0, 0};
  post.top = {-1, 1, 0};
  post.radius = Length{0.1};
  kit.place(post, kit.matt(0.3));
  ir::Revolve vase;
  vase.profile = {.kind = ir::CurveKind::bezier,
                  .points = {{0.2, 0}, {0.4, 0.3}, {0.1, 0.6}, {0.3, 1}}};
  kit.place(vase, kit.matt(0.4), at(1, 0));
  ir::Triangle sail;
  sail.vertices = {{{-1, 0, -1}, {1, 0, -1}, {0, 2, -1}}};
  sail.normals = {{{0, 0, 1}, {0.1, 0, 1}, {0, 0.1, 1}}};
  kit.place(sail, kit.matt(0.6));
  kit.light(ir::PointLight{{2, 3, 3}, edit.power, {}, ir::Decay::inverse_square, ir::white});
  return kit.finish();
}

TEST(TreeStore, CameraLightAndMaterialBuildNothing) {
  TreeStore trees;
  ThreadPool pool(2);
  const auto made_by = [&](const Edit& edit) {
    const ir::Scene scene = busy_scene(edit);
    MemoryFileSystem files;
    DiagnosticSink sink;
    const PreparedPtr prepared = prepare(scene, files, pool, sink);
    const auto before = trees.mesh_counts().made + trees.world_counts().made;
    const RenderScenePtr kept = build(*prepared, pool, {.trees = &trees});
    const RenderScenePtr fresh = build(*prepared, pool);
    ir::RenderSettings settings = scene.render;
    settings.size = {24, 16};
    settings.samples = 2;
    EXPECT_EQ(render(*kept, settings, pool, {}, [](const Progress&) {}).rgb,
              render(*fresh, settings, pool, {}, [](const Progress&) {}).rgb);
    return trees.mesh_counts().made + trees.world_counts().made - before;
  };
  EXPECT_EQ(made_by({}), 2U);  // the sail's and the world's
  EXPECT_EQ(made_by({.gray = 0.2}), 0U);
  EXPECT_EQ(made_by({.power = 20}), 0U);
  EXPECT_EQ(made_by({.eye = 5}), 0U);
  EXPECT_EQ(made_by({.aside = 0.1}), 1U);  // the world's alone
  EXPECT_EQ(made_by({.aside = 0.1, .radius = 0.4}), 1U);
  EXPECT_EQ(made_by({.aside = 0.1, .radius = 0.4}), 0U);
}

}  // namespace
}  // namespace scenec::backend::test
