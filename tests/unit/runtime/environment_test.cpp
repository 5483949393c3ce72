#include "runtime/environment.hpp"

#include <gtest/gtest.h>

#include <map>
#include <sstream>

namespace scenec::runtime {
namespace {

class ColorDecision : public testing::Test {
 protected:
  bool decide(ColorChoice choice, bool terminal,
              std::map<std::string, std::string, std::less<>> variables) {
    const Environment environment{
        .out = stream_,
        .err = stream_,
        .err_is_terminal = terminal,
        .variable = [&](std::string_view name) -> std::optional<std::string> {
          const auto found = variables.find(name);
          return found == variables.end() ? std::nullopt : std::optional(found->second);
        },
        .handle_signals = false,
    };
    return use_color(choice, environment);
  }

 private:
  std::ostringstream stream_;
};

TEST_F(ColorDecision, FollowsTheTerminal) {
  EXPECT_TRUE(decide(ColorChoice::automatic, true, {}));
  EXPECT_FALSE(decide(ColorChoice::automatic, false, {}));
  EXPECT_FALSE(decide(ColorChoice::automatic, true, {{"TERM", "dumb"}}));
}

TEST_F(ColorDecision, VariablesCountWhenNotEmpty) {
  EXPECT_FALSE(decide(ColorChoice::automatic, true, {{"NO_COLOR", "1"}}));
  EXPECT_TRUE(decide(ColorChoice::automatic, true, {{"NO_COLOR", ""}}));
  EXPECT_TRUE(decide(ColorChoice::automatic, false, {{"FORCE_COLOR", "1"}}));
  EXPECT_TRUE(decide(ColorChoice::automatic, false, {{"CLICOLOR_FORCE", "1"}, {"TERM", "dumb"}}));
  EXPECT_FALSE(decide(ColorChoice::automatic, false, {{"FORCE_COLOR", "1"}, {"NO_COLOR", "1"}}));
}

TEST_F(ColorDecision, TheOptionWins) {
  EXPECT_TRUE(decide(ColorChoice::always, false, {{"NO_COLOR", "1"}}));
  EXPECT_FALSE(decide(ColorChoice::never, true, {{"FORCE_COLOR", "1"}}));
}

}  // namespace
}  // namespace scenec::runtime
