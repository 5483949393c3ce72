#include "backend/assets/mesh_codec.hpp"

#include <gtest/gtest.h>

#include <cstring>

#include "backend/assets/obj.hpp"
#include "tests/support/hostile.hpp"

namespace scenec::backend {
namespace {

constexpr std::string_view sample =
    "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 0.1 2 0.3\nvt 0 0\nvt 1 0\nvt 1 1\nvn 0 0 1\n"
    "f 1//1 2//1 3//1\nusemtl wall\ng left\nf 1/1 3/2 4/3\nf 1 1 1\nusemtl roof\nf 4 3 5\n";

MeshData mesh_of_sample() {
  auto mesh = read_obj(sample);
  EXPECT_TRUE(mesh.ok());
  return std::move(mesh).value();
}

std::string bytes_of(const MeshData& mesh) {
  const EncodedMesh encoded(mesh);
  std::string bytes;
  for (const std::string_view piece : encoded.pieces()) bytes += piece;
  return bytes;
}

TEST(MeshCodec, GivesBackWhatWasWritten) {
  const MeshData mesh = mesh_of_sample();
  const auto decoded = decode_mesh(bytes_of(mesh));
  ASSERT_TRUE(decoded);
  EXPECT_EQ(decoded->positions, mesh.positions);
  EXPECT_EQ(decoded->normals, mesh.normals);
  EXPECT_EQ(decoded->uvs, mesh.uvs);
  EXPECT_EQ(decoded->triangles, mesh.triangles);
  EXPECT_EQ(decoded->normal_triangles, mesh.normal_triangles);
  EXPECT_EQ(decoded->uv_triangles, mesh.uv_triangles);
  EXPECT_EQ(decoded->group_names, mesh.group_names);
  EXPECT_EQ(decoded->material_names, mesh.material_names);
  ASSERT_EQ(decoded->parts.size(), mesh.parts.size());
  EXPECT_EQ(decoded->parts[1].material, mesh.parts[1].material);
  EXPECT_EQ(decoded->parts[2].first_triangle, mesh.parts[2].first_triangle);
  EXPECT_EQ(decoded->dropped_face_count, 1U);
  ASSERT_EQ(decoded->dropped_faces.size(), 1U);
  EXPECT_EQ(decoded->dropped_faces[0].line, 14U);
  EXPECT_EQ(bytes_of(*decoded), bytes_of(mesh));
}

// Whatever the bytes say, a mesh that is given back can be rendered: every index is in range.
bool is_sound_or_refused(std::string_view bytes) {
  const auto mesh = decode_mesh(bytes);
  if (!mesh) return false;
  for (const TriangleIndices& t : mesh->triangles) {
    for (const std::uint32_t index : t) EXPECT_LT(index, mesh->positions.size());
  }
  for (std::size_t i = 0; i < mesh->triangles.size(); ++i) {
    for (const std::uint32_t index : uv_indices_of(*mesh, i))
      EXPECT_TRUE(index == no_index || index < mesh->uvs.size());
    for (const std::uint32_t index : normal_indices_of(*mesh, i))
      EXPECT_TRUE(index == no_index || index < mesh->normals.size());
  }
  return true;
}

TEST(MeshCodec, RefusesEveryPrefixAndSurvivesEveryBit) {
  const std::string bytes = bytes_of(mesh_of_sample());
  EXPECT_EQ(test::read_every_prefix(bytes, is_sound_or_refused), 0U);
  for (std::size_t bit = 0; bit < 8 * bytes.size(); ++bit) {
    std::string damaged = bytes;
    damaged[bit / 8] = static_cast<char>(damaged[bit / 8] ^ (1 << bit % 8));
    is_sound_or_refused(test::ExactCopy(damaged).view());
  }
  test::read_with_random_damage(bytes, 11, 20'000, is_sound_or_refused);
}

TEST(MeshCodec, AllocatesNothingForCountsTheBytesCannotHold) {
  std::string bytes = bytes_of(mesh_of_sample());
  for (std::size_t count = 0; count < 9; ++count) {
    for (const std::uint64_t value :
         {~std::uint64_t{0}, std::uint64_t{1} << 61, std::uint64_t{1} << 32}) {
      std::string damaged = bytes;
      std::memcpy(damaged.data() + 8 * count, &value, sizeof value);
      const auto mesh = decode_mesh(damaged);
      EXPECT_EQ(mesh.has_value(), count == 8) << count;  // the last only counts dropped faces
    }
  }
}

TEST(MeshCodec, KeysTellApartWhatIsReadDifferently) {
  const Hash128 content = hash_bytes("mesh");
  const MeshLimits limits;
  const Hash128 key = mesh_key(content, ".obj", limits);
  EXPECT_EQ(key, mesh_key(content, ".obj", limits));
  EXPECT_NE(key, mesh_key(content, ".ply", limits));
  EXPECT_NE(key, mesh_key(hash_bytes("mesh2"), ".obj", limits));
  MeshLimits other;
  other.polygon_vertices = 4;
  EXPECT_NE(key, mesh_key(content, ".obj", other));
}

}  // namespace
}  // namespace scenec::backend
