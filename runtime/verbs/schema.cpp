// `scenec schema`: every kind a scene can hold with its keys, as JSON or Markdown; made from the
// same tables that check a scene.
#include <fmt/format.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "base/text.hpp"
#include "ir/describe.hpp"
#include "runtime/options.hpp"
#include "runtime/verbs.hpp"

namespace scenec::runtime {

namespace {

using Json = nlohmann::ordered_json;

std::string_view name_of(ir::KeyRule::Kind kind) {
  switch (kind) {
    case ir::KeyRule::Kind::exactly_one:
      return "exactly one";
    case ir::KeyRule::Kind::at_most_one:
      return "at most one";
    case ir::KeyRule::Kind::together:
      return "together";
  }
  return "";
}

// "0 .. 1", "> 0"; empty when every number is allowed.
std::string range_text(const ir::Range& range) {
  const bool has_low = std::isfinite(range.low);
  const bool has_high = std::isfinite(range.high);
  const std::string low = has_low ? short_number_text(range.low) : "";
  const std::string high = has_high ? short_number_text(range.high) : "";
  if (has_low && has_high && !range.low_open && !range.high_open) return low + " .. " + high;
  std::string text;
  if (has_low) text = (range.low_open ? "> " : ">= ") + low;
  if (has_low && has_high) text += ", ";
  if (has_high) text += (range.high_open ? "< " : "<= ") + high;
  return text;
}

Json json_of(const ir::KindDescription& kind) {
  Json json{{"family", kind.family}, {"name", kind.name}, {"doc", kind.doc}};
  json["keys"] = Json::array();
  for (const ir::KeyDescription& key : kind.keys) {
    Json row{{"name", key.name}, {"type", key.type}, {"required", key.required}, {"doc", key.doc}};
    if (key.default_text) row["default"] = *key.default_text;
    if (const std::string range = range_text(key.range); !range.empty()) row["range"] = range;
    if (!key.legal_values.empty()) row["values"] = key.legal_values;
    json["keys"].push_back(std::move(row));
  }
  json["rules"] = Json::array();
  for (const ir::KeyRule& rule : kind.rules) {
    Json keys = Json::array();
    for (const std::string_view key : rule.keys) {
      if (!key.empty()) keys.push_back(key);
    }
    json["rules"].push_back({{"rule", name_of(rule.kind)}, {"keys", std::move(keys)}});
  }
  return json;
}

std::string markdown_of(const ir::KindDescription& kind) {
  std::string text = fmt::format("### {} `{}`\n\n{}\n\n", kind.family, kind.name, kind.doc);
  text += "| key | type | default | range | meaning |\n|---|---|---|---|---|\n";
  for (const ir::KeyDescription& key : kind.keys) {
    const std::string standard = key.required       ? "required"
                                 : key.default_text ? "`" + *key.default_text + "`"
                                                    : "";
    text += fmt::format("| `{}` | {} | {} | {} | {} |\n", key.name, key.type, standard,
                        range_text(key.range), key.doc);
  }
  for (const ir::KeyRule& rule : kind.rules) {
    std::vector<std::string_view> keys;
    for (const std::string_view key : rule.keys) {
      if (!key.empty()) keys.push_back(key);
    }
    text += fmt::format("\n{} of {}.\n", name_of(rule.kind), quoted_list(keys));
  }
  return text + "\n";
}

}  // namespace

ExitCode verbs::schema(const Options& options, const Environment& environment) {
  Json all = Json::array();
  std::string markdown;
  std::vector<std::string_view> names;
  for (const ir::KindDescription& kind : ir::all_kinds()) {
    names.push_back(kind.name);
    if (!options.operands.empty() && options.operands[0] != kind.name) continue;
    if (options.markdown) {
      markdown += markdown_of(kind);
    } else {
      all.push_back(json_of(kind));
    }
  }
  if (all.empty() && markdown.empty()) {
    const std::string& wanted = options.operands.at(0);
    const std::optional<std::string_view> nearest = nearest_name(wanted, names);
    environment.err << fmt::format(
        "scenec: unknown kind `{}`; {}\n", printable(wanted),
        nearest ? fmt::format("did you mean `{}`?", *nearest) : "one of " + quoted_list(names));
    return ExitCode::usage;
  }
  environment.out << (options.markdown ? markdown : all.dump(2) + "\n");
  return ExitCode::ok;
}

}  // namespace scenec::runtime
