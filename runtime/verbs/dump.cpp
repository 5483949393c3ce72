// `scenec dump`: the result of one stage of the compiler as text.
#include "ir/dump.hpp"
#include <string>

#include "base/file_system.hpp"
#include "grammar/syntax_tree.hpp"
#include "runtime/effect_report.hpp"
#include "runtime/output.hpp"
#include "runtime/session.hpp"
#include "runtime/settings.hpp"
#include "runtime/verbs.hpp"

namespace scenec::runtime {

namespace {

// Text for a terminal or a file ends with a line end.
std::string ended(std::string text) {
  if (!text.ends_with('\n')) text += '\n';
  return text;
}

}  // namespace

ExitCode verbs::dump(const Options& options, const Environment& environment) {
  Session session(options);
  if (!check_outputs(options, session.sink())) {
    static_cast<void>(session.finish(environment));
    return ExitCode::file_error;
  }
  const auto file =
      session.load(std::nullopt, options.stage == DumpStage::ir ? frontend::LoadTree::unless_large
                                                                : frontend::LoadTree::always);
  if (!file) return session.finish(environment);
  if (options.stage == DumpStage::tree) {
    return write_text(options.output, ended(grammar::dump_tree(file->tree)), session, environment);
  }
  if (options.stage == DumpStage::ast) {
    return write_text(options.output, ended(frontend::dump_ast(file->native_tree())), session,
                      environment);
  }
  const auto scene = session.compile(*file);
  if (!scene || session.has_errors()) return session.finish(environment);
  if (options.stage == DumpStage::effects) {
    const auto settings = settings_of(options, *scene, environment);
    if (!settings) return ExitCode::usage;
    return write_text(options.output, effects_dump(ir::find_effects(*scene, *settings)), session,
                      environment);
  }
  const std::string text = ir::dump_text(*scene, {.directory = directory_of(options.output)});
  return write_text(options.output, text, session, environment);
}

}  // namespace scenec::runtime
