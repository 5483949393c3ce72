#include "runtime/watch/source_change.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <limits>

#include "base/atomic_file.hpp"
#include "base/text.hpp"
#include "frontend/format/unified_diff.hpp"

namespace scenec::runtime {

Result<SourceChange, std::string> change_of_param(const Attempt& attempt, std::string_view name,
                                                  const std::string& value) {
  const Session& session = attempt.reading->session;
  const auto& params = session.params();
  const auto param = std::find_if(params.begin(), params.end(),
                                  [&](const auto& info) { return info.name == name; });
  if (param == params.end())
    return Failure{fmt::format("the scene has no param `{}`", printable(name))};
  // Only what the compiler has taken: a text that does not fit would break the scene.
  const auto& settings = attempt.reading->options.settings;
  const bool is_in_use = std::any_of(settings.begin(), settings.end(), [&](const NameAndValue& s) {
    return s.name == name && s.value == value;
  });
  if (attempt.failed() || !is_in_use)
    return Failure{std::string("only a value that the picture shows can be written")};
  const SourceMap& sources = attempt.sources();
  const std::string path(sources.path(param->span.file));
  if (path != session.scene_path())
    return Failure{std::string("the param does not stand in the scene's own file")};
  const std::string_view text = sources.text(param->span.file);
  SourceChange change{.path = path, .before = hash_bytes(text), .text = std::string(text)};
  const bool is_string = param->kind == frontend::ParamInfo::Kind::string;
  change.text.replace(param->span.begin, param->span.end - param->span.begin,
                      is_string ? quoted_string(value) : value);
  change.diff = frontend::unified_diff(text, change.text, path, path);
  return change;
}

std::optional<std::string> apply_change(const SourceChange& change, std::string_view hash) {
  constexpr std::string_view moved_on = "the file has changed meanwhile; it is left as it is";
  if (hash != change.before.hex()) return std::string(moved_on);
  // Links stay links: the file they lead to is replaced.
  std::error_code error;
  const std::string path = std::filesystem::canonical(change.path, error).string();
  if (error) return std::string(moved_on);
  RealFileSystem disk;
  const auto now = disk.read(path, std::numeric_limits<std::int64_t>::max());
  if (!now || hash_bytes(now.value().bytes) != change.before) return std::string(moved_on);
  return write_file_atomically(path, change.text);
}

}  // namespace scenec::runtime
