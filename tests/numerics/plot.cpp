#include "tests/numerics/plot.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

namespace scenec::numerics {
namespace {

constexpr double width = 640;
constexpr double height = 300;
constexpr double left = 78;
constexpr double right = 200;  // the legend's
constexpr double top = 36;
constexpr double bottom = 48;
constexpr std::array<std::string_view, 4> colors{"#0b6e4f", "#c8553d", "#3d5a98", "#8a6d1a"};

struct Axis {
  double low = 0;  // powers of ten
  double high = 1;
  double from = 0;  // pixels
  double to = 1;
  [[nodiscard]] double at(double v) const {
    const double e = std::clamp(std::log10(v), low, high);
    return from + (e - low) / (high - low) * (to - from);
  }
};

Axis axis_over(const std::vector<Series>& series, const std::vector<double> Series::* values,
               double from, double to) {
  double low = 1e300;
  double high = 0;
  for (const Series& s : series) {
    for (const double v : s.*values) {
      if (!(v > 0)) continue;
      low = std::min(low, v);
      high = std::max(high, v);
    }
  }
  if (!(high > 0)) return {0, 1, from, to};
  const double a = std::floor(std::log10(low));
  const double b = std::ceil(std::log10(high));
  return {a, b > a ? b : a + 1, from, to};
}

std::string frame_of(const Plot& plot) {
  return fmt::format(
             "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{0:g}\" height=\"{1:g}\" "
             "viewBox=\"0 0 {0:g} {1:g}\" font-family=\"sans-serif\" font-size=\"12\">\n"
             "<rect width=\"{0:g}\" height=\"{1:g}\" rx=\"6\" fill=\"#fbfbf8\"/>\n"
             "<text x=\"{2:g}\" y=\"22\" font-size=\"14\" fill=\"#222\">{3}</text>\n",
             width, height, left, plot.title) +
         fmt::format("<text x=\"{:g}\" y=\"{:g}\" fill=\"#444\" text-anchor=\"middle\">{}</text>\n",
                     (left + width - right) / 2, height - 10, plot.x_label) +
         fmt::format(
             "<text x=\"16\" y=\"{0:g}\" fill=\"#444\" text-anchor=\"middle\" "
             "transform=\"rotate(-90 16 {0:g})\">{1}</text>\n",
             (top + height - bottom) / 2, plot.y_label);
}

std::string power(double e) {
  if (e == 0) return "1";
  if (e == 1) return "10";
  return fmt::format("10<tspan dy=\"-4\" font-size=\"9\">{:g}</tspan>", e);
}

std::string line(double x0, double y0, double x1, double y1, std::string_view color) {
  return fmt::format(
      "<line x1=\"{:.1f}\" y1=\"{:.1f}\" x2=\"{:.1f}\" y2=\"{:.1f}\" stroke=\"{}\"/>\n", x0, y0, x1,
      y1, color);
}

std::string ticks(const Axis& x, const Axis& y) {
  std::string out;
  const auto step = [](const Axis& a) { return std::max(1.0, std::ceil((a.high - a.low) / 8)); };
  for (double e = x.low; e <= x.high; e += step(x)) {
    const double px = x.from + (e - x.low) / (x.high - x.low) * (x.to - x.from);
    out += line(px, y.from, px, y.to, "#e2e2dc");
    out += fmt::format(
        "<text x=\"{:.1f}\" y=\"{:.1f}\" fill=\"#444\" text-anchor=\"middle\">{}</text>\n", px,
        y.from + 16, power(e));
  }
  for (double e = y.low; e <= y.high; e += step(y)) {
    const double py = y.from + (e - y.low) / (y.high - y.low) * (y.to - y.from);
    out += line(x.from, py, x.to, py, "#e2e2dc");
    out +=
        fmt::format("<text x=\"{:.1f}\" y=\"{:.1f}\" fill=\"#444\" text-anchor=\"end\">{}</text>\n",
                    x.from - 6, py + 4, power(e));
  }
  return out;
}

std::string curves(const Plot& plot, const std::vector<Series>& series) {
  const Axis x = axis_over(series, &Series::x, left, width - right);
  const Axis y = axis_over(series, &Series::y, height - bottom, top);
  std::string out = frame_of(plot) + ticks(x, y);
  for (std::size_t i = 0; i < series.size(); ++i) {
    const Series& s = series[i];
    const std::string_view color = colors[i % colors.size()];
    std::string points;
    std::string dots;
    for (std::size_t k = 0; k < s.x.size(); ++k) {
      if (!(s.y[k] > 0)) continue;  // a logarithm has no place for 0
      points += fmt::format("{:.1f},{:.1f} ", x.at(s.x[k]), y.at(s.y[k]));
      dots += fmt::format("<circle cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"2.5\" fill=\"{}\"/>\n",
                          x.at(s.x[k]), y.at(s.y[k]), color);
    }
    out +=
        fmt::format("<polyline points=\"{}\" fill=\"none\" stroke=\"{}\" stroke-width=\"1.8\"/>\n",
                    points, color);
    out += dots;
    out += fmt::format("<text x=\"{:g}\" y=\"{:g}\" fill=\"{}\">{}</text>\n", width - right + 12,
                       top + 14 + 20 * static_cast<double>(i), color, s.name);
  }
  return out + "</svg>\n";
}

// Horizontal, one row a name; the length is linear, the number stands beside it.
std::string bars(const Plot& plot, const std::vector<Series>& series) {
  std::vector<std::pair<std::size_t, double>> values;
  double most = 0;
  for (const Series& s : series) {
    for (std::size_t k = 0; k < s.x.size(); ++k) {
      values.emplace_back(static_cast<std::size_t>(s.x[k]) - 1, s.y[k]);
      most = std::max(most, s.y[k]);
    }
  }
  std::sort(values.begin(), values.end());
  constexpr double names = 250;
  const double row = 30;
  const double tall = top + row * static_cast<double>(values.size()) + 34;
  std::string out = fmt::format(
      "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{0:g}\" height=\"{1:g}\" "
      "viewBox=\"0 0 {0:g} {1:g}\" font-family=\"sans-serif\" font-size=\"12\">\n"
      "<rect width=\"{0:g}\" height=\"{1:g}\" rx=\"6\" fill=\"#fbfbf8\"/>\n"
      "<text x=\"16\" y=\"22\" font-size=\"14\" fill=\"#222\">{2}</text>\n",
      width, tall, plot.title);
  for (std::size_t i = 0; i < values.size(); ++i) {
    const double y = top + row * static_cast<double>(i);
    const double length = most > 0 ? values[i].second / most * (width - names - 90) : 0;
    const bool zero = values[i].second == 0;
    out += fmt::format("<text x=\"{:g}\" y=\"{:g}\" fill=\"#222\" text-anchor=\"end\">{}</text>\n",
                       names - 8, y + 19, plot.bar_names[values[i].first]);
    out += fmt::format("<rect x=\"{:g}\" y=\"{:g}\" width=\"{:.1f}\" height=\"18\" fill=\"{}\"/>\n",
                       names, y + 6, std::max(length, 1.5), zero ? colors[0] : colors[1]);
    out += fmt::format("<text x=\"{:.1f}\" y=\"{:g}\" fill=\"#222\">{}</text>\n",
                       names + std::max(length, 1.5) + 8, y + 19, short_number(values[i].second));
  }
  out += fmt::format("<text x=\"{:g}\" y=\"{:g}\" fill=\"#444\">{}</text>\n", names, tall - 12,
                     plot.x_label);
  return out + "</svg>\n";
}

}  // namespace

std::string svg_of(const Plot& plot, const std::vector<Series>& series) {
  return plot.kind == PlotKind::curves ? curves(plot, series) : bars(plot, series);
}

}  // namespace scenec::numerics
