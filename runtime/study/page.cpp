// The report of a study as one HTML page: plots are SVG, the picture is inside, nothing is loaded.
#include <fmt/format.h>

#include <cmath>
#include <string>

#include "runtime/study/page_parts.hpp"
#include "runtime/study/study.hpp"

namespace scenec::runtime {

namespace {

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

std::string cell_of_name(const Json& row) {
  return fmt::format("<tr><td><b>{}</b><br><small>{}</small>",
                     escaped(row["name"].get<std::string>()),
                     escaped(row["what"].get<std::string>()));
}

// What leaving the effect out saves, as a share of the time.
std::string share_text(const Json& ratio) {
  const double least = 100 * (1 - number(ratio["high"]));
  const double most = 100 * (1 - number(ratio["low"]));
  const std::string band = fmt::format("<small>({:.0f} – {:.0f})</small>", least, most);
  if (least <= 0 && most >= 0) return "no difference measured " + band;
  const double share = 100 * (1 - number(ratio["value"]));
  return fmt::format("{:.0f} % {}{}", share, band, share < 0 ? "<br>it saves time" : "");
}

std::string effect_rows(const Json& document) {
  std::string rows;
  for (const Json& row : document.value("effects", Json::array())) {
    rows += fmt::format("{}<td>{}<td>{}<td>{}<td>{}", cell_of_name(row),
                        share_text(row["time_ratio"]), percent_text(number(row["changed_pixels"])),
                        bias_text(row), percent_text(number(row["difference"])));
  }
  return rows;
}

std::string uncalled_text(const Json& document) {
  std::string names;
  for (const Json& name : document.value("not_called_for", Json::array()))
    names += (names.empty() ? "" : ", ") + escaped(name.get<std::string>());
  return names.empty() ? ""
                       : "<p>The scene does not call for " + names +
                             ": nothing of them is simulated, and they cost nothing.</p>";
}

std::string knob_rows(const Json& document) {
  std::string rows;
  for (const Json& row : document.value("knobs", Json::array())) {
    const auto times = [&](const char* key, const char* otherwise) {
      return row.contains(key) ? times_text(row[key]) : std::string(otherwise);
    };
    rows += fmt::format(
        "{}<td>{}<td>{}<br><small>{} → {}</small><td>{}<td>{}<td>{}", cell_of_name(row),
        times("time_ratio", "one comparison a sample"), times("error_ratio", "no noise"),
        percent_text(number(row["error_before"]["value"])),
        percent_text(number(row["error_after"]["value"])), times("equal_error_ratio", "–"),
        bias_text(row), percent_text(number(row["difference"])));
  }
  for (const Json& row : document.value("inapplicable", Json::array())) {
    rows += fmt::format("{}<td colspan=5>does not apply: {}", cell_of_name(row),
                        escaped(row["why"].get<std::string>()));
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
      number(curve["slope"]), number(curve["slope_band"]), curve_plot(document),
      level_rows(document));
  page += fmt::format(
      "<h2>What each effect costs</h2><p>The scene is rendered without one effect at a time, with "
      "the same random numbers, six times each. <i>Share of the time</i>: what leaving it out "
      "saves; "
      "in brackets the least and the largest of the six. <i>Pixels changed</i>: by more than 2 %. "
      "<i>Bias</i>: what leaving it out does to the brightness of the picture; the brackets hold "
      "the "
      "true figure 99 times in 100. <i>Difference</i>: how far the two pictures are apart, "
      "measured "
      "like the error.</p><div class=wide><table><tr><th>Effect<th>Share of the time<th>Pixels "
      "changed<th>Bias<th>Difference</tr>{}</table></div>{}",
      effect_rows(document), uncalled_text(document));
  page += fmt::format(
      "<h2>What each choice costs</h2><p>The scene as written against the scene with one thing "
      "changed, in turn, six times each; in brackets the least and the largest of six ratios. "
      "Below "
      "1 is faster or more accurate. <i>Time to the same error</i>: of both together, as the error "
      "falls with the square root of the samples. <i>Bias</i>: by how much the whole picture is "
      "brighter or darker; more samples do not remove it, so a choice with bias never gets to the "
      "same picture. Its brackets hold the true figure 99 times in 100, but for bright samples so "
      "rare that none was met. <i>Difference</i>: how far the two pictures are apart, noise of "
      "both "
      "included where the change draws other random numbers.</p><div "
      "class=wide><table><tr><th>Choice"
      "<th>Time at equal samples<th>Error at equal samples<th>Time to the same error<th>Bias<th>"
      "Difference</tr>{}</table></div>",
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
