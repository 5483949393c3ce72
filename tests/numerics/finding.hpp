// What a case measured, on its way from the test to docs/numerics.md. Tests have no common state:
// a finding travels as properties of its test, and main.cpp reads them when all have run.
#pragma once

#include <fmt/format.h>

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace scenec::numerics {

// One row of the table of a case. `id` names the case in catalog.def.
struct Finding {
  std::string_view id;
  std::string input;       // which of the case's inputs: "D = 1e4"
  std::uint64_t rays = 0;  // how many rays (or points, or pairs) were tried
  std::string worst;       // the worst that was measured
  std::string textbook;    // what the textbook formula does on the same input; empty: not asked
};
void record(const Finding& finding);

// One curve of a plot; the plot is in catalog.cpp under the same name.
struct Series {
  std::string_view plot;
  std::string name;
  std::vector<double> x;
  std::vector<double> y;
};
void record(const Series& series);

// "0.3", "12", "1.4e+08": three digits say what is to be said.
[[nodiscard]] inline std::string short_number(double v) {
  return fmt::format("{:.3g}", v);
}
[[nodiscard]] inline std::string percent(std::uint64_t part, std::uint64_t whole) {
  return fmt::format("{:.3g} %", 100.0 * static_cast<double>(part) / static_cast<double>(whole));
}

// The largest error met, in ulps of the true value and as a share of the bound that was promised.
struct Worst {
  double ulp = 0;
  double share = 0;
  void add(double in_ulps, double of_bound) {
    // NaN must not pass for small.
    if (!(in_ulps <= ulp)) ulp = in_ulps;
    if (!(of_bound <= share)) share = of_bound;
  }
  [[nodiscard]] std::string text() const {
    return fmt::format("{} ulp, {} of the bound", short_number(ulp), short_number(share));
  }
};

}  // namespace scenec::numerics
