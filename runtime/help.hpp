// The texts of --help, made from the tables of verbs and options, and what these texts share with
// the manual page and the completions.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "runtime/options.hpp"
#include "runtime/verbs.hpp"

namespace scenec::runtime {

[[nodiscard]] std::string general_help();
[[nodiscard]] std::string help_of(Verb verb);
// The manual page, in roff.
[[nodiscard]] std::string manual_page();

// "-o", "--output".
[[nodiscard]] std::vector<std::string_view> names_of(const OptionRow& row);
// The words an option's value is one of; empty when it is free.
[[nodiscard]] std::vector<std::string> choices_of(const OptionRow& row);

}  // namespace scenec::runtime
