#include "runtime/environment.hpp"

namespace scenec::runtime {

namespace {

bool is_set(const Environment& environment, std::string_view name) {
  const std::optional<std::string> value = environment.variable(name);
  return value && !value->empty();
}

}  // namespace

bool use_color(ColorChoice choice, const Environment& environment) {
  if (choice != ColorChoice::automatic) return choice == ColorChoice::always;
  if (is_set(environment, "NO_COLOR")) return false;
  if (is_set(environment, "FORCE_COLOR") || is_set(environment, "CLICOLOR_FORCE")) return true;
  if (environment.variable("TERM") == "dumb") return false;
  return environment.err_is_terminal;
}

}  // namespace scenec::runtime
