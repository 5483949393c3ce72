#include "runtime/session.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <filesystem>
#include <tuple>
#include <utility>

#include "base/render_diagnostic.hpp"
#include "frontend/frontend_cache.hpp"
#include "runtime/dependencies.hpp"
#include "runtime/output.hpp"
#include "runtime/params_file.hpp"
#include "runtime/root.hpp"

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
  result.camera_chosen = options.camera.has_value();
  result.limits = options.limits;
  for (const NameAndValue& setting : options.settings) {
    result.params.push_back({.name = setting.name, .value = setting.value});
  }
  if (options.frames) {
    result.frame = {.number = options.frame.value_or(options.frames->first),
                    .last = options.frames->last,
                    .per_second = options.frame_rate.value_or(default_frame_rate)};
  }
  return result;
}

std::string counted(std::size_t count, std::string_view noun) {
  return fmt::format("{} {}{}", count, noun, count == 1 ? "" : "s");
}

bool is_error(const Finding& finding) {
  return finding.severity == Severity::error;
}

// A mistake in `-D`, `--params` or `--frames` is a mistake of the command line, although the
// compiler finds it: the parameter does not exist, the file of parameters is broken, the clock has
// no such frame, or the error lies in the text behind a name, which is a file of its own.
bool is_usage_mistake(const Diagnostic& diagnostic, const SourceMap& sources) {
  if (info_of(diagnostic.kind).severity != Severity::error) return false;
  using enum DiagnosticKind;
  constexpr std::array of_options{unknown_param, params_file, clock_missing, clock_frames};
  if (std::find(of_options.begin(), of_options.end(), diagnostic.kind) != of_options.end())
    return true;
  if (!diagnostic.span.valid()) return false;
  const std::string_view path = sources.path(diagnostic.span.file);
  return path.starts_with("-D ") || path.starts_with("--params ");
}

}  // namespace

Session::Session(const Options& options)
    : options_(options),
      compile_options_(compile_options_of(options)),
      scene_path_(path_from_working_directory(options.operands.at(0))),
      disk_(root_of(options, scene_path_)),
      files_(disk_) {
  if (options.strict_links) disk_.refuse_hard_links();
  disk_.permit(scene_path_);
  if (!options.params_file.empty()) disk_.permit(options.params_file);
}

std::optional<frontend::LoadedFile> Session::load(
    const std::optional<std::string>& output_directory, frontend::LoadTree load_tree) {
  if (!load_params()) return std::nullopt;
  auto file = frontend::load(scene_path_, compile_options_, files_, sources_, sink_,
                             output_directory, load_tree);
  loaded_ = true;
  scene_unreadable_ = !file.has_value();
  return file;
}

bool Session::load_params() {
  if (options_.params_file.empty()) return true;
  auto read = read_params_file(options_.params_file, files_, sources_, sink_);
  if (!read) {
    loaded_ = true;  // as far as it goes: the file of parameters is what a rule for make waits for
    return false;
  }
  // Those of the command line come behind and win.
  auto& params = compile_options_.params;
  params.insert(params.begin(), std::make_move_iterator(read->begin()),
                std::make_move_iterator(read->end()));
  return true;
}

std::vector<NameAndValue> Session::settings() const {
  std::vector<NameAndValue> result;
  for (const frontend::ParamSetting& param : compile_options_.params) {
    const auto same = std::find_if(result.begin(), result.end(), [&](const NameAndValue& other) {
      return other.name == param.name;
    });
    if (same == result.end()) {
      result.push_back({param.name, param.value});
    } else {
      same->value = param.value;
    }
  }
  return result;
}

std::optional<ir::Scene> Session::compile(const frontend::LoadedFile& file) {
  return frontend::compile(file, compile_options_, files_, sources_, sink_);
}

std::optional<ir::Scene> Session::load_and_compile(ThreadPool& pool,
                                                   frontend::FrontendCache* texts) {
  compile_options_.pool = &pool;
  compile_options_.cache = texts;
  compile_options_.clocks = &clocks_;
  const auto file = load(std::nullopt, frontend::LoadTree::unless_large);
  if (file) {
    tree_bytes_ = file->tree.nodes().size_bytes();
    if (file->native) tree_bytes_ += file->native->nodes().size_bytes();
  }
  auto scene = file ? compile(*file) : std::nullopt;
  if (texts != nullptr && file) params_ = texts->params();
  return scene;
}

bool Session::has_read(const std::string& path) const {
  std::error_code ignored;
  const std::vector<FileRecord> records = files_.records();
  return std::any_of(records.begin(), records.end(), [&](const FileRecord& record) {
    return record.found && std::filesystem::equivalent(record.path, path, ignored);
  });
}

bool Session::has_errors() const {
  if (sink_.has_errors()) return true;
  const std::vector<Finding> all = findings();
  return std::any_of(all.begin(), all.end(), is_error);
}

std::vector<Finding> Session::findings() const {
  std::vector<Finding> result;
  for (Diagnostic& diagnostic : sink_.sorted()) {
    Severity severity = info_of(diagnostic.kind).severity;
    if (options_.denials.cover(diagnostic.kind)) {
      severity = Severity::error;
      diagnostic.notes.push_back({"denied by `--deny`", {}});
    }
    result.push_back({std::move(diagnostic), severity});
  }
  // What is said of a translated text stands where the author wrote it.
  const auto place = [&](const Finding& finding) {
    const Span span = finding.diagnostic.span;
    return span.valid() ? sources_.resolve(span) : span;
  };
  std::stable_sort(result.begin(), result.end(), [&](const Finding& a, const Finding& b) {
    const Span first = place(a);
    const Span second = place(b);
    return std::tuple(first.file, first.begin) < std::tuple(second.file, second.begin);
  });
  return result;
}

bool Session::write_dependencies() {
  if (!options_.dependencies || !loaded_) return true;
  const std::string path = dependency_file_of(options_);
  if (!check_output_is_no_input(path, *this)) return false;
  if (shared_ != nullptr) {
    const bool grew = shared_->join(files_.records());
    const bool was_written = std::exchange(shared_->written, true);
    if (was_written && !grew && !has_errors()) return true;
  }
  const Result<std::string, std::string> text =
      dependency_text({.targets = shared_ ? shared_->targets : dependency_targets_of(options_),
                       .scene = scene_path_,
                       .files = shared_ ? shared_->files : files_.records(),
                       .phony = options_.phony_dependencies,
                       .complete = !has_errors()});
  if (text.ok()) return write_output(path, text.value(), sink_);
  sink_.report(Diagnostic(
      DiagnosticKind::output_unwritable, {},
      fmt::format("`{}`: no dependency file can hold the name `{}`", path, text.error())));
  return false;
}

void Session::print(const std::vector<Finding>& findings, const Environment& environment) const {
  if (options_.diagnostics == DiagnosticsForm::sarif) {
    environment.err << sarif_log(findings, sources_);
    return;
  }
  if (options_.diagnostics == DiagnosticsForm::json) {
    for (const Finding& finding : findings) environment.err << json_line(finding, sources_);
    return;
  }
  const std::size_t printed = std::min(findings.size(), most_diagnostics_printed);
  for (std::size_t i = 0; i < printed; ++i) {
    const RenderOptions form{.color = use_color(options_.color, environment),
                             .severity = findings[i].severity};
    std::string text = render_terminal(findings[i].diagnostic, sources_, form);
    if (!text.ends_with('\n')) text += '\n';
    environment.err << text;
  }
  if (printed < findings.size()) {
    environment.err << fmt::format("and {} more\n", findings.size() - printed);
  }
  const auto errors =
      static_cast<std::size_t>(std::count_if(findings.begin(), findings.end(), is_error));
  const std::size_t warnings = findings.size() - errors;
  if (errors > 0 && warnings > 0) {
    environment.err << fmt::format("{}, {}\n", counted(errors, "error"),
                                   counted(warnings, "warning"));
  } else if (errors + warnings > 0) {
    environment.err << counted(errors + warnings, errors > 0 ? "error" : "warning") << '\n';
  }
}

ExitCode Session::finish(const Environment& environment) {
  const bool dependencies_written = write_dependencies();
  std::vector<Finding> all = findings();
  if (told_ != nullptr) {
    std::erase_if(all, [&](const Finding& finding) {
      return !is_error(finding) &&
             !told_->insert(render_terminal(finding.diagnostic, sources_, {})).second;
    });
  }
  print(all, environment);
  if (!dependencies_written) return ExitCode::file_error;
  if (std::none_of(all.begin(), all.end(), is_error)) return ExitCode::ok;
  const auto is_usage = [&](const Finding& f) { return is_usage_mistake(f.diagnostic, sources_); };
  if (std::any_of(all.begin(), all.end(), is_usage)) return ExitCode::usage;
  const auto is_no_limit = [](const Finding& f) {
    return is_error(f) && !info_of(f.diagnostic.kind).is_limit();
  };
  if (std::none_of(all.begin(), all.end(), is_no_limit)) return ExitCode::limit;
  return scene_unreadable_ ? ExitCode::file_error : ExitCode::scene_error;
}

void Session::print_late(const Diagnostic& diagnostic, const Environment& environment) const {
  if (options_.diagnostics == DiagnosticsForm::json) {
    environment.err << json_line({diagnostic, Severity::error}, sources_);
  } else {
    environment.err << fmt::format("scenec: error[{}]: {}\n", info_of(diagnostic.kind).code,
                                   diagnostic.message);
  }
}

}  // namespace scenec::runtime
