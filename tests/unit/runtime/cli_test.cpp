#include "runtime/cli.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cctype>

#include "runtime/help.hpp"

namespace scenec::runtime {
namespace {

using testing::HasSubstr;
using Words = std::vector<std::string>;

Options options_from(const Words& words) {
  const CommandLine command = parse_command_line(words);
  if (const auto* problem = std::get_if<UsageError>(&command)) {
    ADD_FAILURE() << problem->message;
    return {};
  }
  return std::get<Options>(command);
}

std::string usage_message(const Words& words) {
  const CommandLine command = parse_command_line(words);
  const auto* const problem = std::get_if<UsageError>(&command);
  return problem == nullptr ? "(accepted)" : problem->message;
}

TEST(Cli, RenderIsTheDefaultVerb) {
  const Options options = options_from({"scene.sdl", "-o", "out.png"});
  EXPECT_EQ(options.verb, Verb::render);
  EXPECT_EQ(options.operands, Words{"scene.sdl"});
  EXPECT_EQ(options.output, "out.png");
}

TEST(Cli, OrderDoesNotMatter) {
  const Options options =
      options_from({"--size", "64x32", "--samples=4", "scene.sdl", "--seed", "7"});
  EXPECT_EQ(options.size, (ir::ImageSize{64, 32}));
  EXPECT_EQ(options.samples, 4);
  EXPECT_EQ(options.seed, 7);
  EXPECT_EQ(options.operands, Words{"scene.sdl"});
}

TEST(Cli, SettingsMayBeRepeated) {
  const Options options = options_from({"a.sdl", "-D", "n=1", "-Dm=x y", "-D", "k=-3"});
  ASSERT_EQ(options.settings.size(), 3u);
  EXPECT_EQ(options.settings[1].name, "m");
  EXPECT_EQ(options.settings[1].value, "x y");
  EXPECT_EQ(options.settings[2].value, "-3");
  EXPECT_THAT(usage_message({"a.sdl", "-D", "n=1", "-D", "n=2"}), HasSubstr("`n` has two"));
}

TEST(Cli, StatsTakesItsValueBehindAnEqualsSignOnly) {
  EXPECT_EQ(options_from({"--stats", "a.sdl"}).stats, StatsForm::table);
  EXPECT_EQ(options_from({"--stats", "a.sdl"}).operands, Words{"a.sdl"});
  const Options options = options_from({"--stats=json:s.json", "a.sdl"});
  EXPECT_EQ(options.stats, StatsForm::json);
  EXPECT_EQ(options.stats_file, "s.json");
  EXPECT_EQ(usage_message({"--stats=xml", "a.sdl"}),
            "`--stats` is `xml`; needs `table` or `json:FILE`");
}

TEST(Cli, BadValuesSayWhatIsNeeded) {
  EXPECT_EQ(
      usage_message({"a.sdl", "--seed", "-1"}),
      "`--seed` is `-1`; needs a whole number from 0 to 9223372036854775807, written in plain "
      "digits");
  EXPECT_THAT(usage_message({"a.sdl", "--samples", "1e3"}), HasSubstr("whole number from 1 to"));
  EXPECT_THAT(usage_message({"a.sdl", "--size", "0x0"}), HasSubstr("WIDTHxHEIGHT"));
  EXPECT_THAT(usage_message({"a.sdl", "--time", "30"}), HasSubstr("with its unit"));
  EXPECT_THAT(usage_message({"a.sdl", "--method", "pathh"}), HasSubstr("did you mean `path`?"));
  EXPECT_EQ(usage_message({"a.sdl", "--size", "1x1", "--size", "2x2"}), "`--size` is given twice");
  EXPECT_EQ(usage_message({"a.sdl", "--half=3"}), "`--half` takes no value");
}

TEST(Cli, PrecisionAndTargetHaveNames) {
  EXPECT_EQ(options_from({"a.sdl"}).precision, backend::Precision::mixed);
  EXPECT_EQ(options_from({"a.sdl", "--precision", "double"}).precision, backend::Precision::full);
  EXPECT_THAT(picture_command(options_from({"a.sdl", "--precision", "double"})),
              HasSubstr("--precision double"));
  EXPECT_THAT(usage_message({"a.sdl", "--precision", "duoble"}), HasSubstr("mean `double`?"));
  EXPECT_EQ(options_from({"a.sdl", "--target", "auto"}).target, backend::best_target());
  EXPECT_EQ(options_from({"a.sdl", "--target=baseline"}).target, backend::Target::baseline);
  EXPECT_THAT(usage_message({"a.sdl", "--target", "avx3"}),
              HasSubstr("an instruction set of this machine: one of `auto`, `baseline`"));
}

TEST(Cli, MistypedWordsGetTheNearestName) {
  EXPECT_EQ(usage_message({"chekc", "a.sdl"}), "unknown verb `chekc`; did you mean `check`?");
  EXPECT_EQ(usage_message({"a.sdl", "--sise", "4x4"}),
            "unknown option `--sise`; did you mean `--size`?");
  EXPECT_EQ(usage_message({"check", "a.sdl", "--size", "4x4"}),
            "`--size` is not an option of `check`");
  EXPECT_THAT(usage_message({"zzzzzz"}), HasSubstr("neither a file nor a verb"));
}

TEST(Cli, MissingAndSurplusOperandsAreErrors) {
  EXPECT_EQ(usage_message({}), "needs the name of a scene file");
  EXPECT_EQ(usage_message({"check"}), "`check` needs the name of a scene file");
  EXPECT_EQ(usage_message({"a.sdl", "b.sdl"}),
            "`render` takes one scene at a time; `b.sdl` is a second one");
  EXPECT_EQ(usage_message({"check", "-"}), "a scene is read from a file, not from standard input");
  EXPECT_EQ(usage_message({"a.sdl", "-o"}), "`-o` needs a value");
  EXPECT_EQ(usage_message({"a.sdl", "-o", "--size", "4x4"}),
            "`--output` needs a value before `--size`");
}

TEST(Cli, WordsBehindTwoDashesAreOperands) {
  EXPECT_EQ(options_from({"check", "--", "--odd.sdl"}).operands, Words{"--odd.sdl"});
}

TEST(Cli, TenThousandWordsAreAnsweredOnce) {
  Words words(10000, "a.sdl");
  EXPECT_THAT(usage_message(words), HasSubstr("is a second one"));
}

TEST(Cli, HelpNamesEveryOptionOfEveryVerb) {
  for (const VerbInfo& verb : all_verbs()) {
    const std::string help = help_of(verb.verb);
    for (const OptionRow& row : all_options()) {
      const std::string name(row.names.substr(0, row.names.find(',')));
      // A name may be the beginning of another one.
      const std::size_t place = help.find("  " + name);
      const bool is_named =
          place != std::string::npos && (help[place + 2 + name.size()] != '-' &&
                                         std::isalpha(help[place + 2 + name.size()]) == 0);
      EXPECT_EQ(is_named, row.verbs.contains(verb.verb)) << verb.name << " " << name;
    }
  }
  EXPECT_THAT(std::get<Answer>(parse_command_line({"--help"})).text, HasSubstr("Exit codes"));
  EXPECT_THAT(std::get<Answer>(parse_command_line({"check", "--help"})).text,
              HasSubstr("scenec check"));
}

TEST(Cli, ThePictureCommandIsInOneFormAndHoldsNoPath) {
  const Options a = options_from({"dir/a.sdl", "-D", "b=2", "--seed", "01", "-D", "a=1", "--size",
                                  "8x8", "-o", "x.exr", "--threads", "2", "--time", "2min"});
  const Options b = options_from({"--size=8x8", "other.sdl", "--time", "120s", "-D", "a=1", "-D",
                                  "b=2", "--seed", "1", "--half"});
  EXPECT_EQ(picture_command(a), "scenec render --size 8x8 --time 120s --seed 1 -D a=1 -D b=2");
  EXPECT_EQ(picture_command(b), picture_command(a) + " --half");
}

TEST(Cli, MakeOptionsAreReadAsCompilersReadThem) {
  const Options options = options_from({"a.sdl", "-o", "a.png", "-MD", "-MF", "x.d", "-MTt", "-MT",
                                        "u v", "-MP", "-D", "MD=1", "-DMP=2"});
  EXPECT_TRUE(options.dependencies);
  EXPECT_TRUE(options.phony_dependencies);
  EXPECT_EQ(options.dependency_file, "x.d");
  EXPECT_EQ(options.dependency_targets, (Words{"t", "u v"}));
  ASSERT_EQ(options.settings.size(), 2u);
  EXPECT_EQ(options.settings[0].name, "MD");
  EXPECT_EQ(options.settings[1].name, "MP");
  EXPECT_EQ(options_from({"check", "--", "-MD"}).operands, Words{"-MD"});
}

TEST(Cli, MakeOptionsAreNamedAsTyped) {
  EXPECT_EQ(usage_message({"a.sdl", "-MF", "x.d"}), "`-MF` needs `-MD`");
  EXPECT_EQ(usage_message({"a.sdl", "-MT", "-MD"}), "`-MT` needs a value before `-MD`");
  EXPECT_EQ(usage_message({"a.sdl", "-MD", "-MF"}), "`-MF` needs a value");
  EXPECT_EQ(usage_message({"fmt", "a.sdl", "-MD"}), "`-MD` is not an option of `fmt`");
  EXPECT_EQ(usage_message({"check", "a.sdl", "-MD"}),
            "`-MD` needs `-MF FILE` when no output is named");
  EXPECT_EQ(usage_message({"check", "a.sdl", "-MD", "-MF", "d"}),
            "`-MD` needs `-MT TARGET` when no output is named");
  EXPECT_THAT(usage_message({"a.sdl", "-MX"}), HasSubstr("unknown option `-MX`"));
}

TEST(Cli, DenyTakesLintsOnly) {
  EXPECT_TRUE(options_from({"a.sdl", "--deny", "L0301", "--deny=no-light"})
                  .denials.cover(DiagnosticKind::no_light));
  EXPECT_EQ(usage_message({"a.sdl", "--deny", "no-ligth"}),
            "`--deny` is `no-ligth`; needs `warnings` or the code or name of a lint; did you mean "
            "`no-light`?");
}

}  // namespace
}  // namespace scenec::runtime
