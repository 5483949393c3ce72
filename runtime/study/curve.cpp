#include "runtime/study/curve.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>

namespace scenec::runtime {

namespace {

constexpr std::int64_t first_fitted = 16;
// No line is worth following further than so many times the time it was fitted to.
constexpr double farthest = 1000;
constexpr double levels[] = {0.1, 0.05, 0.02, 0.01, 0.005};

// log(error) over log(time) as a straight line through points that count equally.
struct Line {
  double slope = -0.5;
  double band = 0;
  double at_one = 0;
  bool fitted = false;
};
Line line_through(const std::vector<std::pair<double, double>>& points) {
  Line line;
  const double n = static_cast<double>(points.size());
  if (points.size() < 3) return line;
  double x = 0;
  double y = 0;
  for (const auto& [a, b] : points) {
    x += a / n;
    y += b / n;
  }
  double xx = 0;
  double xy = 0;
  for (const auto& [a, b] : points) {
    xx += (a - x) * (a - x);
    xy += (a - x) * (b - y);
  }
  if (!(xx > 0)) return line;
  line.slope = xy / xx;
  line.at_one = y - line.slope * x;
  double rest = 0;
  for (const auto& [a, b] : points) {
    const double residual = b - line.at_one - line.slope * a;
    rest += residual * residual;
  }
  line.band = 2 * std::sqrt(rest / (n - 2) / xx);
  line.fitted = true;
  return line;
}

Json levels_of(const Json& points, const Line& line) {
  Json rows = Json::array();
  for (const double level : levels) {
    Json row{{"error", level}};
    const Json* before = nullptr;
    for (const Json& point : points) {
      const double error = point["error"]["value"].get<double>();
      if (error <= level && before != nullptr) {
        const double e0 = (*before)["error"]["value"].get<double>();
        const double t0 = (*before)["seconds"].get<double>();
        const double t1 = point["seconds"].get<double>();
        const double part = std::log(e0 / level) / std::log(e0 / std::max(error, 1e-300));
        row["seconds"] = t0 * std::pow(t1 / t0, part);
        row["measured"] = true;
        break;
      }
      before = &point;
    }
    if (!row.contains("seconds") && before != nullptr && line.fitted && line.slope < 0) {
      // From the last point on along the line.
      const double error = (*before)["error"]["value"].get<double>();
      const double seconds = (*before)["seconds"].get<double>();
      const double predicted = seconds * std::pow(level / error, 1 / line.slope);
      if (predicted > farthest * seconds) {
        rows.push_back(row);
        continue;
      }
      row["seconds"] = predicted;
      row["low"] = seconds * std::pow(level / error, 1 / (line.slope - line.band));
      if (line.slope + line.band < 0)
        row["high"] = seconds * std::pow(level / error, 1 / (line.slope + line.band));
      row["measured"] = false;
    }
    rows.push_back(row);
  }
  return rows;
}

std::string base64_of(std::string_view bytes) {
  constexpr std::string_view digits =
      "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    std::uint32_t word = 0;
    for (std::size_t k = 0; k < 3; ++k)
      word = word << 8 | (i + k < bytes.size() ? static_cast<unsigned char>(bytes[i + k]) : 0U);
    for (std::size_t k = 0; k < 4; ++k)
      text += i + k <= bytes.size() ? digits[word >> (18 - 6 * k) & 63U] : '=';
  }
  return text;
}

void add_picture(const backend::Picture& picture, const ir::RenderSettings& settings,
                 Json& document) {
  const std::string png = backend::encode(picture, settings, backend::ImageFormat::png, {});
  document["picture"] = {{"width", picture.width},
                         {"height", picture.height},
                         {"samples", picture.samples},
                         {"png", base64_of(png)}};
}

}  // namespace

void measure_curve(const Variant& base, const std::function<bool()>& goes_on, const StudyPlan& plan,
                   ThreadPool& pool, Json& document) {
  backend::RenderSession session(*base.scene, base.settings, base.effects, pool);
  Json points = Json::array();
  std::vector<std::pair<double, double>> fitted;
  double seconds = 0;
  const auto start = std::chrono::steady_clock::now();
  while (goes_on()) {
    const std::int64_t done = session.samples();
    const double before = cpu_seconds();
    if (!session.advance(std::max<std::int64_t>(1, done / 4), plan.stop)) return;
    seconds += cpu_seconds() - before;
    const backend::ErrorEstimate error = session.error();
    if (!error.known) continue;
    points.push_back({{"samples", session.samples()},
                      {"seconds", seconds},
                      {"error", json_of(error.relative)},
                      {"rmse", json_of(error.absolute)}});
    if (session.samples() >= first_fitted && error.relative.value > 0 && seconds > 0)
      fitted.emplace_back(std::log(seconds), std::log(error.relative.value));
  }
  const double wall =
      std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  const auto samples = static_cast<double>(std::max<std::int64_t>(1, session.samples()));
  const Line line = line_through(fitted);
  document["curve"] = {{"points", points},
                       {"fitted", line.fitted},
                       {"slope", line.slope},
                       {"slope_band", line.band},
                       {"at_one_second", std::exp(line.at_one)},
                       {"seconds_a_sample", seconds / samples},
                       {"wall_a_sample", wall / samples}};
  document["levels"] = levels_of(points, line);
  add_picture(session.picture(), base.settings, document);
}

}  // namespace scenec::runtime
