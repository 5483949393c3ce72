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

}  // namespace
}  // namespace scenec::backend::test
