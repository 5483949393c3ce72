// `scenec diff A B`: how far two pictures are apart. B is the reference: what A should look like.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "backend/image/compare.hpp"
#include "backend/image/flip.hpp"
#include "backend/image/read_image.hpp"
#include "backend/image/tone.hpp"
#include "backend/image/write_image.hpp"
#include "base/file_system.hpp"
#include "base/text.hpp"
#include "runtime/output.hpp"
#include "runtime/verbs.hpp"

namespace scenec::runtime {

namespace {

using backend::FloatImage;

constexpr std::size_t worst_pixels_told = 5;

// Linear RGB of a picture; alpha is left out.
Result<FloatImage, std::string> read_picture(const std::string& path) {
  RealFileSystem disk;
  const backend::ImageLimits limits;
  const auto content = disk.read(path, limits.file_bytes);
  if (!content.ok()) return Failure{std::string(text_of(content.error()))};
  const auto decoded = backend::read_image(content.value().bytes, extension_of(path), limits);
  if (!decoded.ok()) return Failure{decoded.error().message};
  const FloatImage image = backend::linear_image_of(decoded.value());
  FloatImage rgb{image.width, image.height, 3, {}};
  const std::size_t pixels = std::size_t{image.width} * image.height;
  rgb.samples.resize(3 * pixels);
  for (std::size_t i = 0; i < pixels; ++i) {
    for (std::size_t c = 0; c < 3; ++c)
      rgb.samples[3 * i + c] = image.samples[i * image.channels + (image.channels < 3 ? 0 : c)];
  }
  return rgb;
}

struct WorstPixel {
  std::size_t index = 0;
  double difference = 0;  // the largest of the three channels
};

struct Comparison {
  backend::ImageDifference figures;
  double flip = 0;  // mean
  std::size_t differing_pixels = 0;
  std::vector<WorstPixel> worst;
  std::vector<float> flip_pixels;
  [[nodiscard]] double error() const { return std::sqrt(figures.rel_mse); }
};

std::vector<WorstPixel> differing_pixels(const FloatImage& a, const FloatImage& b) {
  std::vector<WorstPixel> pixels;
  for (std::size_t i = 0; i < a.samples.size() / 3; ++i) {
    double largest = 0;
    bool differs = false;
    for (std::size_t c = 0; c < 3; ++c) {
      const float x = a.samples[3 * i + c];
      const float y = b.samples[3 * i + c];
      differs = differs || !(x == y);
      largest = std::max(largest, std::abs(static_cast<double>(x) - static_cast<double>(y)));
    }
    if (differs) pixels.push_back({i, largest});
  }
  return pixels;
}

Comparison compare(const FloatImage& a, const FloatImage& b) {
  Comparison result;
  result.figures = backend::difference_of(a, b);
  result.flip_pixels = backend::flip_of(a, b);
  for (const float value : result.flip_pixels) result.flip += static_cast<double>(value);
  result.flip /= static_cast<double>(std::max<std::size_t>(1, result.flip_pixels.size()));
  std::vector<WorstPixel> pixels = differing_pixels(a, b);
  result.differing_pixels = pixels.size();
  const auto count = static_cast<std::ptrdiff_t>(std::min(worst_pixels_told, pixels.size()));
  std::partial_sort(pixels.begin(), pixels.begin() + count, pixels.end(),
                    [](const WorstPixel& x, const WorstPixel& y) {
                      return x.difference != y.difference ? x.difference > y.difference
                                                          : x.index < y.index;
                    });
  result.worst.assign(pixels.begin(), pixels.begin() + count);
  return result;
}

std::string color_text(const FloatImage& image, std::size_t pixel) {
  const float* c = &image.samples[3 * pixel];
  return fmt::format("{:.4g} {:.4g} {:.4g}", c[0], c[1], c[2]);
}

std::string table_of(const Comparison& c, const FloatImage& a, const FloatImage& b) {
  const std::size_t pixels = a.samples.size() / 3;
  std::string text;
  const auto row = [&](std::string_view name, const std::string& value) {
    text += fmt::format("{:<18}{}\n", name, value);
  };
  row("error", fmt::format("{:.4g} %", 100 * c.error()));
  row("relMSE", fmt::format("{:.4g}", c.figures.rel_mse));
  row("RMSE", fmt::format("{:.4g}", c.figures.rmse));
  row("FLIP", fmt::format("{:.4g}", c.flip));
  row("largest", fmt::format("{:.4g}", c.figures.largest));
  row("pixels that differ",
      fmt::format("{} of {} ({:.2f} %)", c.differing_pixels, pixels,
                  100 * static_cast<double>(c.differing_pixels) / static_cast<double>(pixels)));
  for (const WorstPixel& w : c.worst) {
    row("worst", fmt::format("{},{}: {} and {}", w.index % a.width, w.index / a.width,
                             color_text(a, w.index), color_text(b, w.index)));
  }
  return text;
}

std::string json_of(const Comparison& c, const FloatImage& a) {
  nlohmann::ordered_json json;
  json["error"] = c.error();
  json["relMSE"] = c.figures.rel_mse;
  json["RMSE"] = c.figures.rmse;
  json["FLIP"] = c.flip;
  json["largest"] = c.figures.largest;
  json["pixels"] = a.samples.size() / 3;
  json["differing_pixels"] = c.differing_pixels;
  json["worst"] = nlohmann::ordered_json::array();
  for (const WorstPixel& w : c.worst)
    json["worst"].push_back(
        {{"x", w.index % a.width}, {"y", w.index / a.width}, {"difference", w.difference}});
  return json.dump(2) + "\n";
}

// Black over violet and orange to near white, as FLIP's authors show theirs: dark is alike.
std::array<double, 3> heat(double value) {
  constexpr std::array<std::array<double, 3>, 5> stops{{{0.0, 0.0, 0.02},
                                                        {0.32, 0.07, 0.48},
                                                        {0.72, 0.21, 0.47},
                                                        {0.98, 0.53, 0.38},
                                                        {0.99, 0.99, 0.75}}};
  const double place = std::clamp(value, 0.0, 1.0) * (stops.size() - 1);
  const auto low = std::min(static_cast<std::size_t>(place), stops.size() - 2);
  const double part = place - static_cast<double>(low);
  std::array<double, 3> color{};
  for (std::size_t c = 0; c < 3; ++c)
    color[c] = stops[low][c] + part * (stops[low + 1][c] - stops[low][c]);
  return color;
}

// EXR: A - B with its sign. Other formats: FLIP as heat.
std::string difference_picture(const Comparison& comparison, const FloatImage& a,
                               const FloatImage& b, backend::ImageFormat format) {
  if (format == backend::ImageFormat::exr) {
    std::vector<float> difference(a.samples.size());
    for (std::size_t i = 0; i < difference.size(); ++i) difference[i] = a.samples[i] - b.samples[i];
    const std::span<const float> view(difference);
    const std::vector<backend::ExrChannel> channels{{"R", view, 3},
                                                    {"G", view.subspan(1), 3},
                                                    {"B", view.subspan(2), 3},
                                                    {"flip.Y", comparison.flip_pixels, 1}};
    return std::move(backend::encode_exr(a.width, a.height, channels, {})).value();
  }
  std::vector<std::uint8_t> bytes;
  for (const float value : comparison.flip_pixels) {
    for (const double c : heat(static_cast<double>(value)))
      bytes.push_back(static_cast<std::uint8_t>(std::lround(255 * c)));
  }
  const backend::Rgb8View view{a.width, a.height, bytes};
  return format == backend::ImageFormat::png ? std::move(backend::encode_png(view)).value()
                                             : std::move(backend::encode_bmp(view)).value();
}

}  // namespace

ExitCode verbs::diff(const Options& options, const Environment& environment) {
  DiagnosticSink sink;
  const auto complain = [&](const std::string& text) {
    environment.err << "scenec: " << text << '\n';
    return ExitCode::file_error;
  };
  const auto told = [&] {
    for (const Diagnostic& d : sink.sorted())
      environment.err << fmt::format("scenec: error[{}]: {}\n", info_of(d.kind).code, d.message);
    return ExitCode::file_error;
  };
  std::optional<backend::ImageFormat> format;
  if (!options.output.empty()) {
    format = check_picture_output(options.output, sink);
    if (!format) return told();
  }
  std::vector<FloatImage> images;
  for (const std::string& path : options.operands) {
    auto image = read_picture(path);
    if (!image.ok()) return complain(fmt::format("`{}`: {}", printable(path), image.error()));
    images.push_back(std::move(image).value());
  }
  const FloatImage& a = images[0];
  const FloatImage& b = images[1];
  if (a.width != b.width || a.height != b.height)
    return complain(fmt::format("the pictures have {}x{} and {}x{} pixels", a.width, a.height,
                                b.width, b.height));
  const Comparison comparison = compare(a, b);
  environment.out << (options.json ? json_of(comparison, a) : table_of(comparison, a, b));
  if (format && !write_output(options.output, difference_picture(comparison, a, b, *format), sink))
    return told();
  const bool too_far = options.tolerance && !(comparison.error() <= *options.tolerance);
  return too_far ? ExitCode::scene_error : ExitCode::ok;
}

}  // namespace scenec::runtime
