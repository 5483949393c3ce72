// `scenec convert`: a course scene as native text; paths in it are relative to where it is written.
#include <fmt/format.h>

#include "base/file_system.hpp"
#include "base/text.hpp"
#include "runtime/output.hpp"
#include "runtime/session.hpp"
#include "runtime/verbs.hpp"

namespace scenec::runtime {

ExitCode verbs::convert(const Options& options, const Environment& environment) {
  Session session(options);
  if (!check_outputs(options, session.sink())) {
    static_cast<void>(session.finish(environment));
    return ExitCode::file_error;
  }
  const auto file = session.load(directory_of(options.output));
  if (!file || (session.has_errors() && file->native)) return session.finish(environment);
  if (!file->native) {
    environment.err << fmt::format("scenec: `{}` is in the native language already\n",
                                   printable(session.scene_path()));
    return ExitCode::usage;
  }
  return write_text(options.output, file->native->text(), session, environment);
}

}  // namespace scenec::runtime
