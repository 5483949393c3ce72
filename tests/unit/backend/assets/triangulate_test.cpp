#include "backend/assets/triangulate.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <iostream>
#include <numbers>
#include <numeric>
#include <random>

namespace scenec::backend {
namespace {

using Point = Point3;

FaceList one_face(std::size_t size) {
  FaceList faces;
  faces.corner_positions.resize(size);
  std::iota(faces.corner_positions.begin(), faces.corner_positions.end(), 0u);
  faces.sizes = {static_cast<std::uint32_t>(size)};
  faces.lines = {1};
  return faces;
}

MeshData cut(std::vector<Point> polygon, const MeshLimits& limits = {}) {
  const std::size_t size = polygon.size();
  MeshData mesh;
  mesh.positions = std::move(polygon);
  const auto problem = triangulate(one_face(size), limits, mesh);
  EXPECT_FALSE(problem) << problem->message;
  return mesh;
}

// Signed area seen along z, and the sum of the absolute areas: equal when nothing overlaps.
std::pair<double, double> areas_of(const MeshData& mesh) {
  double sum = 0;
  double absolute = 0;
  for (const TriangleIndices& t : mesh.triangles) {
    const Point &a = mesh.positions[t[0]], &b = mesh.positions[t[1]], &c = mesh.positions[t[2]];
    const double area = (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
    sum += area / 2;
    absolute += std::abs(area) / 2;
  }
  return {sum, absolute};
}

TEST(Triangulate, CutsConvexPolygonsAsFans) {
  const MeshData mesh = cut({{0, 0, 0}, {2, 0, 0}, {2, 1, 0}, {1, 2, 0}, {0, 1, 0}});
  EXPECT_EQ(mesh.triangles, (std::vector<TriangleIndices>{{0, 1, 2}, {0, 2, 3}, {0, 3, 4}}));
}

TEST(Triangulate, CutsConcavePolygonsWithoutOverlap) {
  // An arrow head whose fan from the first corner would leave the polygon, in both directions.
  const std::vector<Point> arrow = {{0, 0, 0}, {2, 1, 0}, {0, 2, 0}, {0.5, 1, 0}};
  std::vector<Point> turned = {arrow[1], arrow[2], arrow[3], arrow[0]};
  for (int i = 0; i < 4; ++i) {
    const auto [sum, absolute] = areas_of(cut(turned));
    EXPECT_DOUBLE_EQ(sum, 1.5);
    EXPECT_DOUBLE_EQ(absolute, 1.5);
    const auto [back, back_absolute] = areas_of(cut({turned.rbegin(), turned.rend()}));
    EXPECT_DOUBLE_EQ(back, -1.5);
    EXPECT_DOUBLE_EQ(back_absolute, 1.5);
    std::rotate(turned.begin(), turned.begin() + 1, turned.end());
  }
}

TEST(Triangulate, CoversRandomStarPolygons) {
  const std::uint32_t seed = 7;
  std::cout << "seed " << seed << '\n';
  std::mt19937 random(seed);
  for (int round = 0; round < 300; ++round) {
    const std::size_t size = 4 + random() % 40;
    std::vector<Point> polygon;
    double area = 0;
    for (std::size_t i = 0; i < size; ++i) {
      const double angle =
          2 * std::numbers::pi * static_cast<double>(i) / static_cast<double>(size);
      const double radius = 0.1 + static_cast<double>(random() % 1000) / 1000;
      polygon.push_back({radius * std::cos(angle), radius * std::sin(angle), 0});
    }
    for (std::size_t i = 0; i < size; ++i) {
      const Point &a = polygon[i], &b = polygon[(i + 1) % size];
      area += (a.x * b.y - a.y * b.x) / 2;
    }
    const MeshData mesh = cut(polygon);
    const auto [sum, absolute] = areas_of(mesh);
    EXPECT_EQ(mesh.triangles.size(), size - 2);
    EXPECT_NEAR(sum, area, 1e-12);
    EXPECT_NEAR(absolute, area, 1e-12);
  }
}

TEST(Triangulate, KeepsTinyTrianglesThatWouldUnderflow) {
  EXPECT_EQ(cut({{0, 0, 0}, {1e-200, 0, 0}, {0, 1e-200, 0}}).triangles.size(), 1u);
  EXPECT_EQ(cut({{0, 0, 0}, {1e-200, 0, 0}, {2e-200, 0, 0}}).triangles.size(), 0u);
  EXPECT_EQ(cut({{0, 0, 0}, {0.1, 0.1, 0.1}, {0.3, 0.3, 0.3}}).dropped_face_count, 1u);
}

TEST(Triangulate, EndsOnPolygonsThatCrossThemselves) {
  const MeshData bow = cut({{0, 0, 0}, {2, 2, 0}, {2, 0, 0}, {0, 1, 0}});
  EXPECT_LE(bow.triangles.size(), 2u);
  std::mt19937 random(3);
  std::vector<Point> tangle;
  for (int i = 0; i < 200; ++i) {
    tangle.push_back({static_cast<double>(random() % 100), static_cast<double>(random() % 100), 0});
  }
  EXPECT_LE(cut(tangle).triangles.size(), 198u);
}

TEST(Triangulate, RefusesWhatWouldTakeTooLong) {
  MeshData mesh;
  for (int i = 0; i < 1000; ++i) {
    const double radius = i % 2 == 0 ? 1.0 : 2.0;
    const double angle = 2 * std::numbers::pi * i / 1000;
    mesh.positions.push_back({radius * std::cos(angle), radius * std::sin(angle), 0});
  }
  MeshLimits limits;
  limits.ear_tests = 5'000;
  const auto problem = triangulate(one_face(1000), limits, mesh);
  ASSERT_TRUE(problem);
  EXPECT_EQ(problem->line, 1u);
}

TEST(Triangulate, CapsTheListOfDroppedFacesButNotTheirCount) {
  MeshData mesh;
  mesh.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  FaceList faces;
  for (int i = 0; i < 3000; ++i) {
    for (const std::uint32_t corner : {0u, 1u, 1u}) faces.corner_positions.push_back(corner);
    faces.sizes.push_back(3);
  }
  EXPECT_FALSE(triangulate(faces, {}, mesh));
  EXPECT_EQ(mesh.dropped_face_count, 3000u);
  EXPECT_EQ(mesh.dropped_faces.size(), 1024u);
  EXPECT_TRUE(mesh.parts.empty());
}

}  // namespace
}  // namespace scenec::backend
