// The program: connects the process to runtime::run.
#include <unistd.h>

#include <cstdlib>
#include <iostream>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "runtime/cli.hpp"

int main(int argument_count, char** arguments) {
  std::ios::sync_with_stdio(false);
  const scenec::runtime::Environment environment{
      .out = std::cout,
      .err = std::cerr,
      .err_is_terminal = ::isatty(STDERR_FILENO) == 1,
      .variable = [](std::string_view name) -> std::optional<std::string> {
        const char* const value = std::getenv(std::string(name).c_str());
        return value == nullptr ? std::nullopt : std::optional<std::string>(value);
      },
      .handle_signals = true,
      .in = &std::cin,
  };
  const std::vector<std::string> words(arguments + (argument_count > 0 ? 1 : 0),
                                       arguments + argument_count);
  return static_cast<int>(scenec::runtime::run(words, environment));
}
