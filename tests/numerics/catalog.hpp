// The cases by their ids, in the order of docs/numerics.md: what each claims and what bound it
// holds. One row a case in catalog.def; tests only bring figures.
#pragma once

#include <span>
#include <string_view>

namespace scenec::numerics {

struct Case {
  std::string_view id;
  std::string_view title;
  std::string_view claim;
  std::string_view bound;
};
struct Section {
  std::string_view title;
  std::string_view text;
  std::span<const Case> cases;
};
[[nodiscard]] std::span<const Section> sections();

enum class PlotKind { curves, bars };
struct Plot {
  std::string_view name;  // of the file, and what Series::plot says
  PlotKind kind = PlotKind::curves;
  std::string_view title;
  std::string_view x_label;
  std::string_view y_label;
  std::string_view case_id;                     // below whose table it stands
  std::span<const std::string_view> bar_names;  // bars: names of x = 1, 2, ...
};
[[nodiscard]] std::span<const Plot> plots();

}  // namespace scenec::numerics
