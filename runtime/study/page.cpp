// The report of a study as one HTML page: plots are SVG, the picture is inside, nothing is loaded.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "runtime/progress.hpp"
#include "runtime/study/study.hpp"

namespace scenec::runtime {

namespace {

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
  if (low <= 1 && high >= 1) return "no difference measured";
  return fmt::format("× {:.3g} <small>({:.3g} – {:.3g})</small>", number(ratio["value"]), low,
                     high);
}

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

std::string curve_of(const Json& document) {
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

std::string level_rows(const Json& document) {
  std::string rows;
  for (const Json& level : document["levels"]) {
    std::string time = "beyond what can be said";
    std::string how;
    if (level.contains("seconds")) {
      time = seconds_text(number(level["seconds"]));
      how = level["measured"].get<bool>() ? "measured" : "predicted";
      if (level.contains("high"))
        how += fmt::format(" ({} – {})", seconds_text(number(level["low"])),
                           seconds_text(number(level["high"])));
    }
    rows += fmt::format("<tr><td>{}<td>{}<td>{}", percent_text(number(level["error"])), time, how);
  }
  return rows;
}

std::string effect_rows(const Json& document) {
  std::string rows;
  for (const Json& row : document.value("effects", Json::array())) {
    const double low = row["time_ratio"]["low"];
    const double high = row["time_ratio"]["high"];
    const std::string share = low <= 1 && high >= 1
                                  ? "no difference measured"
                                  : fmt::format("{:.0f} % <small>({:.0f} – {:.0f})</small>",
                                                100 * (1 - number(row["time_ratio"]["value"])),
                                                100 * (1 - high), 100 * (1 - low));
    rows += fmt::format("<tr><td><b>{}</b><br><small>{}</small><td>{}<td>{}<td>{:+.2f} %<td>{}",
                        escaped(row["name"].get<std::string>()),
                        escaped(row["what"].get<std::string>()), share,
                        percent_text(number(row["changed_pixels"])),
                        row.contains("brightness") ? 100 * number(row["brightness"]["value"]) : 0.0,
                        percent_text(number(row["difference"])));
  }
  return rows;
}

std::string knob_rows(const Json& document) {
  std::string rows;
  for (const Json& row : document.value("knobs", Json::array())) {
    const std::string error =
        row.contains("error_ratio") ? times_text(row["error_ratio"]) : std::string("no noise");
    std::string brightness = "–";
    if (row.contains("brightness")) {
      const double low = row["brightness"]["low"];
      const double high = row["brightness"]["high"];
      brightness =
          low <= 0 && high >= 0
              ? "no difference measured"
              : fmt::format("{:+.2f} % <small>({:+.2f} – {:+.2f})</small>",
                            100 * number(row["brightness"]["value"]), 100 * low, 100 * high);
    }
    rows += fmt::format("<tr><td><b>{}</b><br><small>{}</small><td>{}<td>{}<td>{} → {}<td>{}<td>{}",
                        escaped(row["name"].get<std::string>()),
                        escaped(row["what"].get<std::string>()),
                        row.contains("time_ratio") ? times_text(row["time_ratio"])
                                                   : std::string("one comparison a sample"),
                        error, percent_text(number(row["error_before"]["value"])),
                        percent_text(number(row["error_after"]["value"])), brightness,
                        percent_text(number(row["difference"])));
  }
  return rows;
}

constexpr std::string_view style = R"(<style>
:root{color-scheme:light dark;--line:#8884;--accent:#2a6fb0}
body{font:16px/1.5 system-ui,sans-serif;max-width:62rem;margin:2rem auto;padding:0 1rem}
h1{font-size:1.6rem}h2{margin-top:2.2rem;font-size:1.2rem}
table{border-collapse:collapse;width:100%}td,th{text-align:left;vertical-align:top;padding:.35rem .6rem;border-bottom:1px solid var(--line)}
td{font-variant-numeric:tabular-nums}small{opacity:.75}
svg{width:100%;height:auto;font:11px system-ui,sans-serif;fill:currentColor}
svg .g{stroke:var(--line)}svg .curve{fill:none;stroke:var(--accent);stroke-width:2}
svg .fit{fill:none;stroke:currentColor;stroke-dasharray:5 4}svg .band{fill:var(--accent);opacity:.2}
svg circle{fill:var(--accent)}img{width:min(100%,30rem);height:auto;border-radius:4px;image-rendering:pixelated}
.wide{overflow-x:auto}
</style>)";

}  // namespace

std::string study_curves(const Json& document) {
  std::string text = "samples,cpu_seconds,error,error_low,error_high,rmse\n";
  if (!document.contains("curve")) return text;
  for (const Json& p : document["curve"]["points"]) {
    text +=
        fmt::format("{},{:.6g},{:.6g},{:.6g},{:.6g},{:.6g}\n", p["samples"].get<std::int64_t>(),
                    number(p["seconds"]), number(p["error"]["value"]), number(p["error"]["low"]),
                    number(p["error"]["high"]), number(p["rmse"]["value"]));
  }
  return text;
}

std::string study_page(const Json& document) {
  const std::string name = escaped(document["scene"].get<std::string>());
  std::string page = fmt::format(
      "<!doctype html><html lang=en><meta charset=utf-8><meta name=viewport "
      "content=\"width=device-width\"><title>{0}: what accuracy costs</title>{1}<h1>{0}: what "
      "accuracy costs in time</h1>",
      name, style);
  if (!document.contains("curve")) return page + "<p>Nothing has been measured yet.</p>";
  const Json& picture = document["picture"];
  page += fmt::format(
      "<p><img alt=\"the scene\" width={} height={} src=\"data:image/png;base64,{}\"></p>"
      "<p>{} × {} pixels, method <code>{}</code>. Times are seconds of one processor core "
      "({}); the picture above has {} samples a pixel.</p>",
      picture["width"].get<int>(), picture["height"].get<int>(), picture["png"].get<std::string>(),
      picture["width"].get<int>(), picture["height"].get<int>(),
      escaped(document["method"].get<std::string>()),
      escaped(document["machine"].get<std::string>()), picture["samples"].get<std::int64_t>());
  const Json& curve = document["curve"];
  page += fmt::format(
      "<h2>Error against time</h2><p>A picture made of random samples is never quite right. Its "
      "<b>error</b> is how far a typical pixel is from its true value, as a part of that value. No "
      "reference picture is needed: independent parts of the samples are compared with each other. "
      "The shaded band holds the true error 95 times in 100. Halving the error takes about {} "
      "times "
      "as long (slope {:.2f} ± {:.2f}; plain random samples have -0.5).</p>{}"
      "<table><tr><th>Error<th>Time<th></tr>{}</table>",
      curve["fitted"].get<bool>() && number(curve["slope"]) < 0
          ? fmt::format("{:.1f}", std::pow(2.0, -1 / number(curve["slope"])))
          : "4",
      number(curve["slope"]), number(curve["slope_band"]), curve_of(document),
      level_rows(document));
  page += fmt::format(
      "<h2>What each effect costs</h2><p>The scene is rendered without one effect at a time, with "
      "the same random numbers. <i>Bias</i> is what leaving it out does to the brightness of the "
      "picture; <i>difference</i> is measured like the error.</p><div class=wide><table><tr><th>"
      "Effect<th>Share of the time<th>Pixels changed<th>Bias<th>Difference</tr>{}</table></div>",
      effect_rows(document));
  page += fmt::format(
      "<h2>What each choice costs</h2><p>The scene as written against the scene with one thing "
      "changed, in turn, six times each; in brackets the least and the largest ratio. Below 1 is "
      "faster or more accurate. A change of brightness is bias: more samples do not remove it. "
      "<i>Difference</i> holds noise too; compare it with the first row.</p><div class=wide><table>"
      "<tr><th>Choice<th>Time<th>Error at equal samples<th>Error<th>Brightness<th>Difference</tr>{}"
      "</table></div>",
      knob_rows(document));
  if (document.contains("left_out")) {
    std::string names;
    for (const Json& one : document["left_out"])
      names += (names.empty() ? "" : ", ") + escaped(one.get<std::string>());
    page += fmt::format(
        "<p>There was no time for: {}. The same command again goes on from here.</p>", names);
  }
  return page + "</html>\n";
}

}  // namespace scenec::runtime
