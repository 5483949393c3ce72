// Builder, content hash, dump and verify on a small hand-made scene.
#include <gtest/gtest.h>

#include "ir/builder.hpp"
#include "ir/content_hash.hpp"
#include "ir/dump.hpp"
#include "ir/verify.hpp"

namespace scenec::ir {
namespace {

struct Options {
  std::string material_name = "clay";
  bool unused_material_first = false;
  double second_radius = 0.5;
  bool swap_items = false;
};

Scene make_scene(const Options& options = {}) {
  SceneBuilder builder;
  if (options.unused_material_first) {
    builder.add_material({Mirror{}, {}}, {builder.add_name("unused"), {}});
  }
  const MaterialId clay = builder.add_material({Diffuse{{{0.5, 0.25, 0.1}, {}}}, {}},
                                               {builder.add_name(options.material_name), {}});
  const ShapeRef first = builder.add_shape(Sphere{});
  const ShapeRef second = builder.add_shape(Sphere{{1, 2, 3}, {options.second_radius}});
  const TransformId identity = builder.add_transform({});
  Transform moved;
  moved.m[3] = 2.5;
  const Item a{first, identity, clay, {}, {}};
  const Item b{second, builder.add_transform(moved), clay, {}, builder.add_name("ball")};
  builder.place(options.swap_items ? b : a);
  builder.place(options.swap_items ? a : b);
  PointLight lamp;
  lamp.position = {0, 3, 0};
  lamp.power = Power{60};
  builder.add_light({lamp}, {builder.add_name("key"), {}});
  Pinhole pinhole;
  pinhole.eye = {0, 1, 5};
  pinhole.aim = Point3{0, 1, 0};
  pinhole.fov = Angle{0.7};
  RenderSettings settings;
  settings.camera = builder.add_camera({pinhole}, {builder.add_name("main"), {}});
  settings.stop.error = 0.01;
  builder.set_render(settings, {});
  return builder.finish();
}

TEST(Dump, PrintsCanonicalSource) {
  EXPECT_EQ(dump_text(make_scene(), {}),
            "sdl 1;\n"
            "material clay: diffuse { color = rgb(0.5, 0.25, 0.1); }\n"
            "sphere { material = clay; }\n"
            "sphere ball { center = [1, 2, 3]; radius = 0.5; material = clay; transform = "
            "matrix([1, 0, 0, 2.5, 0, 1, "
            "0, 0, 0, 0, 1, 0, 0, 0, 0, 1]); }\n"
            "light key: point { position = [0, 3, 0]; power = 60; }\n"
            "camera main: pinhole { eye = [0, 1, 5]; aim = [0, 1, 0]; fov = 0.7rad; }\n"
            "render { camera = main; stop { error = 0.01; } }\n");
}

TEST(ContentHash, LeavesNamesAndUnusedDeclarationsOut) {
  const Hash128 hash = make_scene().hash;
  EXPECT_EQ(make_scene({.material_name = "mud"}).hash, hash);
  EXPECT_EQ(make_scene({.unused_material_first = true}).hash, hash);
}

TEST(ContentHash, SeesValuesAndOrderOfItems) {
  const Hash128 hash = make_scene().hash;
  EXPECT_NE(make_scene({.second_radius = 0.25}).hash, hash);
  EXPECT_NE(make_scene({.swap_items = true}).hash, hash);
}

TEST(Dump, AvoidsNamesOfTheFunctionsItWrites) {
  EXPECT_NE(dump_text(make_scene({.material_name = "rgb"}), {}).find("material rgb_2: diffuse"),
            std::string::npos);
}

TEST(Builder, InternsTransformsAndNames) {
  SceneBuilder builder;
  Transform moved;
  moved.m[3] = 1;
  EXPECT_EQ(builder.add_transform({}), builder.add_transform({}));
  EXPECT_EQ(builder.add_transform(moved), builder.add_transform(moved));
  EXPECT_NE(builder.add_transform(moved), builder.add_transform({}));
  EXPECT_EQ(builder.add_name("a"), builder.add_name("a"));
  EXPECT_FALSE(builder.add_name("").valid());
}

TEST(Verify, FindsWhatTheBuilderMustNotLetThrough) {
  Scene scene = make_scene();
  EXPECT_TRUE(find_violations(scene).empty());
  std::get<Table<Sphere>>(scene.shapes)[Id<Sphere>(0)].radius.value = -1;
  scene.items[0].material = MaterialId(7);
  const auto violations = find_violations(scene);
  ASSERT_EQ(violations.size(), 2u);
  EXPECT_EQ(violations[0], "sphere.radius is -1");
  EXPECT_EQ(violations[1], "item.material: id 7 of 1");
}

}  // namespace
}  // namespace scenec::ir
