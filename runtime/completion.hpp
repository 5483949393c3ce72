// Completions of the command line for a shell, from the tables of verbs and options.
#pragma once

#include <array>
#include <string>
#include <string_view>

namespace scenec::runtime {

inline constexpr std::array<std::string_view, 3> shells{"bash", "zsh", "fish"};

// Scripts to be sourced, or put where the shell looks for completions.
[[nodiscard]] std::string bash_completion();
[[nodiscard]] std::string zsh_completion();
[[nodiscard]] std::string fish_completion();

}  // namespace scenec::runtime
