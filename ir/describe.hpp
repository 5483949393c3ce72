// The schema as data, for `scenec schema`, the manual, messages and completion: every kind of every
// family with its keys, types, defaults, ranges and documentation, derived from Schema<T>.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "ir/schema.hpp"

namespace scenec::ir {

struct KeyDescription {
  std::string_view name;
  std::string type;  // "length", "color or texture", "one of .auto .file", ...
  std::optional<std::string> default_text;  // as source text; none for required keys and optionals
  bool required = false;
  Range range;
  std::string_view doc;
  std::vector<std::string_view> legal_values;  // enumerations
};
struct KindDescription {
  std::string_view family;  // "shape", "material", "light", "camera", "render", "item"
  std::string_view name;
  std::string_view doc;
  std::vector<KeyDescription> keys;
  std::vector<KeyRule> rules;
};
[[nodiscard]] const std::vector<KindDescription>& all_kinds();
// Names of the kinds of one family, in declaration order.
[[nodiscard]] std::vector<std::string_view> kind_names(std::string_view family);

}  // namespace scenec::ir
