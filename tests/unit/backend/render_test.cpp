// Whole renders against closed forms. Seeds are the scenes' (0 unless set); tolerances of
// statistical tests are at least 4 standard deviations of what such a render shows.
#include "backend/backend.hpp"

#include <cmath>
#include <cstring>
#include <thread>

#include "tests/unit/backend/scene_kit.hpp"

namespace scenec::backend::test {
namespace {

constexpr double ior = 1.5;
constexpr double normal_reflectance = (ior - 1) * (ior - 1) / ((ior + 1) * (ior + 1));

ir::Sphere ball(ir::Point3 center, double radius) {
  return {center, {radius}};
}
ir::Quad floor_quad(double half) {
  return {{-half, 0, half}, {2 * half, 0, 0}, {0, 0, -2 * half}};
}

// One pixel that looks straight down at the origin.
void look_down(SceneKit& kit, double height = 1) {
  kit.settings.size = {1, 1};
  kit.pinhole({0, height, 0}, {0, 0, 0}, 0.01, {0, 0, -1});
}

TEST(render, enclosure_that_glows_and_reflects_half_shows_the_geometric_sum) {  // X02
  SceneKit kit;
  ir::MaterialCommon common;
  common.emission.value = {0.5, 0.5, 0.5};
  common.two_sided = true;
  kit.place(ball({0, 0, 0}, 1), kit.material(ir::Diffuse{{{0.5, 0.5, 0.5}, {}}}, common));
  kit.pinhole({0, 0, 0}, {0, 0, -1}, 60);
  kit.settings.samples = 256;
  const Rgb m = mean(render(kit));
  EXPECT_NEAR(m.r, 1, 0.005);
  EXPECT_NEAR(m.b, 1, 0.005);
}

TEST(render, closed_box_of_emitting_quads_is_a_furnace_too) {
  SceneKit kit;
  ir::MaterialCommon common;
  common.emission.value = {0.2, 0.2, 0.2};
  common.two_sided = true;
  kit.place(ir::Box{{-1, -1, -1}, {1, 1, 1}},
            kit.material(ir::Diffuse{{{0.8, 0.8, 0.8}, {}}}, common));
  kit.pinhole({0, 0, 0}, {0, 0, -1}, 60);
  kit.settings.samples = 512;
  EXPECT_NEAR(mean(render(kit)).g, 1, 0.02);
}

class LampOverFloor : public testing::TestWithParam<int> {};

// A disk of radius r at height h over the point looked at: E = pi L r^2 / (r^2 + h^2).
TEST_P(LampOverFloor, gives_the_closed_form) {  // X03
  SceneKit kit;
  constexpr double r = 0.5;
  constexpr double h = 2;
  const double irradiance = pi * 3 * r * r / (r * r + h * h);
  kit.place(floor_quad(10), kit.matt(0.5));
  switch (GetParam()) {
    case 0:
      kit.light(ir::DiskLight{{0, h, 0}, {0, -1, 0}, {r}, 3.0, {}, true, ir::white});
      break;
    case 1:
      kit.place(ir::Disk{{0, h, 0}, {0, -1, 0}, {r}}, kit.glowing(3));
      break;
    case 2:  // a sphere seen under the same angle gives pi L sin^2, with sin = r / d
      kit.light(
          ir::SphereLight{{0, h, 0}, {h * r / std::sqrt(r * r + h * h)}, 3.0, {}, true, ir::white});
      break;
    case 3:
      kit.place(ball({0, h, 0}, h * r / std::sqrt(r * r + h * h)), kit.glowing(3));
      break;
    default:  // the same sphere, larger in its own space
      kit.place(ball({0, 0, 0}, 10 * h * r / std::sqrt(r * r + h * h)), kit.glowing(3),
                kit.transform({0.1, 0, 0, 0, 0, 0.1, 0, h, 0, 0, 0.1, 0, 0, 0, 0, 1}));
  }
  kit.settings.size = {1, 1};
  kit.pinhole({1, 1, 0}, {0, 0, 0}, 0.01);
  kit.settings.samples = 16384;
  EXPECT_NEAR(mean(render(kit)).r, 0.5 / pi * irradiance, 0.5 / pi * irradiance * 0.01);
}
INSTANTIATE_TEST_SUITE_P(kinds, LampOverFloor, testing::Range(0, 5));

TEST(render, aiming_at_lights_and_finding_them_by_chance_agree) {  // X01 in small
  const auto scene = [](bool light_shape, int shape) {
    SceneKit kit;
    kit.place(floor_quad(4), kit.matt(0.7));
    kit.place(ir::Cylinder{{0.6, 0, 0.2}, {0.6, 0.7, 0.2}, {0.2}, true},
              kit.material(ir::Ggx{{{0.3, 0.2, 0.6}, {}}, {{0.04, 0.04, 0.04}, {}}, {0.4, {}}}));
    // Behind a mix with an opaque partner emission is the same, but a texture makes it another code
    // path.
    const ir::MaterialId plain = kit.glowing(6);
    ir::MaterialCommon textured;
    textured.emission.texture = kit.texture({ir::ConstantTexture{{6, 6, 6}}});
    const ir::MaterialId by_texture = kit.material(ir::Diffuse{{{0, 0, 0}, {}}}, textured);
    const ir::MaterialId glow = light_shape ? plain : by_texture;
    const ir::TransformId squeezed =
        kit.transform({0.5, 0, 0, 0, 0, 0.25, 0, 1.5, 0, 0, 0.4, 0, 0, 0, 0, 1});
    if (shape == 0) kit.place(ball({0, 0, 0}, 1), glow, squeezed);
    if (shape == 1) kit.place(ir::Cylinder{{0, -0.5, 0}, {0, 0.5, 0}, {0.6}, true}, glow, squeezed);
    if (shape == 2) kit.place(ir::Box{{-0.5, -0.5, -0.5}, {0.5, 0.5, 0.5}}, glow, squeezed);
    kit.pinhole({0, 1, 3}, {0, 0.3, 0}, 50);
    kit.settings.size = {24, 24};
    kit.settings.samples = 256;
    return mean(render(kit)).g;
  };
  for (int shape = 0; shape < 3; ++shape) {
    const double constant = scene(true, shape);
    EXPECT_NEAR(scene(false, shape), constant, 0.01 * constant) << shape;
  }
}

TEST(render, revolve_lit_by_chance_equals_cylinder_aimed_at) {
  const auto scene = [](bool by_chance) {
    SceneKit kit;
    kit.place(floor_quad(4), kit.matt(0.7));
    if (by_chance) {
      ir::Revolve tube;
      tube.profile = {ir::CurveKind::polyline, true, {{0.5, 0.5}, {0.5, 1.2}}};
      ir::MaterialCommon common;
      common.emission.value = {2, 2, 2};
      common.two_sided = true;
      kit.place(tube, kit.material(ir::Diffuse{{{0, 0, 0}, {}}}, common));
    } else {
      ir::MaterialCommon common;
      common.emission.value = {2, 2, 2};
      common.two_sided = true;
      kit.place(ir::Cylinder{{0, 0.5, 0}, {0, 1.2, 0}, {0.5}, false},
                kit.material(ir::Diffuse{{{0, 0, 0}, {}}}, common));
    }
    kit.pinhole({0, 1, 3}, {0, 0.3, 0}, 50);
    kit.settings.samples = 512;
    ir::Scene ir_scene = kit.finish();
    ThreadPool pool(2);
    DiagnosticSink sink;
    MemoryFileSystem files;
    const PreparedPtr prepared = prepare(ir_scene, files, pool, sink);
    EXPECT_EQ(sink.warning_count(), by_chance ? 1U : 0U);
    return mean(backend::render(*build(*prepared, pool), ir_scene.render, pool, {}, {})).r;
  };
  const double aimed = scene(false);
  EXPECT_NEAR(scene(true), aimed, 0.02 * aimed);
}

TEST(render, point_light_over_a_plane_follows_the_closed_form) {  // X04
  for (const ir::Method method : {ir::Method::whitted, ir::Method::path}) {
    SceneKit kit;
    look_down(kit);
    kit.place(ir::Plane{}, kit.matt(0.5));
    kit.light(ir::PointLight{{0, 2, 0}, 8.0, {}, ir::Decay::inverse_square, ir::white});
    kit.settings.method = method;
    kit.settings.max_depth = 1;
    EXPECT_NEAR(mean(render(kit)).r, 0.5 / pi * 8 / 4, 1e-7);
  }
}

TEST(render, mirror_shows_the_light_with_its_reflectance) {
  for (const ir::Method method : {ir::Method::whitted, ir::Method::path}) {
    SceneKit kit;
    look_down(kit);
    kit.place(floor_quad(1), kit.material(ir::Mirror{{{0.5, 0.25, 1}, {}}}));
    kit.place(ir::Quad{{-2, 5, -2}, {4, 0, 0}, {0, 0, 4}}, kit.glowing(2));
    kit.settings.method = method;
    const Rgb m = mean(render(kit));
    EXPECT_NEAR(m.r, 1, 1e-6);
    EXPECT_NEAR(m.g, 0.5, 1e-6);
    EXPECT_NEAR(m.b, 2, 1e-6);
  }
}

TEST(render, glass_slab_lets_the_closed_form_through) {  // S04, X04
  for (const ir::Method method : {ir::Method::whitted, ir::Method::path}) {
    SceneKit kit;
    look_down(kit, 3);
    ir::Dielectric glass;
    glass.ior = ior;
    kit.place(ir::Box{{-5, 0.5, -5}, {5, 1, 5}}, kit.material(glass));
    kit.place(floor_quad(1), kit.glowing(1));
    kit.settings.method = method;
    kit.settings.samples = 4096;
    const double expected = (1 - normal_reflectance) / (1 + normal_reflectance);
    EXPECT_NEAR(mean(render(kit)).r, expected, method == ir::Method::whitted ? 1e-3 : 0.02);
  }
}

TEST(render, glass_that_absorbs_follows_beer_and_lambert) {  // S05
  SceneKit kit;
  look_down(kit, 3);
  ir::Dielectric glass;
  glass.ior = 1;
  glass.absorption = {0, 1, 3};
  kit.place(ir::Box{{-5, 0.5, -5}, {5, 1, 5}}, kit.material(glass));
  kit.place(floor_quad(1), kit.glowing(1));
  const Rgb m = mean(render(kit));
  EXPECT_NEAR(m.r, 1, 1e-6);
  EXPECT_NEAR(m.g, std::exp(-0.5), 1e-6);
  EXPECT_NEAR(m.b, std::exp(-1.5), 1e-6);
}

TEST(render, radiance_is_not_lost_in_a_ball_of_glass_under_an_even_sky) {
  for (const double roughness : {0.0, 0.3}) {
    SceneKit kit;
    ir::Dielectric glass;
    glass.ior = ior;
    glass.roughness.value = roughness;
    kit.place(ball({0, 0, 0}, 1), kit.material(glass));
    kit.pinhole({0, 0, 4}, {0, 0, 0}, 20);
    kit.settings.background = ir::white;
    kit.settings.samples = 64;
    // Rough glass loses what bounces between facets: a few percent. Smooth glass: chance ends
    // paths.
    EXPECT_NEAR(mean(render(kit)).r, roughness == 0 ? 1 : 0.98, roughness == 0 ? 1e-3 : 0.025)
        << roughness;
  }
}

TEST(render, white_objects_vanish_in_a_white_furnace) {  // S10 through the whole renderer
  const auto furnace = [](ir::MaterialKind kind) {
    SceneKit kit;
    kit.place(ball({0, 0, 0}, 1), kit.material(std::move(kind)));
    kit.pinhole({0, 0, 4}, {0, 0, 0}, 24);
    kit.settings.background = ir::white;
    kit.settings.samples = 128;
    return mean(render(kit)).r;
  };
  EXPECT_NEAR(furnace(ir::Diffuse{{ir::white, {}}}), 1, 1e-6);
  EXPECT_NEAR(furnace(ir::Mirror{}), 1, 1e-6);
  for (const double roughness : {0.0, 0.2, 0.5, 0.8, 1.0}) {
    ir::Conductor metal;
    metal.f0 = ir::ColorInput{ir::white, {}};
    metal.roughness.value = roughness;
    EXPECT_NEAR(furnace(metal), 1, 0.01) << roughness;
    const ir::Ggx coat{{ir::white, {}}, {{0.04, 0.04, 0.04}, {}}, {roughness, {}}};
    EXPECT_NEAR(furnace(coat), 1, 0.01) << roughness;
  }
  ir::Phong phong;
  phong.diffuse.value = {0.5, 0.5, 0.5};
  phong.reflect.value = {0.2, 0.2, 0.2};
  phong.refract.value = {0.3, 0.3, 0.3};
  EXPECT_NEAR(furnace(phong), 1, 0.005);  // nothing is lost: the parts add up to 1
  phong.specular.value = ir::white;
  phong.shininess.value = 20;
  const double glossy = furnace(phong);
  EXPECT_LE(glossy, 1.0);
  EXPECT_GT(glossy, 0.7);
}

TEST(render, opacity_and_cutout_hold_for_camera_and_shadow_rays) {  // P15
  const auto scene = [](double opacity, std::optional<double> cutout, bool below) {
    SceneKit kit;
    ir::MaterialCommon common;
    common.opacity.value = opacity;
    common.cutout = cutout;
    kit.place(ir::Quad{{-9, 1.5, 9}, {18, 0, 0}, {0, 0, -18}},
              kit.material(ir::Diffuse{{ir::black, {}}}, common));
    kit.place(ir::Plane{}, kit.matt(0.5));
    kit.light(ir::PointLight{{0, 2, 0}, pi * 8, {}, ir::Decay::inverse_square, ir::white});
    look_down(kit, below ? 1 : 3);
    kit.settings.samples = 8192;
    kit.settings.max_depth = 1;
    return mean(render(kit)).r;
  };
  EXPECT_NEAR(scene(0.75, {}, true), 0.25, 0.01);      // shadow ray only
  EXPECT_NEAR(scene(0.75, {}, false), 0.0625, 0.006);  // both
  EXPECT_NEAR(scene(0.3, 0.5, false), 1, 1e-6);
  EXPECT_NEAR(scene(0.7, 0.5, true), 0, 1e-9);
}

TEST(render, background_lights_in_path_and_is_seen_only_in_whitted) {
  for (const bool path : {true, false}) {
    SceneKit kit;
    look_down(kit);
    kit.place(floor_quad(1), kit.matt(0.5));
    kit.settings.background = {0.5, 1, 2};
    kit.settings.method = path ? ir::Method::path : ir::Method::whitted;
    EXPECT_NEAR(mean(render(kit)).b, path ? 1 : 0, 1e-6);
  }
}

TEST(render, written_background_replaces_environment_for_the_camera_only) {
  SceneKit kit;
  kit.place(ball({0, 0, 0}, 0.2), kit.matt(0.5));
  ir::EnvironmentLight sky;
  sky.constant = ir::Color{1, 1, 1};
  sky.gain = 2;
  kit.light(sky);
  kit.settings.background = {0, 0, 3};
  kit.settings.background_written = true;
  kit.pinhole({0, 0, 3}, {0, 0, 0}, 30);
  kit.settings.filter = {ir::FilterKind::box, 0.5};
  const Picture picture = render(kit);
  EXPECT_NEAR(pixel(picture, 0, 0).b, 3, 1e-6);
  EXPECT_NEAR(pixel(picture, 8, 8).b, 1, 1e-5);
  EXPECT_EQ(picture.alpha[0], 0);
  EXPECT_EQ(picture.alpha[8 * 16 + 8], 1);
}

TEST(render, invisible_light_shines_but_is_not_seen_and_casts_no_shadow) {
  SceneKit kit;
  look_down(kit, 3);
  kit.place(floor_quad(5), kit.matt(0.5));
  kit.light(ir::DiskLight{{0, 2, 0}, {0, -1, 0}, {0.5}, 3.0, {}, false, ir::white});
  kit.light(ir::PointLight{{0, 2.5, 0}, pi * 6.25, {}, ir::Decay::inverse_square, ir::white});
  kit.settings.samples = 4096;
  kit.settings.max_depth = 1;
  const double lamp = 0.5 / pi * pi * 3 * 0.25 / (0.25 + 4);
  EXPECT_NEAR(mean(render(kit)).r, lamp + 0.5, 0.005);
}

TEST(render, emission_inside_instances_is_aimed_at) {
  const auto scene = [](bool instanced) {
    SceneKit kit;
    kit.place(floor_quad(5), kit.matt(0.5));
    const ir::MaterialId glow = kit.glowing(4);
    const ir::TransformId up = kit.transform({1, 0, 0, 0.5, 0, 1, 0, 2, 0, 0, 1, 0, 0, 0, 0, 1});
    const ir::Disk disk{{0, 0, 0}, {0, -1, 0}, {0.05}};
    if (instanced) {
      const ir::ProtoId proto = kit.proto({kit.item(disk, glow, kit.identity())});
      kit.place(ir::Instance{proto}, {}, up);
    } else {
      kit.place(disk, glow, up);
    }
    kit.pinhole({0, 1, 3}, {0, 0, 0}, 30);
    return render(kit);
  };
  const Picture direct = scene(false);
  const Picture instanced = scene(true);
  ASSERT_EQ(direct.rgb.size(), instanced.rgb.size());
  for (std::size_t i = 0; i < direct.rgb.size(); ++i)
    EXPECT_NEAR(direct.rgb[i], instanced.rgb[i], 1e-6F);
}

TEST(render, phong_pixel_equals_the_hand_computed_one) {
  SceneKit kit;
  look_down(kit, 2);
  ir::Phong m;
  m.diffuse.value = {0.5, 0.25, 0.125};
  m.specular.value = {0.1, 0.2, 0.3};
  m.shininess.value = 2;
  kit.place(ir::Plane{}, kit.material(m));
  // 45 degrees: N.L = V.R = sqrt(1/2); no falloff with distance.
  kit.light(ir::PointLight{{3, 3, 0}, 2.0, {}, ir::Decay::none, {1, 1, 0.5}});
  kit.settings.method = ir::Method::phong;
  kit.settings.samples = 1;
  kit.settings.film = ir::FilmKind::course;
  kit.settings.size = {2, 2};
  const Rgb p = pixel(render(kit), 1, 0);  // its lower left corner is the centre of the film
  const double s = std::sqrt(0.5);
  EXPECT_NEAR(p.r, 2 * (0.5 * s + 0.1 * 0.5), 1e-6);
  EXPECT_NEAR(p.g, 2 * (0.25 * s + 0.2 * 0.5), 1e-6);
  EXPECT_NEAR(p.b, 1 * (0.125 * s + 0.3 * 0.5), 1e-6);
}

SceneKit busy_scene() {
  SceneKit kit;
  kit.place(floor_quad(4), kit.matt(0.7));
  kit.place(ball({-0.6, 0.5, 0}, 0.5), kit.material(ir::Dielectric{}));
  ir::Conductor gold;
  gold.preset = ir::ConductorPreset::gold;
  gold.roughness.value = 0.3;
  kit.place(ball({0.6, 0.5, 0}, 0.5), kit.material(gold));
  kit.light(ir::SphereLight{{0, 2, 1}, {0.3}, 5.0, {}, true, ir::white});
  kit.light(ir::PointLight{{2, 2, 1}, 3.0, {}, ir::Decay::inverse_square, ir::white});
  kit.pinhole({0, 1, 4}, {0, 0.4, 0}, 40);
  kit.settings.size = {37, 29};
  kit.settings.samples = 9;
  kit.settings.aovs = {ir::Aov::albedo, ir::Aov::normal, ir::Aov::depth, ir::Aov::ids,
                       ir::Aov::variance};
  return kit;
}

TEST(render, bytes_do_not_depend_on_threads) {  // D01
  for (const ir::Method method : {ir::Method::path, ir::Method::whitted, ir::Method::phong}) {
    std::vector<Picture> pictures;
    for (const unsigned threads : {1U, 2U, 7U, 64U}) {
      SceneKit kit = busy_scene();
      kit.settings.method = method;
      pictures.push_back(render(kit, threads));
    }
    for (const Picture& p : pictures) {
      EXPECT_EQ(p.rgb, pictures[0].rgb);
      EXPECT_EQ(p.alpha, pictures[0].alpha);
      EXPECT_EQ(p.layers, pictures[0].layers);
      EXPECT_EQ(p.rays, pictures[0].rays);
    }
  }
}

TEST(render, region_shows_the_pixels_of_the_whole) {
  SceneKit whole = busy_scene();
  const Picture all = render(whole);
  SceneKit part = busy_scene();
  part.settings.region = ir::Region{5, 7, 20, 19};
  const Picture cut = render(part);
  ASSERT_EQ(cut.width, 15);
  ASSERT_EQ(cut.height, 12);
  for (int y = 0; y < 12; ++y) {
    for (int x = 0; x < 15; ++x) EXPECT_EQ(pixel(cut, x, y), pixel(all, x + 5, y + 7));
  }
}

TEST(render, a_stop_request_ends_it_at_once_with_the_samples_in_common) {
  SceneKit kit = busy_scene();
  kit.settings.size = {200, 200};
  kit.settings.samples = 100000;
  Ready ready(kit.finish());
  std::stop_source source;
  std::chrono::steady_clock::time_point asked;
  std::jthread stopper([&] {
    std::this_thread::sleep_for(std::chrono::milliseconds(700));
    asked = std::chrono::steady_clock::now();
    source.request_stop();
  });
  const Picture picture = ready.render(source.get_token());
  const auto after = std::chrono::steady_clock::now() - asked;
  EXPECT_LT(after, std::chrono::milliseconds(150));  // a few on an idle machine
  EXPECT_FALSE(picture.complete);
  ASSERT_GT(picture.samples, 0);
  // The same number of samples asked for gives the same picture.
  ready.scene.render.samples = picture.samples;
  EXPECT_EQ(ready.render().rgb, picture.rgb);
}

TEST(render, progress_reaches_the_end_and_never_goes_back) {
  SceneKit kit = busy_scene();
  Ready ready(kit.finish());
  double last = 0;
  bool ordered = true;
  const Picture picture = ready.render({}, [&](const Progress& p) {
    ordered = ordered && p.fraction >= last;
    last = p.fraction;
  });
  EXPECT_TRUE(ordered);
  EXPECT_TRUE(picture.complete);
  EXPECT_DOUBLE_EQ(last, 1);
}

TEST(render, error_stop_ends_between_its_minimum_and_its_cap) {
  SceneKit kit = busy_scene();
  kit.settings.samples = {};
  kit.settings.stop.error = 0.2;
  kit.settings.stop.samples = 2000;
  const Picture picture = render(kit);
  EXPECT_GE(picture.samples, 64);
  EXPECT_LT(picture.samples, 2000);
}

TEST(render, whitted_and_path_agree_where_everything_is_specular) {  // X05
  const auto scene = [](ir::Method method) {
    SceneKit specular;
    specular.place(ball({-0.6, 0.5, 0}, 0.5), specular.material(ir::Dielectric{}));
    specular.place(ball({0.6, 0.5, 0}, 0.5), specular.material(ir::Mirror{}));
    specular.place(floor_quad(4), specular.material(ir::Mirror{{{0.5, 0.6, 0.7}, {}}}));
    specular.settings.background = {0.3, 0.4, 1};
    specular.place(ball({0, 2, 1}, 0.5), specular.glowing(3));
    specular.pinhole({0, 1, 4}, {0, 0.4, 0}, 40);
    specular.settings.size = {32, 32};
    specular.settings.samples = 256;
    specular.settings.method = method;
    return mean(render(specular)).r;
  };
  const double whitted = scene(ir::Method::whitted);
  EXPECT_NEAR(scene(ir::Method::path), whitted, 0.01 * whitted);
}

}  // namespace
}  // namespace scenec::backend::test
