// `scenec completion SHELL`: the script that completes scenec's command line in a shell.
#include "runtime/completion.hpp"

#include <fmt/format.h>

#include "base/text.hpp"
#include "runtime/options.hpp"

namespace scenec::runtime {

ExitCode verbs::completion(const Options& options, const Environment& environment) {
  const std::string& shell = options.operands.at(0);
  if (shell == "bash") {
    environment.out << bash_completion();
  } else if (shell == "zsh") {
    environment.out << zsh_completion();
  } else if (shell == "fish") {
    environment.out << fish_completion();
  } else {
    environment.err << fmt::format("scenec: no completions for `{}`; one of {}\n", printable(shell),
                                   quoted_list(shells));
    return ExitCode::usage;
  }
  return ExitCode::ok;
}

}  // namespace scenec::runtime
