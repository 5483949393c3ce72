#include "runtime/stress_report.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "base/text.hpp"

namespace scenec::runtime {

namespace {

std::string p_text(double log_p) {
  return log_p < -600 ? std::string("0") : fmt::format("{:.2g}", std::exp(log_p));
}

}  // namespace

std::string text_of(const StressOutcome& o) {
  std::string text = fmt::format("{:<10}{:<10} p {:<9} {:5.1f} % of the pixels the same; {}\n",
                                 o.name, o.agrees ? "agrees" : "DISAGREES",
                                 p_text(o.agreement.log_p), 100 * o.same, o.what);
  for (const StressOutcome::Place& p : o.places) {
    text += fmt::format("  {},{}: {:.4g} and {:.4g} over the block, {:.1f} sigma{}{}\n", p.x, p.y,
                        p.block.first, p.block.second, p.block.deviations,
                        p.line.empty() ? std::string() : "; " + printable(p.line, 200),
                        p.name.empty() ? std::string() : " `" + printable(p.name) + "`");
  }
  return text;
}

nlohmann::ordered_json json_of(const StressOutcome& o) {
  nlohmann::ordered_json row{{"name", o.name},
                             {"what", o.what},
                             {"agrees", o.agrees},
                             {"log_p", std::max(o.agreement.log_p, -1e300)},
                             {"same_pixels", o.same}};
  row["places"] = nlohmann::ordered_json::array();
  for (const StressOutcome::Place& p : o.places) {
    row["places"].push_back({{"x", p.x},
                             {"y", p.y},
                             {"as_written", p.block.first},
                             {"changed", p.block.second},
                             {"sigma", std::min(p.block.deviations, 1e300)},
                             {"item", p.name},
                             {"line", p.line}});
  }
  return row;
}

}  // namespace scenec::runtime
