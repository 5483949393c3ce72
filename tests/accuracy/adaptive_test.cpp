// Whether adaptive sampling is worth its name: how many samples it takes to the error of an even
// render, and that it leans to no side. `docs/accuracy.md` holds what the slow test printed.
#include <gtest/gtest.h>
#include <sys/resource.h>

#include <cmath>
#include <cstdio>
#include <filesystem>
#include <iterator>
#include <numeric>
#include <optional>
#include <string>
#include <vector>

#include "backend/render_session.hpp"
#include "tests/accuracy/true_error.hpp"
#include "tests/support/built_scene.hpp"
#include "tests/support/paths.hpp"

namespace scenec {
namespace {

using backend::SampleSpread;

struct Subject {
  std::optional<test::BuiltScene> built;
  ir::RenderSettings settings;
};

Subject subject_of(const std::string& name, std::int64_t width, std::int64_t height,
                   ThreadPool& pool) {
  Subject subject{
      test::build_file(test::source_directory() / "stdlib-scenes/showcase" / (name + ".sdl"), pool),
      {}};
  if (!subject.built) return subject;
  subject.settings = subject.built->scene->render;
  subject.settings.size = {width, height};
  subject.settings.region.reset();
  subject.settings.aovs = {ir::Aov::samples};
  return subject;
}

backend::RenderSession session_of(const Subject& subject, std::int64_t seed, SampleSpread spread,
                                  ThreadPool& pool, ir::RenderSettings& settings) {
  settings = subject.settings;
  settings.seed = seed;
  const backend::RenderScene& scene = *subject.built->render_scene;
  return {scene,
          settings,
          backend::find_effects(scene, settings).simulated(),
          pool,
          backend::KernelChoice::smallest,
          nullptr,
          spread};
}

double mean_samples(const backend::Picture& picture) {
  const std::vector<float>& counts = picture.layers.at(0).second;
  return std::accumulate(counts.begin(), counts.end(), 0.0) / static_cast<double>(counts.size());
}

double cpu_seconds() {
  rusage usage{};
  ::getrusage(RUSAGE_SELF, &usage);
  return static_cast<double>(usage.ru_utime.tv_sec) +
         1e-6 * static_cast<double>(usage.ru_utime.tv_usec);
}

// Samples and seconds at which a session reaches an error: between two looks along the line of
// their logarithms.
struct Reached {
  double samples = 0;
  double seconds = 0;
  double error = 0;  // at the last look
};
Reached reach(backend::RenderSession& session, double error, std::int64_t cap) {
  Reached before;
  Reached now;
  double bookkeeping = 0;  // looks are the test's, not the render's
  const double start = cpu_seconds();
  while (session.samples() < cap) {
    const std::int64_t done = session.samples();
    session.advance(done < 16 ? 16 : std::max<std::int64_t>(8, done / 8 / 4 * 4));
    const double looking = cpu_seconds();
    now = {mean_samples(session.picture()), looking - start - bookkeeping,
           session.error().relative.value};
    bookkeeping += cpu_seconds() - looking;
    if (now.error <= error && before.samples > 0) {
      const double part = std::log(before.error / error) / std::log(before.error / now.error);
      now.samples = before.samples * std::pow(now.samples / before.samples, part);
      now.seconds = before.seconds * std::pow(now.seconds / before.seconds, part);
      return now;
    }
    before = now;
  }
  return now;
}

// Mean of the picture, and the standard deviation of that mean over the seeds.
struct Brightness {
  double mean = 0;
  double deviation = 0;
};
Brightness brightness_of(const Subject& subject, SampleSpread spread, std::int64_t samples,
                         int seeds, int first_seed, ThreadPool& pool) {
  double sum = 0;
  double squares = 0;
  for (int seed = 0; seed < seeds; ++seed) {
    ir::RenderSettings settings;
    backend::RenderSession session = session_of(subject, first_seed + seed, spread, pool, settings);
    session.advance(samples);
    const std::vector<float> rgb = session.picture().rgb;
    const double mean =
        std::accumulate(rgb.begin(), rgb.end(), 0.0) / static_cast<double>(rgb.size());
    sum += mean;
    squares += mean * mean;
  }
  const double n = seeds;
  const double mean = sum / n;
  return {mean, std::sqrt(std::max(0.0, squares / n - mean * mean) / (n - 1))};
}

// Five standard deviations: a false alarm in two million.
void expect_no_lean(const char* name, std::int64_t samples, int seeds, std::int64_t reference,
                    int references) {
  ThreadPool pool;
  const Subject subject = subject_of(name, 48, 36, pool);
  ASSERT_TRUE(subject.built) << name;
  const Brightness even =
      brightness_of(subject, SampleSpread::even, reference, references, 5001, pool);
  const Brightness adaptive =
      brightness_of(subject, SampleSpread::adaptive, samples, seeds, 1, pool);
  const double deviation = std::hypot(even.deviation, adaptive.deviation);
  std::printf("%-16s adaptive / even - 1 = %+.4f %% +- %.4f %%\n", name,
              100 * (adaptive.mean / even.mean - 1), 196 * deviation / even.mean);
  EXPECT_LT(std::abs(adaptive.mean - even.mean), 5 * deviation) << name;
}

TEST(Adaptive, LeansToNoSideInShort) {
  expect_no_lean("cornell", 32, 24, 96, 8);
}

TEST(Adaptive, SlowLeansToNoSide) {
  for (const char* const name : {"cornell", "still-life", "caustic-glass", "many-lights"})
    expect_no_lean(name, 48, 100, 512, 10);
}

TEST(Adaptive, SlowNeedsFewerSamples) {
  constexpr const char* names[] = {"caustic-glass", "cornell", "depth-of-field", "globe",
                                   "glossy-row",    "knot",    "landscape",      "leaves",
                                   "many-lights",   "mapping", "newton",         "rough-glass",
                                   "still-life",    "vases"};
  ThreadPool pool;
  double log_samples = 0;
  double log_seconds = 0;
  int count = 0;
  for (const char* const name : names) {
    const Subject subject = subject_of(name, 128, 96, pool);
    ASSERT_TRUE(subject.built) << name;
    ir::RenderSettings settings;
    // What 160 even samples reach, or 1 % where they are better than that.
    backend::RenderSession first = session_of(subject, 1, SampleSpread::even, pool, settings);
    first.advance(160);
    const double error = std::max(0.01, first.error().relative.value);
    ir::RenderSettings settings_even;
    backend::RenderSession even = session_of(subject, 2, SampleSpread::even, pool, settings_even);
    const Reached a = reach(even, error, 640);
    ir::RenderSettings settings_adaptive;
    backend::RenderSession adaptive =
        session_of(subject, 2, SampleSpread::adaptive, pool, settings_adaptive);
    const Reached b = reach(adaptive, error, 640);
    std::printf("%-16s error %6.2f %%  even %6.1f  adaptive %6.1f  ratio %.2f  time ratio %.2f\n",
                name, 100 * error, a.samples, b.samples, a.samples / b.samples,
                a.seconds / b.seconds);
    std::fflush(stdout);
    log_samples += std::log(a.samples / b.samples);
    log_seconds += std::log(a.seconds / b.seconds);
    ++count;
    EXPECT_LE(b.samples, 1.05 * a.samples) << name;
  }
  std::printf("geometric mean: samples %.2f  time %.2f\n", std::exp(log_samples / count),
              std::exp(log_seconds / count));
  EXPECT_GE(std::exp(log_samples / count), 1.3);
}

// Even renders: their mean is the reference, and each is judged by the mean of the others.
struct Even {
  test::Reference reference;
  double error = 0;  // mean square of them all
  double seconds = 0;
};
Even even_renders(const Subject& subject, int count, std::int64_t samples, ThreadPool& pool) {
  Even even;
  std::vector<std::vector<float>> pictures;
  const double start = cpu_seconds();
  for (int seed = 1; seed <= count; ++seed) {
    ir::RenderSettings settings;
    backend::RenderSession session =
        session_of(subject, 100 + seed, SampleSpread::even, pool, settings);
    session.advance(samples);
    pictures.push_back(session.picture().rgb);
    even.reference.add(pictures.back());
  }
  even.seconds = (cpu_seconds() - start) / count;
  double squares = 0;
  for (const auto& rgb : pictures) {
    const double error = test::true_error(rgb, even.reference, true).error;
    squares += error * error / count;
  }
  even.error = std::sqrt(squares);
  return even;
}

// Where an adaptive render's true error falls below that of the even ones.
Reached reach_truly(const Subject& subject, const Even& even, std::int64_t seed, std::int64_t cap,
                    ThreadPool& pool) {
  ir::RenderSettings settings;
  backend::RenderSession session =
      session_of(subject, seed, SampleSpread::adaptive, pool, settings);
  Reached before;
  Reached now;
  double looking = 0;
  const double start = cpu_seconds();
  while (session.samples() < cap) {
    const std::int64_t done = session.samples();
    session.advance(done < 16 ? 16 : std::max<std::int64_t>(8, done / 8 / 4 * 4));
    const double at = cpu_seconds();
    const backend::Picture picture = session.picture();
    now = {mean_samples(picture), at - start - looking,
           test::true_error(picture.rgb, even.reference, false).error};
    looking += cpu_seconds() - at;
    if (now.error <= even.error && before.samples > 0) {
      const double part = std::log(before.error / even.error) / std::log(before.error / now.error);
      now.samples = before.samples * std::pow(now.samples / before.samples, part);
      now.seconds = before.seconds * std::pow(now.seconds / before.seconds, part);
      return now;
    }
    before = now;
  }
  return now;
}

// The same question with many samples, where 1 % is reached or near, and by the true error instead
// of the renderer's own estimate.
TEST(Adaptive, SlowNeedsFewerSamplesByTheTrueError) {
  constexpr const char* names[] = {"knot",    "glossy-row", "globe",      "cornell",
                                   "mapping", "leaves",     "still-life", "caustic-glass"};
  constexpr std::int64_t samples = 1024;
  constexpr int renders = 3;
  ThreadPool pool;
  double log_samples = 0;
  double log_seconds = 0;
  for (const char* const name : names) {
    const Subject subject = subject_of(name, 64, 48, pool);
    ASSERT_TRUE(subject.built) << name;
    const Even even = even_renders(subject, renders, samples, pool);
    double mean = 0;
    double seconds = 0;
    for (const std::int64_t seed : {1, 2}) {
      const Reached one = reach_truly(subject, even, seed, 2 * samples, pool);
      mean += one.samples / 2;
      seconds += one.seconds / 2;
    }
    std::printf(
        "%-16s true error %6.2f %%  even %lld  adaptive %6.1f  ratio %.2f  time ratio %.2f\n", name,
        100 * even.error, static_cast<long long>(samples), mean,
        static_cast<double>(samples) / mean, even.seconds / seconds);
    std::fflush(stdout);
    log_samples += std::log(static_cast<double>(samples) / mean);
    log_seconds += std::log(even.seconds / seconds);
    EXPECT_LE(mean, 1.05 * static_cast<double>(samples)) << name;
  }
  const auto count = static_cast<double>(std::size(names));
  std::printf("geometric mean: samples %.2f  time %.2f\n", std::exp(log_samples / count),
              std::exp(log_seconds / count));
  EXPECT_GE(std::exp(log_samples / count), 1.3);
}

}  // namespace
}  // namespace scenec
