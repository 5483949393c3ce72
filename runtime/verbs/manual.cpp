// `scenec manual`: the manual page, for `man -l -` and for installing.
#include "runtime/help.hpp"

namespace scenec::runtime {

ExitCode verbs::manual(const Options& /*options*/, const Environment& environment) {
  environment.out << manual_page();
  return ExitCode::ok;
}

}  // namespace scenec::runtime
