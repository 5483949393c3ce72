#include "runtime/output.hpp"

#include <fmt/format.h>

#include <filesystem>
#include <system_error>

#include "base/atomic_file.hpp"
#include "base/text.hpp"
#include "runtime/dependencies.hpp"

namespace scenec::runtime {

namespace {

void report(DiagnosticSink& sink, DiagnosticKind kind, const std::string& path,
            const std::string& problem) {
  sink.report(Diagnostic(kind, {}, fmt::format("`{}`: {}", printable(path), problem)));
}

}  // namespace

bool check_output(const std::string& path, DiagnosticSink& sink) {
  const std::optional<std::string> problem = find_output_problem(path);
  if (problem) report(sink, DiagnosticKind::output_unwritable, path, *problem);
  return !problem;
}

bool check_outputs(const Options& options, DiagnosticSink& sink) {
  const bool output_fits = options.output.empty() || check_output(options.output, sink);
  return (!options.dependencies || check_output(dependency_file_of(options), sink)) && output_fits;
}

std::optional<backend::ImageFormat> check_picture_output(const std::string& path,
                                                         DiagnosticSink& sink) {
  if (!check_output(path, sink)) return std::nullopt;
  const std::optional<backend::ImageFormat> format = backend::image_format_of(path);
  if (!format) {
    const std::string extension = extension_of(path);
    report(sink, DiagnosticKind::output_format_unknown, path,
           (extension.empty() ? std::string("the name has no extension")
                              : fmt::format("`{}` is no picture format", printable(extension))) +
               "; one of `.png`, `.exr`, `.bmp` is expected");
  }
  return format;
}

bool check_output_is_no_input(const std::string& path, Session& session) {
  if (!session.has_read(path)) return true;
  report(session.sink(), DiagnosticKind::output_is_input, path,
         "is a file the scene is made from; the output needs another name");
  return false;
}

bool write_output(const std::string& path, std::string_view bytes, DiagnosticSink& sink) {
  const std::optional<std::string> problem = write_file_atomically(path, bytes);
  if (problem) report(sink, DiagnosticKind::output_unwritable, path, *problem);
  return !problem;
}

ExitCode write_text(const std::string& path, std::string_view text, Session& session,
                    const Environment& environment) {
  if (path.empty()) {
    environment.out << text;
    return session.finish(environment);
  }
  const bool written =
      check_output_is_no_input(path, session) && write_output(path, text, session.sink());
  const ExitCode code = session.finish(environment);
  return written ? code : ExitCode::file_error;
}

bool make_folder(const std::string& path, const Environment& environment) {
  std::error_code problem;
  std::filesystem::create_directories(path, problem);
  if (problem)
    environment.err << fmt::format("scenec: `{}`: {}\n", printable(path), problem.message());
  return !problem;
}

}  // namespace scenec::runtime
