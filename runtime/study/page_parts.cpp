#include "runtime/study/page_parts.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "runtime/progress.hpp"

namespace scenec::runtime {

double number(const Json& value) {
  return value.get<double>();
}

std::string escaped(std::string_view text) {
  std::string out;
  for (const char c : text) {
    if (c == '<') {
      out += "&lt;";
    } else if (c == '>') {
      out += "&gt;";
    } else if (c == '&') {
      out += "&amp;";
    } else if (c == '"') {
      out += "&quot;";
    } else {
      out += c;
    }
  }
  return out;
}

std::string seconds_text(double seconds) {
  if (seconds < 0.1) return fmt::format("{:.2g} ms", 1000 * seconds);
  return seconds < 10 ? fmt::format("{:.2g} s", seconds) : duration_text(seconds);
}
std::string percent_text(double value) {
  return fmt::format("{:.3g} %", 100 * value);
}
std::string times_text(const Json& ratio) {
  const double low = ratio["low"];
  const double high = ratio["high"];
  const std::string band = fmt::format("<small>({:.3g} – {:.3g})</small>", low, high);
  if (low <= 1 && high >= 1) return "no difference measured " + band;
  return fmt::format("× {:.3g} {}", number(ratio["value"]), band);
}
std::string bias_text(const Json& row) {
  if (!row.contains("brightness")) return "–";
  const double low = row["brightness"]["low"];
  const double high = row["brightness"]["high"];
  const std::string band =
      fmt::format("<small>({:+.2f} – {:+.2f} %)</small>", 100 * low, 100 * high);
  if (low <= 0 && high >= 0) return "none measured " + band;
  return fmt::format("{:+.2f} % {}", 100 * number(row["brightness"]["value"]), band);
}

namespace {

// A plot of two logarithmic axes.
class LogPlot {
 public:
  LogPlot(double x_low, double x_high, double y_low, double y_high)
      : x_low_(std::log10(x_low)),
        x_high_(std::log10(x_high)),
        y_low_(std::log10(y_low)),
        y_high_(std::log10(y_high)) {}

  [[nodiscard]] double x(double value) const {
    return left + (std::log10(value) - x_low_) / (x_high_ - x_low_) * (width - left - 16);
  }
  [[nodiscard]] double y(double value) const {
    return 12 + (y_high_ - std::log10(value)) / (y_high_ - y_low_) * (height - bottom - 12);
  }
  void add(std::string text) { body_ += std::move(text); }
  void add_path(const std::vector<std::pair<double, double>>& points, std::string_view style,
                bool closed = false) {
    std::string path;
    for (const auto& [a, b] : points)
      path += fmt::format("{}{:.1f},{:.1f}", path.empty() ? "M" : "L", x(a), y(b));
    add(fmt::format("<path d=\"{}{}\" class=\"{}\"/>", path, closed ? "Z" : "", style));
  }
  [[nodiscard]] std::string text() const {
    std::string grid;
    for (int e = static_cast<int>(std::floor(x_low_)); e <= std::ceil(x_high_); ++e) {
      for (const int step : {1, 2, 5}) {
        const double value = step * std::pow(10.0, e);
        if (std::log10(value) < x_low_ || std::log10(value) > x_high_) continue;
        grid += fmt::format(
            "<line class=\"g\" x1=\"{0:.1f}\" x2=\"{0:.1f}\" y1=\"12\" y2=\"{1}\"/>"
            "<text x=\"{0:.1f}\" y=\"{2}\" text-anchor=\"middle\">{3}</text>",
            x(value), height - bottom, height - bottom + 16, seconds_text(value));
      }
    }
    for (int e = static_cast<int>(std::floor(y_low_)); e <= std::ceil(y_high_); ++e) {
      for (const int step : {1, 2, 5}) {
        const double value = step * std::pow(10.0, e);
        if (std::log10(value) < y_low_ || std::log10(value) > y_high_) continue;
        grid += fmt::format(
            "<line class=\"g\" y1=\"{0:.1f}\" y2=\"{0:.1f}\" x1=\"{1}\" x2=\"{2}\"/>"
            "<text x=\"{3}\" y=\"{4:.1f}\" text-anchor=\"end\">{5}</text>",
            y(value), left, width - 16, left - 6, y(value) + 4, percent_text(value));
      }
    }
    return fmt::format(
        "<svg viewBox=\"0 0 {} {}\" role=\"img\" aria-label=\"error against time\">{}{}"
        "<text x=\"{}\" y=\"{}\" text-anchor=\"middle\">CPU time</text></svg>",
        width, height, grid, body_, width / 2, height - 4);
  }

  static constexpr int width = 720;
  static constexpr int height = 380;
  static constexpr int left = 62;
  static constexpr int bottom = 40;

 private:
  double x_low_, x_high_, y_low_, y_high_;
  std::string body_;
};

}  // namespace

std::string curve_plot(const Json& document) {
  const Json& points = document["curve"]["points"];
  if (points.size() < 2) return "<p>There was no time for a curve.</p>";
  std::vector<std::pair<double, double>> middle;
  std::vector<std::pair<double, double>> band;
  double lowest = 1e300;
  double highest = 0;
  for (const Json& p : points) {
    const double value = p["error"]["value"];
    if (!(value > 0)) continue;
    middle.emplace_back(number(p["seconds"]), value);
    band.emplace_back(number(p["seconds"]), number(p["error"]["high"]));
    lowest = std::min(lowest, std::max(value / 2, number(p["error"]["low"])));
    highest = std::max(highest, number(p["error"]["high"]));
  }
  if (middle.size() < 2) return "<p>The picture has no noise to measure.</p>";
  for (auto p = points.rbegin(); p != points.rend(); ++p) {
    const double value = (*p)["error"]["value"];
    if (value > 0)
      band.emplace_back(number((*p)["seconds"]), std::max(lowest, number((*p)["error"]["low"])));
  }
  LogPlot plot(middle.front().first * 0.8, middle.back().first * 1.25, lowest * 0.8,
               highest * 1.25);
  plot.add_path(band, "band", true);
  if (document["curve"]["fitted"].get<bool>()) {
    const double slope = document["curve"]["slope"];
    const double at_one = document["curve"]["at_one_second"];
    std::vector<std::pair<double, double>> line;
    for (const double t : {middle.front().first, middle.back().first})
      line.emplace_back(t, at_one * std::pow(t, slope));
    plot.add_path(line, "fit");
  }
  plot.add_path(middle, "curve");
  for (const auto& [t, e] : middle)
    plot.add(fmt::format("<circle cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"2.5\"/>", plot.x(t), plot.y(e)));
  return plot.text();
}

}  // namespace scenec::runtime
