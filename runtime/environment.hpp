// What a run sees of the process around it, passed down so that tests can run the whole program
// inside themselves.
#pragma once

#include <functional>
#include <istream>
#include <optional>
#include <ostream>
#include <string>
#include <string_view>

namespace scenec::runtime {

struct Environment {
  std::ostream& out;
  std::ostream& err;
  bool err_is_terminal = false;
  // Value of an environment variable; nullopt when it is not set.
  std::function<std::optional<std::string>(std::string_view)> variable;
  bool handle_signals = false;  // only the real process takes SIGINT and SIGTERM
  std::istream* in = nullptr;   // standard input; null: empty
};

enum class ColorChoice { automatic, always, never };

// Whether messages carry colours: the option, then NO_COLOR, FORCE_COLOR and CLICOLOR_FORCE (each
// counts when it is not empty), then TERM=dumb, then whether a person is watching.
[[nodiscard]] bool use_color(ColorChoice choice, const Environment& environment);

}  // namespace scenec::runtime
