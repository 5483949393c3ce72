// `scenec explain`: what a diagnostic means, found by its code or its name; needs no network.
// `scenec explain effects SCENE`: which effects its picture is simulated with, and why.
#include <fmt/format.h>

#include <algorithm>
#include <string>
#include <vector>

#include "base/diagnostic.hpp"
#include "base/text.hpp"
#include "runtime/effect_report.hpp"
#include "runtime/options.hpp"
#include "runtime/session.hpp"
#include "runtime/settings.hpp"
#include "runtime/verbs.hpp"

namespace scenec::runtime {

namespace {

constexpr std::size_t text_width = 80;

std::string wrapped(std::string_view text) {
  std::string result;
  std::size_t line_length = 0;
  while (!text.empty()) {
    const std::size_t blank = std::min(text.find(' '), text.size());
    const std::string_view word = text.substr(0, blank);
    if (line_length > 0 && line_length + 1 + word.size() > text_width) {
      result += '\n';
      line_length = 0;
    }
    if (line_length > 0) {
      result += ' ';
      ++line_length;
    }
    result += word;
    line_length += word.size();
    text.remove_prefix(std::min(blank + 1, text.size()));
  }
  return result + "\n";
}

std::string_view name_of(Severity severity) {
  return severity == Severity::error ? "error" : "warning";
}

ExitCode list_all(const Environment& environment) {
  std::vector<DiagnosticKindInfo> kinds(all_diagnostic_kinds().begin(),
                                        all_diagnostic_kinds().end());
  std::sort(kinds.begin(), kinds.end(),
            [](const auto& a, const auto& b) { return a.code < b.code; });
  for (const DiagnosticKindInfo& kind : kinds) {
    environment.out << fmt::format("{}  {:<32} {}\n", kind.code, kind.name, kind.title);
  }
  return ExitCode::ok;
}

ExitCode explain_effects(const Options& given, const Environment& environment) {
  Options options = given;
  options.operands.erase(options.operands.begin());
  Session session(options);
  const auto file = session.load();
  const auto scene = file ? session.compile(*file) : std::nullopt;
  const ExitCode code = session.finish(environment);
  if (!scene || code != ExitCode::ok) return code;
  const auto settings = settings_of(options, *scene, environment);
  if (!settings) return ExitCode::usage;
  const ir::EffectReport report = ir::find_effects(*scene, *settings);
  environment.out << (options.json ? effects_json(*scene, *settings, report, session.sources())
                                   : effects_text(*scene, *settings, report, session.sources()));
  return code;
}

}  // namespace

ExitCode verbs::explain(const Options& options, const Environment& environment) {
  if (options.list) return list_all(environment);
  const std::string& wanted = options.operands.at(0);
  if (wanted == "effects") return explain_effects(options, environment);
  if (const DiagnosticKindInfo* const kind = find_diagnostic(wanted)) {
    environment.out << fmt::format("{} {} ({}): {}\n\n{}", kind->code, kind->name,
                                   name_of(kind->severity), kind->title,
                                   wrapped(kind->explanation));
    return ExitCode::ok;
  }
  std::vector<std::string_view> known;
  for (const DiagnosticKindInfo& kind : all_diagnostic_kinds()) {
    known.push_back(kind.code);
    known.push_back(kind.name);
  }
  const std::optional<std::string_view> nearest = nearest_name(wanted, known);
  environment.err << fmt::format("scenec: unknown diagnostic `{}`{}\n", printable(wanted),
                                 nearest ? fmt::format("; did you mean `{}`?", *nearest)
                                         : "; `scenec explain --list` names them all");
  return ExitCode::usage;
}

}  // namespace scenec::runtime
