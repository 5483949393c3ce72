// Flush-to-zero breaks watertightness, so no thread of ours ever has it on: a product of two edges
// of a tiny triangle is a subnormal number, and its sign decides.
#include <gtest/gtest.h>

#include <atomic>
#include <cmath>
#include <limits>
#ifdef __SSE2__
#include <immintrin.h>
#endif

#include "backend/backend.hpp"
#include "backend/geometry/triangle.hpp"
#include "tests/unit/backend/geometry/random_rays.hpp"
#include "tests/unit/backend/scene_kit.hpp"

namespace scenec::backend::test {
namespace {

// Whether subnormal numbers are numbers on this thread.
bool keeps_subnormals() {
  volatile double smallest = std::numeric_limits<double>::min();
  volatile double half = smallest / 2;
  return half != 0 && half + half == smallest;
}

// Rays at the inside of triangles whose edge functions are subnormal, and sum to 2^-1023: its
// reciprocal is still a number.
int missed_triangles() {
  testing_support::Draw draw(83);
  int missed = 0;
  for (int i = 0; i < 1000; ++i) {
    constexpr double leg = 0x1.6a09ep-512;
    const Triangle triangle{{0, 0, 0}, {leg, 0, 0}, {0, leg, 0}};
    const double u = draw.between(0.1, 0.8);
    const double v = draw.between(0.1, 0.9 - u);
    ShapeHit hit;
    if (!intersect(triangle, {{u * leg, v * leg, 1}, {0, 0, -1}}, hit)) ++missed;
  }
  return missed;
}

TEST(FlushToZero, IsOffInEveryThreadThatRenders) {
  SceneKit kit;
  kit.pinhole({0, 1, 4}, {0, 0, 0}, 40);
  kit.place(ir::Sphere{}, kit.matt(0.5));
  kit.light(ir::PointLight{{2, 3, 3}, 40, {}, ir::Decay::inverse_square, ir::white});
  const ir::Scene scene = kit.finish();
  MemoryFileSystem files;
  DiagnosticSink sink;
  ThreadPool pool(4);
  const PreparedPtr prepared = prepare(scene, files, pool, sink);
  ASSERT_TRUE(prepared);
  const RenderScenePtr built = build(*prepared, pool);
  ir::RenderSettings settings = scene.render;
  settings.size = {64, 48};
  settings.samples = 16;
  std::atomic<int> flushed{0};
  std::atomic<int> asked{0};
  static_cast<void>(render(*built, settings, pool, {}, [&](const Progress&) {
    ++asked;
    if (!keeps_subnormals()) ++flushed;
  }));
  EXPECT_GT(asked, 0);
  EXPECT_EQ(flushed, 0);
  pool.for_each(64, [&](std::size_t, unsigned) {
    if (!keeps_subnormals()) ++flushed;
  });
  EXPECT_EQ(flushed, 0);
  EXPECT_TRUE(keeps_subnormals());
}

TEST(FlushToZero, WouldLoseTriangles) {
  EXPECT_EQ(missed_triangles(), 0);
#ifdef __SSE2__
  constexpr unsigned flush_and_daz = 0x8040;
  const unsigned before = _mm_getcsr();
  _mm_setcsr(before | flush_and_daz);
  const int missed = missed_triangles();
  _mm_setcsr(before);
  EXPECT_EQ(missed, 1000);  // the negative control: the test above sees what it is for
#endif
}

}  // namespace
}  // namespace scenec::backend::test
