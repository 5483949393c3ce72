// Meshes and trees from the cache: the same picture to the bit, and nothing that is wrong with an
// entry is seen in it.
#include <gtest/gtest.h>

#include <cstring>
#include <filesystem>
#include <memory>
#include <string>

#include "backend/accel/tree_codec.hpp"
#include "backend/backend.hpp"
#include "backend/prepared_scene.hpp"
#include "tests/support/hostile.hpp"
#include "tests/unit/backend/scene_kit.hpp"
#include "tests/unit/base/temporary_directory.hpp"

namespace scenec::backend::test {
namespace {

// A bumpy sheet as OBJ text; decimals that are no floats, so that the tree moves its vertices.
std::string sheet_obj(int side) {
  std::string text;
  for (int y = 0; y <= side; ++y) {
    for (int x = 0; x <= side; ++x) {
      text += "v " + std::to_string(0.013 * x) + " " + std::to_string(0.0007 * ((x * y) % 7)) +
              " " + std::to_string(0.011 * y) + "\n";
    }
  }
  for (int y = 0; y < side; ++y) {
    for (int x = 0; x < side; ++x) {
      const int a = y * (side + 1) + x + 1;
      text += "f " + std::to_string(a) + " " + std::to_string(a + side + 1) + " " +
              std::to_string(a + side + 2) + " " + std::to_string(a + 1) + "\n";
    }
  }
  return text + "f 1 1 2\n";
}

struct Rendered {
  Picture picture;
  std::string warnings;
};

Rendered render_sheet(const std::string& obj, ContentCache* cache, ir::NormalMode normals) {
  MemoryFileSystem files;
  files.put("sheet.obj", obj);
  SceneKit kit;
  kit.pinhole({0.4, 1, 1.5}, {0.4, 0, 0.3}, 40);
  ir::Mesh mesh;
  mesh.file = kit.builder().add_asset({"sheet.obj", hash_bytes(obj), {}});
  mesh.normals.mode = normals;
  kit.place(mesh, kit.matt(0.5));
  const ir::Scene scene = kit.finish();
  DiagnosticSink sink;
  ThreadPool pool(2);
  Rendered run;
  const PreparedPtr prepared = prepare(scene, files, pool, sink, cache);
  for (const Diagnostic& d : sink.sorted()) run.warnings += d.message + "\n";
  EXPECT_TRUE(prepared) << run.warnings;
  if (!prepared) return run;
  const RenderScenePtr built = build(*prepared, pool, {.cache = cache});
  ir::RenderSettings settings = scene.render;
  settings.size = {24, 16};
  settings.samples = 1;
  run.picture = render(*built, settings, pool, {}, [](const Progress&) {});
  return run;
}

TEST(mesh_cache, the_picture_is_the_same_to_the_bit) {
  const scenec::test::TemporaryDirectory directory;
  const std::string obj = sheet_obj(60);
  const Rendered plain = render_sheet(obj, nullptr, ir::NormalMode::smooth);
  EXPECT_NE(plain.warnings.find("face without area"), std::string::npos);
  ContentCache cache({.directory = directory.path()});
  for (const std::uint64_t hits : {0U, 2U, 4U}) {
    const Rendered run = render_sheet(obj, &cache, ir::NormalMode::smooth);
    EXPECT_EQ(run.picture.rgb, plain.picture.rgb);
    EXPECT_EQ(run.warnings, plain.warnings);
    EXPECT_EQ(cache.counts().hits, hits);
  }
  EXPECT_EQ(cache.counts().stored, 2U);
  // Other normals, same tree.
  EXPECT_EQ(render_sheet(obj, &cache, ir::NormalMode::flat).picture.rgb,
            render_sheet(obj, nullptr, ir::NormalMode::flat).picture.rgb);
  EXPECT_EQ(cache.counts().hits, 6U);
  const std::string other = "# changed\n" + obj;
  EXPECT_EQ(render_sheet(other, &cache, ir::NormalMode::smooth).picture.rgb, plain.picture.rgb);
  EXPECT_EQ(cache.counts().hits, 6U);
}

TEST(mesh_cache, damaged_entries_are_mended) {
  namespace fs = std::filesystem;
  const scenec::test::TemporaryDirectory directory;
  const std::string obj = sheet_obj(60);
  ContentCache cache({.directory = directory.path()});
  const Rendered plain = render_sheet(obj, &cache, ir::NormalMode::flat);
  for (const double share : {0.0, 0.4, 0.99}) {
    for (const auto& entry : fs::directory_iterator(directory.path())) {
      fs::resize_file(entry.path(),
                      static_cast<std::uintmax_t>(share * static_cast<double>(entry.file_size())));
    }
    const std::uint64_t hits = cache.counts().hits;
    EXPECT_EQ(render_sheet(obj, &cache, ir::NormalMode::flat).picture.rgb, plain.picture.rgb);
    EXPECT_EQ(cache.counts().hits, hits);
    EXPECT_EQ(render_sheet(obj, &cache, ir::NormalMode::flat).picture.rgb, plain.picture.rgb);
    EXPECT_EQ(cache.counts().hits, hits + 2);
  }
}

std::string bytes_of(const MeshAccel& accel, const TriangleMesh& mesh) {
  const EncodedTree encoded(accel, mesh);
  std::string bytes;
  for (const std::string_view piece : encoded.pieces()) bytes += piece;
  return bytes;
}

std::shared_ptr<const TriangleMesh> fan(std::uint32_t count, double step) {
  auto mesh = std::make_shared<TriangleMesh>();
  mesh->positions.push_back({0, 0, 0});
  for (std::uint32_t i = 0; i <= count; ++i)
    mesh->positions.push_back({step * i, 1 + step * (i % 3), step * (i % 5)});
  for (std::uint32_t i = 1; i <= count; ++i) mesh->faces.push_back({0, i, i + 1});
  return mesh;
}

TEST(tree_codec, gives_back_the_tree_or_nothing) {
  ThreadPool pool(1);
  for (const double step : {0.25, 0.1}) {  // floats, and what the tree has to move
    const auto mesh = fan(70, step);
    const MeshAccel accel(mesh, pool);
    const std::string bytes = bytes_of(accel, *mesh);
    const auto decoded = decode_tree(bytes, mesh);
    ASSERT_TRUE(decoded);
    EXPECT_EQ(decoded->mesh().positions, accel.mesh().positions);
    EXPECT_EQ(bytes_of(*decoded, *mesh), bytes);
    EXPECT_FALSE(decode_tree(bytes, fan(69, step)));
    const auto read = [&](std::string_view damaged) {
      return decode_tree(damaged, mesh) != nullptr;
    };
    EXPECT_EQ(scenec::test::read_every_prefix(bytes, read), 0U);
    scenec::test::read_with_random_damage(bytes, 31, 5'000, read);
  }
}

TEST(tree_codec, references_that_lead_nowhere_are_refused) {
  ThreadPool pool(1);
  const auto mesh = fan(70, 0.25);
  const MeshAccel accel(mesh, pool);
  const std::string bytes = bytes_of(accel, *mesh);
  const auto with_root = [&](std::uint32_t root) {
    std::string damaged = bytes;
    std::memcpy(damaged.data() + 120, &root, sizeof root);
    return decode_tree(damaged, mesh) != nullptr;
  };
  EXPECT_TRUE(with_root(accel.tree().tree.root.bits()));
  EXPECT_FALSE(with_root(3));  // between two nodes
  EXPECT_FALSE(with_root(TreeRef::node(100'000).bits()));
  EXPECT_FALSE(with_root(TreeRef::leaf(100'000, 1).bits()));
}

}  // namespace
}  // namespace scenec::backend::test
