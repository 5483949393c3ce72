// Changes between two scenes, by the author's names.
#include "ir/diff.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "ir/builder.hpp"

namespace scenec::ir {

bool operator==(const PartChange& a, const PartChange& b) {
  return a.what == b.what && a.family == b.family && a.kind == b.kind && a.name == b.name &&
         a.count == b.count && a.keys == b.keys;
}

namespace {

using testing::ElementsAre;
using testing::IsEmpty;
using What = PartChange::What;

struct Options {
  double gray = 0.5;
  double radius = 0.5;
  double aside = 0;
  double power = 60;
  double eye = 5;
  int posts = 2;
  double post_radius = 0.1;
  bool is_box = false;
  bool other_material = false;
  bool swapped = false;
  std::int64_t samples = 16;
};

Scene make_scene(const Options& options) {
  SceneBuilder builder;
  const OriginId nowhere{};
  const MaterialId clay = builder.add_material({Diffuse{{{options.gray, 0.25, 0.1}, {}}}, {}},
                                               {builder.add_name("clay"), nowhere});
  const MaterialId glass = builder.add_material({Mirror{}, {}}, {builder.add_name("glass"), {}});
  Transform moved;
  moved.m[3] = options.aside;
  Box box;
  ShapeRef shape = builder.add_shape(box);
  if (!options.is_box) shape = builder.add_shape(Sphere{{1, 2, 3}, {options.radius}});
  const Item ball{shape, builder.add_transform(moved), options.other_material ? glass : clay,
                  nowhere, builder.add_name("ball")};
  const TransformId identity = builder.add_transform({});
  if (!options.swapped) builder.place(ball);
  for (int i = 0; i < options.posts; ++i) {
    builder.place({builder.add_shape(Sphere{{1.0 * i, 0, 0}, {options.post_radius}}),
                   identity,
                   clay,
                   nowhere,
                   {}});
  }
  if (options.swapped) builder.place(ball);
  PointLight lamp;
  lamp.power = Power{options.power};
  builder.add_light({lamp}, {builder.add_name("key"), {}});
  Pinhole pinhole;
  pinhole.eye = {0, 1, options.eye};
  pinhole.aim = Point3{0, 1, 0};
  pinhole.fov = Angle{0.7};
  RenderSettings settings;
  settings.camera = builder.add_camera({pinhole}, {builder.add_name("main"), {}});
  settings.samples = options.samples;
  builder.set_render(settings, {});
  return builder.finish();
}

std::vector<PartChange> changes(const Options& after, const Options& before = {}) {
  return changes_between(make_scene(before), make_scene(after));
}

TEST(Diff, NamesThePartAndItsKeys) {
  EXPECT_THAT(changes({}), IsEmpty());
  EXPECT_THAT(changes({.radius = 0.4, .aside = 1}),
              ElementsAre(PartChange{
                  What::changed, "shape", "sphere", "ball", 1, {"radius", "transform"}}));
  // The material says what changed; the shapes made of it do not.
  EXPECT_THAT(changes({.gray = 0.2}),
              ElementsAre(PartChange{What::changed, "material", "diffuse", "clay", 1, {"color"}}));
  EXPECT_THAT(changes({.other_material = true}),
              ElementsAre(PartChange{What::changed, "shape", "sphere", "ball", 1, {"material"}}));
  EXPECT_THAT(changes({.power = 30}),
              ElementsAre(PartChange{What::changed, "light", "point", "key", 1, {"power"}}));
  EXPECT_THAT(changes({.eye = 4}),
              ElementsAre(PartChange{What::changed, "camera", "pinhole", "main", 1, {"eye"}}));
  EXPECT_THAT(changes({.samples = 4}),
              ElementsAre(PartChange{What::changed, "render", "render", "", 1, {"samples"}}));
  EXPECT_THAT(changes({.is_box = true}),
              ElementsAre(PartChange{What::changed, "shape", "box", "ball", 1, {"kind"}}));
}

TEST(Diff, CountsPartsThatAreAlike) {
  EXPECT_THAT(changes({.posts = 5}),
              ElementsAre(PartChange{What::added, "shape", "sphere", "", 3, {}}));
  EXPECT_THAT(changes({.posts = 0}),
              ElementsAre(PartChange{What::removed, "shape", "sphere", "", 2, {}}));
  EXPECT_THAT(changes({.post_radius = 0.2}),
              ElementsAre(PartChange{What::changed, "shape", "sphere", "", 2, {"radius"}}));
}

TEST(Diff, OrderIsNoChange) {
  EXPECT_THAT(changes({.swapped = true}), IsEmpty());
}

}  // namespace
}  // namespace scenec::ir
