#include "tests/golden/sarif_rules.hpp"

#include <algorithm>
#include <cctype>
#include <map>
#include <set>
#include <string_view>

namespace scenec::test {

namespace {

using Json = nlohmann::json;

enum class Form {
  text,
  uri,            // absolute
  uri_reference,  // RFC 3986, section 4.1
  index,          // integer, at least -1
  from_one,       // integer, at least 1
  choice,         // one of `choices`
  object,         // of the type `of`
  array,          // of objects of the type `of`
  distinct,       // the same, no two alike
  distinct_some,  // the same, and at least one
  some,           // of objects, at least one
};
struct Property {
  std::string_view name;
  Form form;
  std::string_view of = {};
  std::vector<std::string_view> choices = {};
};
struct Type {
  std::vector<Property> properties;
  std::vector<std::string_view> required = {};
  std::vector<std::string_view> one_of = {};  // at least one of these
};

const std::vector<std::string_view> levels{"none", "note", "warning", "error"};

// By the names of the schema's definitions.
const std::map<std::string_view, Type>& types() {
  static const std::map<std::string_view, Type> all{
      {"log",
       {.properties = {{"$schema", Form::uri},
                       {"version", Form::choice, {}, {"2.1.0"}},
                       {"runs", Form::array, "run"}},
        .required = {"version", "runs"}}},
      {"run",
       {.properties = {{"tool", Form::object, "tool"},
                       {"results", Form::array, "result"},
                       {"columnKind", Form::choice, {}, {"utf16CodeUnits", "unicodeCodePoints"}}},
        .required = {"tool", "results"}}},
      {"tool", {.properties = {{"driver", Form::object, "toolComponent"}}, .required = {"driver"}}},
      {"toolComponent",
       {.properties = {{"name", Form::text},
                       {"version", Form::text},
                       {"semanticVersion", Form::text},
                       {"informationUri", Form::uri},
                       {"rules", Form::distinct, "reportingDescriptor"}},
        .required = {"name"}}},
      {"reportingDescriptor",
       {.properties = {{"id", Form::text},
                       {"name", Form::text},
                       {"shortDescription", Form::object, "multiformatMessageString"},
                       {"fullDescription", Form::object, "multiformatMessageString"},
                       {"help", Form::object, "multiformatMessageString"},
                       {"helpUri", Form::uri},
                       {"defaultConfiguration", Form::object, "reportingConfiguration"}},
        .required = {"id"}}},
      {"multiformatMessageString",
       {.properties = {{"text", Form::text}, {"markdown", Form::text}}, .required = {"text"}}},
      {"reportingConfiguration", {.properties = {{"level", Form::choice, {}, levels}}}},
      {"result",
       {.properties = {{"ruleId", Form::text},
                       {"ruleIndex", Form::index},
                       {"level", Form::choice, {}, levels},
                       {"message", Form::object, "message"},
                       {"locations", Form::array, "location"},
                       {"relatedLocations", Form::distinct, "location"},
                       {"fixes", Form::distinct, "fix"}},
        .required = {"message"}}},
      {"message",
       {.properties = {{"text", Form::text}, {"markdown", Form::text}, {"id", Form::text}},
        .one_of = {"text", "id"}}},
      {"location",
       {.properties = {{"id", Form::index},
                       {"physicalLocation", Form::object, "physicalLocation"},
                       {"message", Form::object, "message"}}}},
      {"physicalLocation",
       {.properties = {{"artifactLocation", Form::object, "artifactLocation"},
                       {"region", Form::object, "region"}},
        .one_of = {"address", "artifactLocation"}}},
      {"artifactLocation",
       {.properties = {{"uri", Form::uri_reference}, {"uriBaseId", Form::text}}}},
      {"region",
       {.properties = {{"startLine", Form::from_one},
                       {"startColumn", Form::from_one},
                       {"endLine", Form::from_one},
                       {"endColumn", Form::from_one}}}},
      {"fix",
       {.properties = {{"description", Form::object, "message"},
                       {"artifactChanges", Form::distinct_some, "artifactChange"}},
        .required = {"artifactChanges"}}},
      {"artifactChange",
       {.properties = {{"artifactLocation", Form::object, "artifactLocation"},
                       {"replacements", Form::some, "replacement"}},
        .required = {"artifactLocation", "replacements"}}},
      {"replacement",
       {.properties = {{"deletedRegion", Form::object, "region"},
                       {"insertedContent", Form::object, "artifactContent"}},
        .required = {"deletedRegion"}}},
      {"artifactContent", {.properties = {{"text", Form::text}, {"binary", Form::text}}}},
  };
  return all;
}

bool is_hex(char c) {
  return std::isxdigit(static_cast<unsigned char>(c)) != 0;
}

// Characters and escapes of RFC 3986; for a reference no colon before the first slash.
bool is_uri(std::string_view text, bool absolute) {
  constexpr std::string_view marks = "-._~:/?#[]@!$&'()*+,;=";
  for (std::size_t i = 0; i < text.size(); ++i) {
    const char c = text[i];
    const bool escape =
        c == '%' && i + 2 < text.size() && is_hex(text[i + 1]) && is_hex(text[i + 2]);
    const bool plain = std::isalnum(static_cast<unsigned char>(c)) != 0 && (c & 0x80) == 0;
    if (!escape && !plain && marks.find(c) == std::string_view::npos) return false;
  }
  const std::size_t colon = text.find(':');
  const bool has_scheme = colon != std::string_view::npos && colon < text.find('/');
  if (absolute) return has_scheme;
  return !text.empty() && (!has_scheme || text.starts_with("file:///"));
}

class Checker {
 public:
  void object(const Json& json, std::string_view type_name, const std::string& path) {
    if (!json.is_object()) return say(path, "is no object");
    const Type& type = types().at(type_name);
    for (const auto& [key, value] : json.items()) {
      const auto known =
          std::find_if(type.properties.begin(), type.properties.end(),
                       [&key = key](const Property& property) { return property.name == key; });
      if (known == type.properties.end()) {
        say(path, "has the property `" + key + "`, for which there is no rule");
      } else {
        property(value, *known, path + "/" + key);
      }
    }
    for (const std::string_view key : type.required) {
      if (!json.contains(key)) say(path, "lacks `" + std::string(key) + "`");
    }
    const bool has_one = type.one_of.empty() ||
                         std::any_of(type.one_of.begin(), type.one_of.end(),
                                     [&](std::string_view key) { return json.contains(key); });
    if (!has_one) say(path, "lacks `" + std::string(type.one_of[0]) + "`");
    if (type_name == "region") region(json, path);
  }

  std::vector<std::string> problems;

 private:
  void say(const std::string& path, const std::string& text) {
    problems.push_back(path + " " + text);
  }

  // 3.30: an end stands at or behind its start.
  void region(const Json& json, const std::string& path) {
    const auto number = [&](const char* key, int otherwise) { return json.value(key, otherwise); };
    const int start = number("startLine", 1);
    const int end = number("endLine", start);
    const int start_column = number("startColumn", 1);
    const bool ends_before =
        end < start || (end == start && number("endColumn", start_column) < start_column);
    if (ends_before) say(path, "ends before it starts");
  }

  void array(const Json& json, const Property& rule, const std::string& path) {
    if (!json.is_array()) return say(path, "is no array");
    const bool needs_one = rule.form == Form::some || rule.form == Form::distinct_some;
    const bool needs_distinct = rule.form == Form::distinct || rule.form == Form::distinct_some;
    if (needs_one && json.empty()) say(path, "is empty");
    std::set<std::string> seen;
    std::size_t index = 0;
    for (const Json& element : json) {
      const std::string place = path + "/" + std::to_string(index++);
      if (needs_distinct && !seen.insert(element.dump()).second) say(place, "stands there twice");
      object(element, rule.of, place);
    }
  }

  void number(const Json& json, std::int64_t low, const std::string& path) {
    if (!json.is_number_integer() || json.get<std::int64_t>() < low) {
      say(path, "is no whole number from " + std::to_string(low));
    }
  }

  void property(const Json& json, const Property& rule, const std::string& path) {
    switch (rule.form) {
      case Form::object:
        return object(json, rule.of, path);
      case Form::array:
      case Form::distinct:
      case Form::distinct_some:
      case Form::some:
        return array(json, rule, path);
      case Form::index:
        return number(json, -1, path);
      case Form::from_one:
        return number(json, 1, path);
      case Form::text:
      case Form::uri:
      case Form::uri_reference:
      case Form::choice:
        if (!json.is_string()) return say(path, "is no string");
        return text(json.get_ref<const std::string&>(), rule, path);
    }
  }

  void text(const std::string& value, const Property& rule, const std::string& path) {
    const auto is_value = [&](std::string_view choice) { return choice == value; };
    if (rule.form == Form::choice &&
        std::none_of(rule.choices.begin(), rule.choices.end(), is_value)) {
      say(path, "is `" + value + "`, which is no choice");
    }
    if (rule.form == Form::uri && !is_uri(value, true)) say(path, "is no URI: " + value);
    if (rule.form == Form::uri_reference && !is_uri(value, false)) {
      say(path, "is no URI reference: " + value);
    }
  }
};

// What the schema cannot say: `ruleIndex` names the rule of `ruleId` (3.27.6).
void check_rule_indices(const Json& log, std::vector<std::string>& problems) {
  for (const Json& run : log.at("runs")) {
    const Json& rules = run.at("tool").at("driver").at("rules");
    for (const Json& result : run.at("results")) {
      const auto index = result.value("ruleIndex", std::size_t{0});
      if (index >= rules.size() || rules[index].at("id") != result.at("ruleId")) {
        problems.push_back("a result's `ruleIndex` names another rule: " + result.dump());
      }
    }
  }
}

}  // namespace

std::vector<std::string> sarif_problems(const Json& log) {
  Checker checker;
  checker.object(log, "log", "");
  if (checker.problems.empty()) check_rule_indices(log, checker.problems);
  return std::move(checker.problems);
}

}  // namespace scenec::test
