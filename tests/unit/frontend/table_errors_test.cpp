// Every mistake the tables of functions and keys allow, made once for every row: a wrong type, too
// many and missing arguments, names nobody knows, values outside their range, keys given twice.
// A new function or key is tested here without a word about it.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <string_view>
#include <vector>

#include "base/text.hpp"
#include "frontend/eval/builtins.hpp"
#include "ir/describe.hpp"
#include "tests/unit/frontend/compile_fixture.hpp"

namespace scenec::frontend::test {
namespace {

using testing::HasSubstr;

// ---- functions ----------------------------------------------------------------------------------

// A value the parameter takes: as far as its type goes.
std::string right_value(Accept accept) {
  switch (accept) {
    case Accept::plain:
    case Accept::number_input:
      return "0.5";
    case Accept::integer:
      return "3";
    case Accept::angle:
      return "10deg";
    case Accept::temperature:
      return "4000K";
    case Accept::boolean:
      return "true";
    case Accept::string:
      return "\"wood.png\"";
    case Accept::choice:
      return ".none";
    case Accept::list:
      return "[[0, 0], [1, 0], [1, 1], [0, 1]]";
    case Accept::vector:
    case Accept::vec2:
      return "[1, 2]";
    case Accept::vec3:
    case Accept::offset:
      return "[0, 1, 0]";
    case Accept::color:
    case Accept::color_input:
      return "white";
    case Accept::any:
      return "0.5";
  }
  return "0.5";
}

// Values that no parameter of that kind takes.
std::vector<std::string> wrong_values(Accept accept) {
  const std::string transform = "move([0, 0, 0])";
  switch (accept) {
    case Accept::any:
      return {transform};  // every function of that kind says itself what it takes
    case Accept::string:
      return {"1", "true", transform};
    case Accept::boolean:
      return {"1", "\"x\"", transform};
    default:
      return {"\"x\"", "true", transform};
  }
}

std::string call_of(const Builtin& function, std::size_t wrong, const std::string& value) {
  std::string text = std::string(function.name) + "(";
  for (std::size_t i = 0; i < function.parameters.size(); ++i) {
    if (i > 0) text += ", ";
    text += i == wrong ? value : right_value(function.parameters[i].accept);
  }
  return text + ")";
}

void for_each_function(const std::function<void(const Builtin&)>& work) {
  for (const std::string_view name : builtin_names()) {
    if (name != "select") work(*find_builtin(name));  // a form of its own, see evaluate_test.cpp
  }
}

TEST(EveryFunction, RefusesValuesOfWrongTypes) {
  for_each_function([](const Builtin& function) {
    for (std::size_t i = 0; i < function.parameters.size(); ++i) {
      if (function.name == "str" || function.name == "len") continue;
      for (const std::string& value : wrong_values(function.parameters[i].accept)) {
        const std::string call = call_of(function, i, value);
        EXPECT_THAT(evaluated(call).codes,
                    testing::AnyOf("E0210", "E0211", "E0212", "E0213", "E0220"))
            << call;
      }
    }
  });
}

TEST(EveryFunction, TakesAnUnknownValueOfTheRightTypeWithoutAWord) {
  // In the body of a function that is never called only the types of parameters are known.
  for_each_function([](const Builtin& function) {
    for (std::size_t i = 0; i < function.parameters.size(); ++i) {
      if (function.name == "image") continue;  // its choices are checked by name
      const std::string call = call_of(function, i, "x");
      for (const char* const type : {"num", "int", "angle", "length", "string", "bool", "color",
                                     "vec2", "vec3", "point", "transform", "texture", "curve"}) {
        const std::string text = "fn f(x: " + std::string(type) + ") = " + call + ";";
        Compiler compiler;
        compiler.options.library = true;
        compiler.files.put("wood.png", "bytes");
        const Compiled result = compiler("sdl 1;\n" + text);
        // At most what the type says: no domain, no range, no file.
        EXPECT_THAT(result.codes, testing::MatchesRegex("((E0210|E0211|E0212|E0213|E0220) ?)*"))
            << text;
      }
    }
  });
}

TEST(EveryFunction, NamesTheArgumentThatIsMissing) {
  for_each_function([](const Builtin& function) {
    const std::string call = std::string(function.name) + "()";
    const Evaluated result = evaluated(call);
    for (const Parameter& parameter : function.parameters) {
      if (!parameter.required) continue;
      EXPECT_EQ(result.codes, "E0208") << call;
      EXPECT_THAT(result.messages, HasSubstr("needs `" + std::string(parameter.name) + "`"));
      return;
    }
    EXPECT_EQ(result.codes, "") << call;
  });
}

TEST(EveryFunction, RefusesOneArgumentTooMany) {
  for_each_function([](const Builtin& function) {
    if (function.variadic) return;
    std::string call = call_of(function, function.parameters.size(), "");
    call.insert(call.size() - 1, ", 1");
    EXPECT_EQ(evaluated(call).codes, "E0209") << call;
  });
}

TEST(EveryFunction, RefusesAnUnknownAndARepeatedName) {
  for_each_function([](const Builtin& function) {
    const std::string unknown = std::string(function.name) + "(nobody = 1)";
    EXPECT_EQ(evaluated(unknown).codes, "E0207") << unknown;
    if (function.variadic) return;
    const std::string name(function.parameters[0].name);
    const std::string twice = std::string(function.name) + "(" + name + " = 1, " + name + " = 1)";
    EXPECT_EQ(evaluated(twice).codes, "E0207") << twice;
  });
}

TEST(EveryFunction, PassesPoisonOnInSilence) {
  for_each_function([](const Builtin& function) {
    for (std::size_t i = 0; i < function.parameters.size(); ++i) {
      const std::string call = call_of(function, i, "nobody");
      EXPECT_EQ(evaluated(call).codes, "E0201") << call;
    }
  });
}

// ---- keys ---------------------------------------------------------------------------------------

// An item of that kind with these fields, in a scene that has everything else.
Compiled item_with(const ir::KindDescription& kind, const std::string& fields) {
  const std::string name(kind.name);
  std::string item;
  if (kind.family == "light") {
    item = "light: " + name;
  } else if (kind.family == "camera") {
    item = "camera other: " + name;
  } else if (kind.family == "material") {
    item = "material tested: " + name;
  } else if (kind.family == "material_common") {
    item = "material tested: diffuse";
  } else if (kind.family == "item") {
    item = "group";
  } else if (kind.family == "render") {
    return compiled(scene_with(name == "render" ? "render {" + fields + "}"
                                                : "render { " + name + " {" + fields + "} }"));
  } else {
    item = name;
  }
  return compiled(scene_with(item + " {" + fields + "}"));
}

template <class Work>
void for_each_key(const Work& work) {
  for (const ir::KindDescription& kind : ir::all_kinds()) {
    for (const ir::KeyDescription& key : kind.keys) work(kind, key);
  }
}

// Whether `message` is said once of that code about that key.
bool says(const Compiled& result, std::string_view code) {
  return result.codes.find(code) != std::string::npos;
}

TEST(EveryKey, RefusesAValueOfAWrongType) {
  for_each_key([](const ir::KindDescription& kind, const ir::KeyDescription& key) {
    if (key.type == "block") return;
    const bool takes_text = key.type == "file name" || key.type == "string";
    const std::string wrong = takes_text ? "12" : "\"x\"";
    const std::string field = std::string(key.name) + " = " + wrong + ";";
    const Compiled result = item_with(kind, field);
    EXPECT_TRUE(says(result, "E0210")) << kind.family << " " << kind.name << " " << field << "\n"
                                       << result.rendered;
    const std::string named =
        key.type == "camera" ? "the camera" : "`" + std::string(key.name) + "`";
    EXPECT_THAT(result.messages, HasSubstr(named)) << field;
  });
}

TEST(EveryKey, RefusesToBeGivenTwice) {
  for_each_key([](const ir::KindDescription& kind, const ir::KeyDescription& key) {
    if (key.type == "block") return;
    const std::string field = std::string(key.name) + " = nobody;";
    const Compiled result = item_with(kind, field + field);
    EXPECT_TRUE(says(result, "E0224")) << kind.name << " " << field << result.rendered;
  });
}

TEST(EveryKey, IsSuggestedForAWordLikeIt) {
  for_each_key([](const ir::KindDescription& kind, const ir::KeyDescription& key) {
    if (key.type == "block" || key.name.size() < 4) return;
    const std::string misspelt = std::string(key.name) + key.name.back();
    const Compiled result = item_with(kind, misspelt + " = 1;");
    EXPECT_TRUE(says(result, "E0223")) << kind.name << " " << misspelt;
    EXPECT_THAT(result.rendered, HasSubstr("did you mean `" + std::string(key.name) + "`?"))
        << kind.name << " " << misspelt;
  });
}

TEST(EveryKind, NamesEveryRequiredKeyThatIsMissing) {
  for (const ir::KindDescription& kind : ir::all_kinds()) {
    std::vector<std::string> required;
    for (const ir::KeyDescription& key : kind.keys) {
      if (key.required) required.push_back("`" + std::string(key.name) + "`");
    }
    if (required.empty()) continue;
    const Compiled result = item_with(kind, "");
    EXPECT_TRUE(says(result, "E0225")) << kind.name;
    for (const std::string& name : required) EXPECT_THAT(result.messages, HasSubstr(name));
  }
}

// A number beside the range on each side, in SI, as text with the unit the key wants.
std::vector<std::string> numbers_outside(const ir::KeyDescription& key) {
  const std::string unit = key.type == "length"  ? "m"
                           : key.type == "angle" ? "rad"
                           : key.type == "time"  ? "s"
                           : key.type == "power" ? "W"
                                                 : "";
  const bool is_number =
      !unit.empty() || key.type == "number" || key.type == "int" || key.type == "number or texture";
  if (!is_number) return {};
  std::vector<std::string> texts;
  const double step = key.type == "int" ? 1 : 0.25;
  if (std::isfinite(key.range.low)) {
    texts.push_back(short_number_text(key.range.low - step) + unit);
    if (key.range.low_open && key.type != "int")
      texts.push_back(short_number_text(key.range.low) + unit);
  }
  if (std::isfinite(key.range.high)) {
    texts.push_back(short_number_text(key.range.high + step) + unit);
  }
  return texts;
}

TEST(EveryKey, HoldsItsRange) {
  int tested = 0;
  for_each_key([&](const ir::KindDescription& kind, const ir::KeyDescription& key) {
    for (const std::string& value : numbers_outside(key)) {
      const std::string field = std::string(key.name) + " = " + value + ";";
      const Compiled result = item_with(kind, field);
      EXPECT_TRUE(says(result, "E0230")) << kind.name << " " << field << "\n" << result.rendered;
      EXPECT_THAT(result.messages, HasSubstr("`" + std::string(key.name) + "` is ")) << field;
      ++tested;
    }
  });
  EXPECT_GT(tested, 40);
}

TEST(EveryKey, NamesItsChoices) {
  for_each_key([](const ir::KindDescription& kind, const ir::KeyDescription& key) {
    if (key.legal_values.empty()) return;
    const bool is_list = key.type.starts_with('[');
    const std::string field = std::string(key.name) + (is_list ? " = [.nobody];" : " = .nobody;");
    const Compiled result = item_with(kind, field);
    EXPECT_TRUE(says(result, "E0229")) << kind.name << " " << field << "\n" << result.rendered;
    for (const std::string_view value : key.legal_values) {
      EXPECT_THAT(result.rendered, HasSubstr("`." + std::string(value) + "`")) << field;
    }
  });
}

// `stop.samples` is a key of the block `stop`.
std::string field_of(std::string_view key) {
  const std::size_t dot = key.find('.');
  if (dot == std::string_view::npos) return std::string(key) + " = nobody;";
  return std::string(key.substr(0, dot)) + " { " + field_of(key.substr(dot + 1)) + " }";
}

TEST(EveryKind, HoldsItsRules) {
  for (const ir::KindDescription& kind : ir::all_kinds()) {
    for (const ir::KeyRule& rule : kind.rules) {
      const std::string first = field_of(rule.keys[0]);
      const std::string second = field_of(rule.keys[1]);
      const bool together = rule.kind == ir::KeyRule::Kind::together;
      const Compiled result = item_with(kind, together ? first : first + second);
      EXPECT_TRUE(says(result, together ? "E0227" : "E0226"))
          << kind.name << " " << rule.keys[0] << "\n"
          << result.rendered;
      if (rule.kind == ir::KeyRule::Kind::exactly_one) {
        EXPECT_TRUE(says(item_with(kind, ""), "E0225")) << kind.name << " " << rule.keys[0];
      }
    }
  }
}

}  // namespace
}  // namespace scenec::frontend::test
