// Numbers, vectors, colours and strings of course files as expressions of the language.
#pragma once

#include <span>
#include <string_view>

#include "frontend/course/reader.hpp"
#include "frontend/course/writer.hpp"

namespace scenec::frontend::course {

// The numeral as written where the language reads it the same way, else its shortest exact form.
[[nodiscard]] Text text_of(const Number& number);
// A computed number: integers without a point, else the shortest exact form.
[[nodiscard]] Text text_of_value(double value, Span origin = {});
// `[x, y, z]`, each number with its range.
[[nodiscard]] Text list_of(std::span<const Number> numbers);
[[nodiscard]] Text list_of_values(std::span<const double> values, Span origin);
// `rgb(r, g, b)`, `gray(v)` for one number or three equal ones, `black` and `white`.
[[nodiscard]] Text color_of(std::span<const Number> numbers);
[[nodiscard]] Text color_of_values(std::span<const double> values, Span origin);
// `30deg`.
[[nodiscard]] Text degrees_of(const Number& number);

}  // namespace scenec::frontend::course
