// A picture in the making: rounds, stops, first looks, saving and taking up again.
#include "backend/render_session.hpp"

#include <algorithm>

#include "tests/unit/backend/scene_kit.hpp"

namespace scenec::backend::test {
namespace {

SceneKit lit_ball() {
  SceneKit kit;
  kit.place(ir::Plane{}, kit.matt(0.6));
  kit.place(ir::Sphere{{0, 0.5, 0}, {0.5}}, kit.matt(0.8));
  kit.light(ir::SphereLight{{1, 2, 1}, {0.4}, 5.0, {}, true, ir::white});
  kit.pinhole({0, 1, 4}, {0, 0.4, 0}, 40);
  kit.settings.size = {37, 29};
  kit.settings.aovs = {ir::Aov::albedo, ir::Aov::depth, ir::Aov::ids, ir::Aov::variance};
  return kit;
}

struct Stage {
  Ready ready{lit_ball().finish()};
  RenderSession session() { return session_on(ready.pool, SampleSpread::even); }
  RenderSession adaptive() { return session_on(ready.pool, SampleSpread::adaptive); }
  RenderSession session_on(ThreadPool& pool, SampleSpread spread) {
    return {*ready.built,
            ready.scene.render,
            find_effects(*ready.built, ready.scene.render).simulated(),
            pool,
            KernelChoice::smallest,
            nullptr,
            spread};
  }
  std::optional<Picture> coarse(int step, const std::stop_token& stop) {
    return coarse_picture(*ready.built, ready.scene.render,
                          find_effects(*ready.built, ready.scene.render).simulated(), ready.pool,
                          step, stop);
  }
};

void expect_same(const Picture& a, const Picture& b) {
  EXPECT_EQ(a.samples, b.samples);
  EXPECT_EQ(a.rgb, b.rgb);
  EXPECT_EQ(a.alpha, b.alpha);
  EXPECT_EQ(a.layers, b.layers);
}

TEST(render_session, any_split_into_rounds_is_the_same_picture) {
  Stage stage;
  RenderSession whole = stage.session();
  ASSERT_TRUE(whole.advance(23));
  RenderSession parts = stage.session();
  for (const int count : {1, 2, 3, 7, 10}) ASSERT_TRUE(parts.advance(count));
  expect_same(parts.picture(), whole.picture());
}

TEST(render_session, a_stopped_round_is_dropped_and_the_session_goes_on) {
  Stage stage;
  RenderSession plain = stage.session();
  ASSERT_TRUE(plain.advance(9));
  RenderSession stopped = stage.session();
  ASSERT_TRUE(stopped.advance(4));
  std::stop_source source;
  EXPECT_FALSE(stopped.advance(50, source.get_token(), [&](double part) {
    EXPECT_GT(part, 0);
    source.request_stop();
  }));
  EXPECT_EQ(stopped.samples(), 4);
  ASSERT_TRUE(stopped.advance(5));
  expect_same(stopped.picture(), plain.picture());
}

TEST(render_session, what_was_saved_goes_on_to_the_same_picture) {
  Stage stage;
  RenderSession first = stage.session();
  ASSERT_TRUE(first.advance(6));
  const std::string saved = first.save();
  ASSERT_TRUE(first.advance(7));
  RenderSession second = stage.session();
  ASSERT_TRUE(second.restore(saved));
  EXPECT_EQ(second.samples(), 6);
  ASSERT_TRUE(second.advance(7));
  expect_same(second.picture(), first.picture());
}

TEST(render_session, adaptive_samples_are_the_same_for_any_rounds_threads_and_interruptions) {
  Stage stage;
  RenderSession whole = stage.adaptive();
  ASSERT_TRUE(whole.advance(70));
  RenderSession parts = stage.adaptive();
  for (const int count : {1, 15, 3, 21, 12, 18}) ASSERT_TRUE(parts.advance(count));
  expect_same(parts.picture(), whole.picture());
  ThreadPool one(1);
  RenderSession alone = stage.session_on(one, SampleSpread::adaptive);
  ASSERT_TRUE(alone.advance(70));
  expect_same(alone.picture(), whole.picture());
  for (const int first : {16, 20, 36}) {
    RenderSession before = stage.adaptive();
    ASSERT_TRUE(before.advance(first));
    RenderSession after = stage.adaptive();
    ASSERT_TRUE(after.restore(before.save()));
    ASSERT_TRUE(after.advance(70 - first));
    expect_same(after.picture(), whole.picture());
  }
  RenderSession even = stage.session();
  ASSERT_TRUE(even.advance(70));
  EXPECT_NE(even.picture().rgb, whole.picture().rgb);
  EXPECT_FALSE(whole.restore(even.save()));
}

TEST(render_session, sums_that_are_cut_off_are_refused_and_change_nothing) {
  Stage stage;
  RenderSession session = stage.session();
  ASSERT_TRUE(session.advance(3));
  const Picture before = session.picture();
  const std::string saved = session.save();
  EXPECT_FALSE(session.restore(""));
  EXPECT_FALSE(session.restore(std::string_view(saved).substr(0, saved.size() - 1)));
  EXPECT_FALSE(session.restore(saved + '\0'));
  expect_same(session.picture(), before);
}

TEST(render_session, the_first_look_is_the_same_view_with_fewer_pixels) {
  Stage stage;
  const auto coarse = stage.coarse(4, {});
  ASSERT_TRUE(coarse);
  EXPECT_EQ(coarse->width, 10);
  EXPECT_EQ(coarse->height, 8);
  EXPECT_EQ(coarse->samples, 1);
  RenderSession fine = stage.session();
  ASSERT_TRUE(fine.advance(16));
  // Where the horizon lies is what 80 samples can tell.
  const auto sky = [](const Picture& picture) {
    const auto& a = picture.alpha;
    return static_cast<double>(std::count(a.begin(), a.end(), 0.0F)) /
           static_cast<double>(a.size());
  };
  EXPECT_NEAR(sky(*coarse), sky(fine.picture()), 0.13);  // one of its eight rows
  EXPECT_GT(sky(*coarse), 0.1);
  std::stop_source stopped;
  stopped.request_stop();
  EXPECT_FALSE(stage.coarse(4, stopped.get_token()));
}

}  // namespace
}  // namespace scenec::backend::test
