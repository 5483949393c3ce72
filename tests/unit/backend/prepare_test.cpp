#include "backend/prepare.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/unit/backend/scene_kit.hpp"

namespace scenec::backend::test {
namespace {

constexpr const char* cube_obj =
    "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 0 0 1\nv 1 0 1\nv 1 1 1\nv 0 1 1\n"
    "f 4 3 2 1\nf 5 6 7 8\nf 1 2 6 5\nf 2 3 7 6\nf 3 4 8 7\nf 4 1 5 8\n";

struct Prepared {
  ir::Scene scene;
  DiagnosticSink sink;
  PreparedPtr prepared;
  explicit Prepared(SceneKit& kit, MemoryFileSystem& files) : scene(kit.finish()) {
    ThreadPool pool(2);
    prepared = prepare(scene, files, pool, sink);
  }
  [[nodiscard]] std::string text() const {
    std::string all;
    for (const Diagnostic& d : sink.sorted())
      all += std::string(info_of(d.kind).name) + ": " + d.message + "\n";
    return all;
  }
};

Prepared with_mesh(MemoryFileSystem& files, const std::string& name,
                   ir::NormalMode mode = ir::NormalMode::automatic) {
  SceneKit kit;
  kit.pinhole({0, 0, 3}, {0, 0, 0}, 40);
  ir::Mesh mesh;
  mesh.file = kit.asset(name);
  mesh.unit = {2};
  mesh.normals.mode = mode;
  kit.place(mesh, kit.matt(0.5));
  return Prepared(kit, files);
}

TEST(prepare, mesh_is_read_with_its_unit) {
  MemoryFileSystem files;
  files.put("cube.obj", cube_obj);
  const Prepared p = with_mesh(files, "cube.obj");
  EXPECT_EQ(p.text(), "");
  ASSERT_TRUE(p.prepared);
  EXPECT_EQ(p.prepared->meshes[0]->faces.size(), 12U);
  EXPECT_EQ(p.prepared->meshes[0]->positions[6], (Point3{2, 2, 2}));
  EXPECT_TRUE(p.prepared->meshes[0]->normals.empty());
}

TEST(prepare, smooth_normals_of_a_cube_point_along_its_diagonals) {
  MemoryFileSystem files;
  files.put("cube.obj", cube_obj);
  const Prepared p = with_mesh(files, "cube.obj", ir::NormalMode::smooth);
  const TriangleMesh& mesh = *p.prepared->meshes[0];
  ASSERT_EQ(mesh.normals.size(), 8U);
  for (std::size_t i = 0; i < 8; ++i) {
    const Vector3 expected = mesh.positions[i] - Point3{1, 1, 1};
    // By angle, however the quads were cut into triangles.
    EXPECT_NEAR(dot(normalized(mesh.normals[i]), normalized(expected)), 1, 1e-12);
  }
}

constexpr const char* parts_obj =
    "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 0.1 2 0.3\nvt 0 0\nvt 1 0\nvt 1 1\n"
    "f 1 2 3\nusemtl wall\ng left\nf 1/1 3/2 4/3\nusemtl roof\nf 4 3 5\nusemtl wall\nf 3 2 5\n";

TEST(prepare, a_part_takes_the_faces_of_its_name) {
  MemoryFileSystem files;
  files.put("house.obj", parts_obj);
  SceneKit kit;
  kit.pinhole({0, 0, 3}, {0, 0, 0}, 40);
  for (const char* const part : {"wall", "roof", "left", "", "wall"}) {
    ir::Mesh mesh;
    mesh.file = kit.asset("house.obj");
    mesh.part = part;
    mesh.normals.mode = ir::NormalMode::smooth;
    kit.place(mesh, kit.matt(0.5));
  }
  const Prepared p(kit, files);
  EXPECT_EQ(p.text(), "");
  ASSERT_TRUE(p.prepared);
  const auto& meshes = p.prepared->meshes;
  const TriangleMesh& wall = *meshes[0];
  EXPECT_EQ(wall.faces, (std::vector<Face>{{0, 1, 2}, {1, 3, 4}}));
  EXPECT_EQ(wall.positions[4], (Point3{0.1, 2, 0.3}));
  EXPECT_EQ(wall.uv_faces, (std::vector<Face>{{0, 1, 2}, {3, 3, 3}}));
  EXPECT_EQ(meshes[1]->faces.size(), 1U);
  EXPECT_EQ(meshes[2]->faces.size(), 3U);  // the group goes on
  EXPECT_EQ(meshes[3]->faces.size(), 1U);
  // Normals are those of the whole file: no crease where parts meet.
  const TriangleMesh& roof = *meshes[1];
  EXPECT_EQ(wall.positions[1], roof.positions[1]);
  EXPECT_EQ(wall.normals[1], roof.normals[1]);
}

TEST(prepare, equal_meshes_are_made_once_and_unknown_parts_are_errors) {
  MemoryFileSystem files;
  files.put("house.obj", parts_obj);
  const auto with_parts = [&](std::initializer_list<const char*> parts) {
    SceneKit kit;
    kit.pinhole({0, 0, 3}, {0, 0, 0}, 40);
    for (const char* const part : parts) {
      ir::Mesh mesh;
      mesh.file = kit.asset("house.obj");
      mesh.part = part;
      mesh.unit = {1.0 + static_cast<double>(part[0] == 'x')};
      kit.place(mesh, kit.matt(0.5));
    }
    return Prepared(kit, files);
  };
  EXPECT_EQ(with_parts({"roof", "wall"}).prepared->meshes.size(), 2U);
  const Prepared p = with_parts({"wal", "roof"});
  EXPECT_FALSE(p.prepared);
  ASSERT_EQ(p.sink.sorted().size(), 1U);
  EXPECT_EQ(p.text(), "mesh-part-unknown: house.obj has no part `wal`\n");
  EXPECT_EQ(p.sink.sorted()[0].hints[0], "did you mean `wall`?");
  EXPECT_EQ(p.sink.sorted()[0].hints[1], "parts: `wall`, `roof`, `left`");
}

TEST(prepare, problems_name_the_file_and_its_line) {
  MemoryFileSystem files;
  files.put("bad.obj", "v 0 0 0\nv 1 0 zero\n");
  files.put("model.stl", "solid\n");
  files.put("plain.obj", cube_obj);
  files.put("flat.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 2 0 0\nf 1 2 3\n\nf 1 2 4\n");
  files.put("empty.obj", "v 0 0 0\nv 1 0 0\nv 2 0 0\nf 1 2 3\n");
  const Prepared bad = with_mesh(files, "bad.obj");
  EXPECT_FALSE(bad.prepared);
  EXPECT_EQ(bad.text().rfind("mesh-broken: bad.obj:2: ", 0), 0U) << bad.text();
  EXPECT_EQ(with_mesh(files, "model.stl").text(),
            "mesh-format-unknown: model.stl is neither an `.obj` nor a `.ply` file\n");
  EXPECT_EQ(with_mesh(files, "gone.obj").text().rfind("file-unreadable: gone.obj", 0), 0U);
  EXPECT_EQ(with_mesh(files, "plain.obj", ir::NormalMode::file).text(),
            "mesh-lacks-normals: `normals = .file`, but plain.obj has no normals\n");
  const Prepared flat = with_mesh(files, "flat.obj");
  EXPECT_TRUE(flat.prepared);
  EXPECT_EQ(flat.text().rfind("degenerate-faces: flat.obj:7: a face without area is left out: its corners lie on one line", 0),
            0U)
      << flat.text();
  EXPECT_NE(with_mesh(files, "empty.obj")
                .text()
                .find("mesh-without-faces: empty.obj has no face to be seen\n"),
            std::string::npos);
}

TEST(prepare, broken_image_is_an_error) {
  MemoryFileSystem files;
  files.put("wood.png", "not a picture");
  SceneKit kit;
  kit.pinhole({0, 0, 3}, {0, 0, 0}, 40);
  ir::ImageTexture image;
  image.file = kit.asset("wood.png");
  kit.place(ir::Sphere{}, kit.material(ir::Diffuse{{{}, kit.texture(image)}}));
  const Prepared p(kit, files);
  EXPECT_FALSE(p.prepared);
  EXPECT_EQ(p.text().rfind("image-broken: wood.png: ", 0), 0U) << p.text();
}

TEST(prepare, inline_meshes_are_checked) {
  const auto with = [](ir::Mesh mesh) {
    SceneKit kit;
    kit.pinhole({0, 0, 3}, {0, 0, 0}, 40);
    mesh.vertices = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {2, 0, 0}};
    kit.place(mesh, kit.matt(0.5));
    MemoryFileSystem files;
    return Prepared(kit, files).text();
  };
  ir::Mesh mesh;
  mesh.faces = {{0, 1, 2}, {0, 1, 3}};
  EXPECT_EQ(with(mesh),
            "degenerate-faces: 1 triangle without area is left out, the first of face 1\n");
}

TEST(prepare, nesting_of_instances_is_limited) {
  const auto nested = [](int levels) {
    SceneKit kit;
    kit.pinhole({0, 0, 3}, {0, 0, 0}, 40);
    const ir::MaterialId m = kit.matt(0.5);
    ir::ProtoId proto = kit.proto({kit.item(ir::Sphere{}, m, kit.identity())});
    for (int i = 1; i < levels; ++i)
      proto = kit.proto({kit.item(ir::Instance{proto}, {}, kit.identity())});
    kit.place(ir::Instance{proto}, {});
    MemoryFileSystem files;
    return Prepared(kit, files).text();
  };
  EXPECT_EQ(nested(8), "");
  EXPECT_EQ(
      nested(9),
      "instances-nested-too-deep: instances are nested 9 deep; at most 8 levels can be traced\n");
}

}  // namespace
}  // namespace scenec::backend::test
