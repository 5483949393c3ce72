#include "frontend/course/assets.hpp"

#include <filesystem>

#include <fmt/format.h>

#include "base/text.hpp"

namespace scenec::frontend::course {

namespace {

std::string absolute_path(const std::string& path) {
  std::error_code error;
  const std::filesystem::path absolute = std::filesystem::absolute(path, error);
  return error ? path : normalized_path(absolute.string());
}

}  // namespace

std::string find_asset(Context& context, std::string_view name, Span where) {
  const std::string scene_directory = directory_of(context.options.scene_path);
  const std::string parent = joined_path(scene_directory.empty() ? "." : scene_directory, "..");
  const std::string places[] = {normalized_path(name), joined_path(scene_directory, name),
                                joined_path(parent, name)};
  for (const std::string& place : places) {
    if (context.files.is_file(place)) return place;
  }
  Diagnostic diagnostic(DiagnosticKind::course_missing_file, where,
                        fmt::format("there is no file `{}`", printable(name)));
  std::string tried;
  std::string refused;
  for (std::size_t i = 0; i < std::size(places); ++i) {
    if (i > 0 && (places[i] == places[i - 1] || places[i] == places[0])) continue;
    const auto content = context.files.read(places[i], 0);
    const bool outside = !content && content.error() == FileError::outside_root;
    std::string& list = outside ? refused : tried;
    list += fmt::format("{}`{}`", list.empty() ? "" : ", ", printable(places[i]));
  }
  if (!tried.empty()) diagnostic.notes.push_back({"tried " + tried, {}});
  if (!refused.empty()) {
    diagnostic.notes.push_back(
        {fmt::format("not tried: {} {}", refused, context.files.reason_of(FileError::outside_root)),
         {}});
  }
  context.sink.report(std::move(diagnostic));
  return places[0];
}

Text path_text(const Context& context, const std::string& path, Span origin) {
  const std::string directory = normalized_path(context.options.output_directory);
  const bool lexical =
      path.starts_with('/') == directory.starts_with('/') && !directory.starts_with("..");
  const std::string written = lexical
                                  ? relative_path(path, directory)
                                  : relative_path(absolute_path(path), absolute_path(directory));
  return {quoted_string(written), origin};
}

}  // namespace scenec::frontend::course
