// What the process tells the shell; the numbers are part of the interface and never change meaning.
#pragma once

namespace scenec::runtime {

enum class ExitCode : int {
  ok = 0,
  scene_error = 1,  // any error in sources or in the assets they name
  usage = 2,        // the command line, a bad `-D` included
  file_error = 3,   // the scene file itself, or the output
  limit = 4,        // a limit was the only cause
  internal = 5,     // a mistake in scenec
  interrupted = 130,
  terminated = 143,
};

}  // namespace scenec::runtime
