#include "runtime/diagnostic_formats.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <nlohmann/json.hpp>
#include <string_view>
#include <utility>

#include "runtime/cli.hpp"

namespace scenec::runtime {

namespace {

using Json = nlohmann::ordered_json;

// Escapes everything beyond ASCII (a name must not steer a terminal) and replaces invalid UTF-8.
std::string dumped(const Json& json, int indent) {
  return json.dump(indent, ' ', true, Json::error_handler_t::replace) + "\n";
}

std::string_view name_of(Severity severity) {
  return severity == Severity::error ? "error" : "warning";
}

// A fix of derived text is of no use: its words are not those of the file the author edits.
bool is_usable(const FixIt& fix, const SourceMap& sources) {
  return fix.span.valid() && sources.resolve(fix.span) == fix.span;
}

// ---- JSON lines ---------------------------------------------------------------------------------

void add_place(Json& json, Span span, const SourceMap& sources) {
  const Span place = sources.resolve(span);
  if (!place.valid()) return;
  const Position begin = sources.position(place.file, place.begin);
  const Position end = sources.position(place.file, place.end);
  json["file"] = sources.path(place.file);
  json["line"] = begin.line;
  json["column"] = begin.column;
  json["end_line"] = end.line;
  json["end_column"] = end.column;
  json["begin"] = place.begin;
  json["end"] = place.end;
}

Json placed_text(std::string_view key, std::string_view text, Span span, const SourceMap& sources) {
  Json json{{key, text}};
  add_place(json, span, sources);
  return json;
}

// ---- SARIF --------------------------------------------------------------------------------------

// A path as a URI reference (RFC 3986): every byte but the unreserved ones and `/` as `%XX`, so
// that a colon is not taken for the end of a scheme.
std::string uri_of(std::string_view path) {
  std::string uri = path.starts_with('/') ? "file://" : "";
  for (const char c : path) {
    const bool is_plain = (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') ||
                          (c >= '0' && c <= '9') ||
                          std::string_view("/-._~").find(c) != std::string_view::npos;
    if (is_plain) {
      uri += c;
    } else {
      uri += fmt::format("%{:02X}", static_cast<unsigned char>(c));
    }
  }
  return uri;
}

Json region_of(Span place, const SourceMap& sources) {
  const Position begin = sources.position(place.file, place.begin);
  const Position end = sources.position(place.file, place.end);
  return {{"startLine", begin.line},
          {"startColumn", begin.column},
          {"endLine", end.line},
          {"endColumn", end.column}};
}

Json artifact_of(Span place, const SourceMap& sources) {
  return {{"uri", uri_of(sources.path(place.file))}};
}

Json location_of(Span place, const SourceMap& sources) {
  return {
      {"physicalLocation",
       {{"artifactLocation", artifact_of(place, sources)}, {"region", region_of(place, sources)}}}};
}

Json related_location(Span place, std::string_view text, const SourceMap& sources) {
  Json location = location_of(place, sources);
  location["message"] = {{"text", text}};
  return location;
}

std::string message_of(const Diagnostic& diagnostic) {
  std::string text = diagnostic.message;
  for (const Note& note : diagnostic.notes) {
    if (!note.span.valid()) text += "\nnote: " + note.text;
  }
  for (const std::string& hint : diagnostic.hints) text += "\nhelp: " + hint;
  return text;
}

// SARIF's lists of places and fixes hold nothing twice (3.27.22, 3.27.30).
void push_once(Json& list, Json element) {
  if (std::find(list.begin(), list.end(), element) == list.end())
    list.push_back(std::move(element));
}

Json related_locations(const Diagnostic& diagnostic, const SourceMap& sources) {
  Json related = Json::array();
  const auto add = [&](Span span, std::string_view text) {
    const Span place = sources.resolve(span);
    if (place.valid()) push_once(related, related_location(place, text, sources));
  };
  for (const Label& label : diagnostic.labels) add(label.span, label.text);
  for (const Note& note : diagnostic.notes) add(note.span, note.text);
  return related;
}

// Every fix-it is a fix of its own: any one of them may be chosen.
Json fixes_of(const Diagnostic& diagnostic, const SourceMap& sources) {
  Json fixes = Json::array();
  for (const FixIt& fix : diagnostic.fixits) {
    if (!is_usable(fix, sources)) continue;
    Json replacement{{"deletedRegion", region_of(fix.span, sources)},
                     {"insertedContent", {{"text", fix.replacement}}}};
    Json change{{"artifactLocation", artifact_of(fix.span, sources)}};
    change["replacements"] = Json::array({std::move(replacement)});
    Json changes = Json::array({std::move(change)});
    push_once(fixes, Json{{"artifactChanges", std::move(changes)}});
  }
  return fixes;
}

Json result_of(const Finding& finding, std::size_t rule_index, const SourceMap& sources) {
  const Diagnostic& diagnostic = finding.diagnostic;
  Json result{{"ruleId", info_of(diagnostic.kind).code},
              {"ruleIndex", rule_index},
              {"level", name_of(finding.severity)},
              {"message", {{"text", message_of(diagnostic)}}}};
  result["locations"] = Json::array();
  const Span place = sources.resolve(diagnostic.span);
  if (place.valid()) result["locations"].push_back(location_of(place, sources));
  if (Json related = related_locations(diagnostic, sources); !related.empty()) {
    result["relatedLocations"] = std::move(related);
  }
  if (Json fixes = fixes_of(diagnostic, sources); !fixes.empty()) {
    result["fixes"] = std::move(fixes);
  }
  return result;
}

Json rule_of(const DiagnosticKindInfo& info) {
  return {{"id", info.code},
          {"name", info.name},
          {"shortDescription", {{"text", info.title}}},
          {"fullDescription", {{"text", info.explanation}}},
          {"help", {{"text", fmt::format("scenec explain {}", info.code)}}},
          {"defaultConfiguration", {{"level", name_of(info.severity)}}}};
}

}  // namespace

std::string json_line(const Finding& finding, const SourceMap& sources) {
  const Diagnostic& diagnostic = finding.diagnostic;
  const DiagnosticKindInfo& info = info_of(diagnostic.kind);
  Json json{{"version", 1},
            {"code", info.code},
            {"name", info.name},
            {"severity", name_of(finding.severity)},
            {"message", diagnostic.message}};
  add_place(json, diagnostic.span, sources);
  json["labels"] = Json::array();
  for (const Label& label : diagnostic.labels) {
    json["labels"].push_back(placed_text("text", label.text, label.span, sources));
  }
  json["notes"] = Json::array();
  for (const Note& note : diagnostic.notes) {
    json["notes"].push_back(placed_text("text", note.text, note.span, sources));
  }
  json["hints"] = diagnostic.hints;
  json["fixits"] = Json::array();
  for (const FixIt& fix : diagnostic.fixits) {
    if (!is_usable(fix, sources)) continue;
    json["fixits"].push_back(placed_text("replacement", fix.replacement, fix.span, sources));
  }
  return dumped(json, -1);
}

std::string sarif_log(std::span<const Finding> findings, const SourceMap& sources) {
  std::map<std::string_view, std::size_t> rule_indices;  // by code
  for (const Finding& finding : findings) {
    rule_indices.emplace(info_of(finding.diagnostic.kind).code, 0);
  }
  Json rules = Json::array();
  for (auto& [code, index] : rule_indices) {
    index = rules.size();
    for (const DiagnosticKindInfo& info : all_diagnostic_kinds()) {
      if (info.code == code) rules.push_back(rule_of(info));
    }
  }
  Json results = Json::array();
  for (const Finding& finding : findings) {
    const std::string_view code = info_of(finding.diagnostic.kind).code;
    results.push_back(result_of(finding, rule_indices.at(code), sources));
  }
  const std::string_view version = version_text.substr(version_text.find(' ') + 1);
  Json run{{"tool", {{"driver", {{"name", "scenec"}, {"version", version}}}}},
           {"columnKind", "unicodeCodePoints"}};
  run["tool"]["driver"]["rules"] = std::move(rules);
  run["results"] = std::move(results);
  Json log{{"$schema", "https://json.schemastore.org/sarif-2.1.0.json"}, {"version", "2.1.0"}};
  log["runs"] = Json::array({std::move(run)});
  return dumped(log, 2);
}

}  // namespace scenec::runtime
