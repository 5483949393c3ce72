#include "runtime/dependencies.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>

namespace scenec::runtime {

namespace {

constexpr std::string_view library_prefix = "std:";  // part of the program, no file of the disk

// What make and ninja both undo: a backslash before a blank, `#` and `:` (and before backslashes
// that stand in front of a blank or `#`), and `$$` for `$`.
std::string escaped(std::string_view name) {
  std::string text;
  std::size_t backslashes = 0;  // just before the character
  for (const char c : name) {
    if (c == ' ' || c == '\t' || c == '#') text.append(backslashes + 1, '\\');
    if (c == ':') text += '\\';
    if (c == '$') text += '$';
    text += c;
    backslashes = c == '\\' ? backslashes + 1 : 0;
  }
  return text;
}

bool is_writable(std::string_view name) {
  return name.find_first_of(std::string_view("\n\r\0", 3)) == std::string_view::npos;
}

}  // namespace

std::optional<std::string> find_dependency_problem(const Options& options) {
  if (!options.dependencies) {
    const std::string_view given = !options.dependency_file.empty()      ? "-MF"
                                   : !options.dependency_targets.empty() ? "-MT"
                                   : options.phony_dependencies          ? "-MP"
                                                                         : "";
    if (given.empty()) return std::nullopt;
    return fmt::format("`{}` needs `-MD`", given);
  }
  const std::string output = output_of(options);
  if (output.empty() && options.dependency_file.empty()) {
    return "`-MD` needs `-MF FILE` when no output is named";
  }
  if (output.empty() && options.dependency_targets.empty()) {
    return "`-MD` needs `-MT TARGET` when no output is named";
  }
  const std::string file = normalized_path(dependency_file_of(options));
  if (!output.empty() && file == normalized_path(output)) {
    return "`-MF` names the output; the dependencies need another name";
  }
  if (file == normalized_path(options.operands.at(0))) {
    return "`-MF` names the scene; the dependencies need another name";
  }
  return std::nullopt;
}

std::string dependency_file_of(const Options& options) {
  if (!options.dependency_file.empty()) return options.dependency_file;
  return std::filesystem::path(output_of(options)).replace_extension(".d").string();
}

std::vector<std::string> dependency_targets_of(const Options& options) {
  if (!options.dependency_targets.empty()) return options.dependency_targets;
  return {output_of(options)};
}

bool SharedDependencies::join(const std::vector<FileRecord>& records) {
  bool grew = false;
  for (const FileRecord& record : records) {
    const auto same = std::find_if(files.begin(), files.end(), [&](const FileRecord& other) {
      return other.path == record.path;
    });
    if (same == files.end()) {
      files.push_back(record);
      grew = true;
    } else if (record.found && !same->found) {
      same->found = true;
      grew = true;
    }
  }
  return grew;
}

Result<std::string, std::string> dependency_text(const DependencyRule& rule) {
  std::string text;
  for (const std::string& target : rule.targets) {
    if (!is_writable(target)) return Failure{target};
    text += escaped(target) + (&target == &rule.targets.back() ? ":" : " ");
  }
  if (!is_writable(rule.scene)) return Failure{rule.scene};
  std::string phony;
  const auto add = [&](const std::string& path) { text += " \\\n  " + escaped(path); };
  add(rule.scene);
  for (const FileRecord& file : rule.files) {
    if (file.path.starts_with(library_prefix) || (!file.found && rule.complete)) continue;
    if (!is_writable(file.path)) return Failure{file.path};
    if (file.path != rule.scene) add(file.path);
    if (!file.found || (rule.phony && file.path != rule.scene)) {
      phony += escaped(file.path) + ":\n";
    }
  }
  return text + "\n" + phony;
}

}  // namespace scenec::runtime
