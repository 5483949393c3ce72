// What the process tells the shell; the numbers are part of the interface and never change meaning.
#pragma once

#include <array>
#include <span>
#include <string_view>

namespace scenec::runtime {

enum class ExitCode : int {
  ok = 0,
  scene_error = 1,  // any error in sources or in the assets they name
  usage = 2,        // the command line, a bad `-D` included
  file_error = 3,   // the scene file itself, or the output
  limit = 4,        // a limit was the only cause
  internal = 5,     // a mistake in scenec
  hung_up = 129,
  interrupted = 130,
  terminated = 143,
};

struct ExitCodeInfo {
  ExitCode code;
  std::string_view meaning;
};
// For the manual page.
[[nodiscard]] inline std::span<const ExitCodeInfo> all_exit_codes() {
  static constexpr std::array table{
      ExitCodeInfo{ExitCode::ok, "done"},
      ExitCodeInfo{ExitCode::scene_error,
                   "an error in the scene or in a file it names; pictures beyond `--tolerance`"},
      ExitCodeInfo{ExitCode::usage,
                   "a mistake on the command line, a bad parameter of the scene included"},
      ExitCodeInfo{ExitCode::file_error, "the scene file or an output cannot be read or written"},
      ExitCodeInfo{ExitCode::limit, "a limit was the only cause"},
      ExitCodeInfo{ExitCode::internal, "a mistake in scenec"},
      ExitCodeInfo{ExitCode::hung_up, "stopped by SIGHUP; the picture so far is written"},
      ExitCodeInfo{ExitCode::interrupted, "stopped by SIGINT; the picture so far is written"},
      ExitCodeInfo{ExitCode::terminated, "stopped by SIGTERM; the picture so far is written"},
  };
  return table;
}

}  // namespace scenec::runtime
