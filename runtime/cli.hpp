// From the words of a command line to Options, or to the text that answers them (help, version,
// what is wrong). CLI11 is visible in cli.cpp only: including it costs seconds.
#pragma once

#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "runtime/options.hpp"

namespace scenec::runtime {

struct UsageError {
  std::string message;
};
struct Answer {  // --help, --version
  std::string text;
};
using CommandLine = std::variant<Options, Answer, UsageError>;

// `words` without the program's name.
[[nodiscard]] CommandLine parse_command_line(const std::vector<std::string>& words);

// The whole program: parses, runs the verb, prints usage errors. Exceptions do not leave.
[[nodiscard]] ExitCode run(const std::vector<std::string>& words, const Environment& environment);

inline constexpr std::string_view version_text = "scenec 0.1.0";

}  // namespace scenec::runtime
