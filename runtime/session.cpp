#include "runtime/session.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>

#include "base/render_diagnostic.hpp"

namespace scenec::runtime {

namespace {

constexpr std::size_t most_diagnostics_printed = 100;

std::string path_from_working_directory(const std::string& path) {
  std::error_code error;
  const std::string directory = std::filesystem::current_path(error).string();
  if (!error && path.starts_with(directory + "/")) return relative_path(path, directory);
  return path;
}

frontend::CompileOptions compile_options_of(const Options& options) {
  frontend::CompileOptions result;
  result.dialect = options.dialect;
  result.method = options.method;
  result.library = options.verb != Verb::render;
  if (options.max_items) result.max_items = static_cast<std::uint64_t>(*options.max_items);
  for (const NameAndValue& setting : options.settings) {
    result.params.push_back({setting.name, setting.value});
  }
  return result;
}

std::string counted(std::size_t count, std::string_view noun) {
  return fmt::format("{} {}{}", count, noun, count == 1 ? "" : "s");
}

// A mistake in `-D` is a mistake of the command line, although the compiler finds it: the parameter
// does not exist, or the error lies in the text behind the name, which is a file of its own.
bool is_usage_mistake(const Diagnostic& diagnostic, const SourceMap& sources) {
  if (info_of(diagnostic.kind).severity != Severity::error) return false;
  if (diagnostic.kind == DiagnosticKind::unknown_param) return true;
  return diagnostic.span.valid() && sources.path(diagnostic.span.file).starts_with("-D ");
}

}  // namespace

Session::Session(const Options& options)
    : options_(options),
      compile_options_(compile_options_of(options)),
      scene_path_(path_from_working_directory(options.operands.at(0))),
      files_(disk_) {}

std::optional<frontend::LoadedFile> Session::load(
    const std::optional<std::string>& output_directory) {
  auto file =
      frontend::load(scene_path_, compile_options_, files_, sources_, sink_, output_directory);
  scene_unreadable_ = !file.has_value();
  return file;
}

std::optional<ir::Scene> Session::compile(const frontend::LoadedFile& file) {
  return frontend::compile(file, compile_options_, files_, sources_, sink_);
}

bool Session::has_read(const std::string& path) const {
  std::error_code ignored;
  const std::vector<FileRecord> records = files_.records();
  return std::any_of(records.begin(), records.end(), [&](const FileRecord& record) {
    return record.found && std::filesystem::equivalent(record.path, path, ignored);
  });
}

ExitCode Session::finish(const Environment& environment) const {
  const std::vector<Diagnostic> diagnostics = sink_.sorted();
  const RenderOptions form{.color = use_color(options_.color, environment)};
  const std::size_t printed = std::min(diagnostics.size(), most_diagnostics_printed);
  for (std::size_t i = 0; i < printed; ++i) {
    std::string text = render_terminal(diagnostics[i], sources_, form);
    if (!text.ends_with('\n')) text += '\n';
    environment.err << text;
  }
  if (printed < diagnostics.size()) {
    environment.err << fmt::format("and {} more\n", diagnostics.size() - printed);
  }
  const std::size_t errors = sink_.error_count();
  const std::size_t warnings = sink_.warning_count();
  if (errors > 0 && warnings > 0) {
    environment.err << fmt::format("{}, {}\n", counted(errors, "error"),
                                   counted(warnings, "warning"));
  } else if (errors + warnings > 0) {
    environment.err << counted(errors + warnings, errors > 0 ? "error" : "warning") << '\n';
  }
  if (errors == 0) return ExitCode::ok;
  const auto is_usage = [&](const Diagnostic& d) { return is_usage_mistake(d, sources_); };
  if (std::any_of(diagnostics.begin(), diagnostics.end(), is_usage)) return ExitCode::usage;
  if (sink_.only_limits()) return ExitCode::limit;
  return scene_unreadable_ ? ExitCode::file_error : ExitCode::scene_error;
}

}  // namespace scenec::runtime
