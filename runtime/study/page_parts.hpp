// What the page of a study is made of: figures as text, and the plot of error against time as SVG.
#pragma once

#include <string>
#include <string_view>

#include "runtime/study/study.hpp"

namespace scenec::runtime {

[[nodiscard]] double number(const Json& value);
[[nodiscard]] std::string escaped(std::string_view text);
[[nodiscard]] std::string seconds_text(double seconds);
[[nodiscard]] std::string percent_text(double value);
// A ratio with its least and largest value.
[[nodiscard]] std::string times_text(const Json& ratio);
// What a change does to the brightness, with its band.
[[nodiscard]] std::string bias_text(const Json& row);
[[nodiscard]] std::string curve_plot(const Json& document);

}  // namespace scenec::runtime
