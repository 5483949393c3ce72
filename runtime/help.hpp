// The texts of --help, made from the tables of verbs and options.
#pragma once

#include <string>

#include "runtime/verbs.hpp"

namespace scenec::runtime {

[[nodiscard]] std::string general_help();
[[nodiscard]] std::string help_of(Verb verb);

}  // namespace scenec::runtime
