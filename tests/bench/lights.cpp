// What choosing lights by a tree brings: many lamps, and a hundred thousand emitting triangles,
// with the tree and by power alone, at equal samples. relMSE of one picture is taken from the
// variance between pictures of several seeds (both ways have the same mean:
// light_finding_test.cpp), time is that of the processor, one thread, the two ways in turn.
#include "tests/bench/lights.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <cstdio>
#include <ctime>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "backend/render_scene.hpp"
#include "tests/support/built_scene.hpp"
#include "tests/support/paths.hpp"

namespace scenec::bench {
namespace {

constexpr int seeds = 4;
constexpr int samples = 16;

double cpu_seconds() {
  timespec now{};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

struct Figures {
  std::vector<std::vector<float>> pictures;
  double seconds = 0;
};

// Mean of variance / (R^2 + 0.01 of the mean's square), R the mean of all pictures of both ways.
double relative_error(const Figures& one, const Figures& other) {
  const std::size_t n = one.pictures[0].size();
  std::vector<double> reference(n);
  double level = 0;
  for (std::size_t i = 0; i < n; ++i) {
    for (int s = 0; s < seeds; ++s)
      reference[i] += (static_cast<double>(one.pictures[static_cast<std::size_t>(s)][i]) +
                       static_cast<double>(other.pictures[static_cast<std::size_t>(s)][i])) /
                      (2 * seeds);
    level += reference[i] / static_cast<double>(n);
  }
  double sum = 0;
  for (std::size_t i = 0; i < n; ++i) {
    double mean = 0;
    double square = 0;
    for (const auto& picture : one.pictures) {
      mean += static_cast<double>(picture[i]) / seeds;
      square += static_cast<double>(picture[i]) * static_cast<double>(picture[i]) / seeds;
    }
    const double variance = (square - mean * mean) * seeds / (seeds - 1);
    sum += variance / (reference[i] * reference[i] + 0.01 * level * level);
  }
  return sum / static_cast<double>(n);
}

void measure(const std::string& name, const std::filesystem::path& path) {
  ThreadPool pool(1);
  auto built = test::build_file(path, pool);
  if (!built) {
    std::fprintf(stderr, "%s does not compile\n", path.c_str());
    return;
  }
  ir::RenderSettings settings = built->scene->render;
  settings.size = {160, 120};
  settings.stop = {};
  settings.samples = samples;
  Figures by_tree;
  Figures by_power;
  for (int seed = 0; seed < seeds; ++seed)
    for (Figures* way : {&by_tree, &by_power}) {
      backend::RenderScene& scene = *built->render_scene;
      scene.lights.finish(scene.radius, way == &by_tree ? backend::LightSelection::tree
                                                        : backend::LightSelection::power);
      settings.seed = seed;
      const double before = cpu_seconds();
      way->pictures.push_back(backend::render(scene, settings, pool, {}, {}).rgb);
      way->seconds += (cpu_seconds() - before) / seeds;
    }
  const double tree = relative_error(by_tree, by_power);
  const double power = relative_error(by_power, by_tree);
  std::printf("| %s | %zu | %.4f | %.2f | %.4f | %.2f | %.1f | %.1f |\n", name.c_str(),
              built->render_scene->lights.size(), tree, by_tree.seconds, power, by_power.seconds,
              power / tree, power * by_power.seconds / (tree * by_tree.seconds));
}

// Triangles of a hand's size above a floor, all of one brightness, out of the picture: their own
// outlines would be noise that no choice takes away.
std::string strewn_triangles(int count, double half) {
  return fmt::format(
      "sdl 1;\n"
      "material glow: diffuse {{ color = black; emission = rgb(4, 3, 2); two_sided = true; }}\n"
      "material floor: diffuse {{ color = gray(0.6); }}\n"
      "plane {{ normal = [0, 1, 0]; offset = 0; material = floor; }}\n"
      "for k in -3 .. 3 {{\n"
      "  box {{ min = [k - 0.1, 0, -4]; max = [k + 0.1, 0.6, -3.8]; material = floor; }}\n"
      "}}\n"
      "for i in 0 ..< {0} {{\n"
      "  let x = {1} * (2 * random(i, 1) - 1);\n"
      "  let z = {1} * (2 * random(i, 2) - 1);\n"
      "  let y = 2 + random(i, 3);\n"
      "  triangle {{\n"
      "    vertices = [[x, y, z], [x + 0.08, y, z + 0.03 * random(i, 4)],\n"
      "                [x, y + 0.08 * random(i, 5), z + 0.05]];\n"
      "    material = glow;\n"
      "  }}\n"
      "}}\n"
      "camera: pinhole {{ eye = [0, 1.5, 0]; aim = [0, 0, -3]; fov = 50deg; }}\n"
      "render {{ max_depth = 3; }}\n",
      count, half);
}

}  // namespace

int run_lights(int, char**) {
  std::printf(
      "| scene | lights | relMSE by tree | CPU s | relMSE by power | CPU s | error, times | error "
      "x "
      "time, times |\n|---|---|---|---|---|---|---|---|\n");
  measure("many-lights", test::source_directory() / "stdlib-scenes/showcase/many-lights.sdl");
  const std::filesystem::path scene =
      std::filesystem::temp_directory_path() / fmt::format("scenec-lights-{}.sdl", ::getpid());
  for (const int count : {1000, 100000}) {
    // Two and a half a square metre.
    std::ofstream(scene) << strewn_triangles(count, count == 1000 ? 10 : 100);
    measure(fmt::format("{} triangles", count), scene);
  }
  std::filesystem::remove(scene);
  return 0;
}

}  // namespace scenec::bench
