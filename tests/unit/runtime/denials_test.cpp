#include "runtime/denials.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace scenec::runtime {
namespace {

using testing::HasSubstr;

TEST(Denials, TakeCodesAndNamesInAnyWriting) {
  for (const char* const word : {"L0301", "l0301", "default-material", "default_material"}) {
    Denials denials;
    EXPECT_EQ(denials.add(word), std::nullopt) << word;
    EXPECT_TRUE(denials.cover(DiagnosticKind::default_material)) << word;
    EXPECT_FALSE(denials.cover(DiagnosticKind::no_light)) << word;
  }
}

TEST(Denials, WarningsAreAllLintsAndNoErrors) {
  Denials denials;
  EXPECT_EQ(denials.add("warnings"), std::nullopt);
  for (const DiagnosticKindInfo& kind : all_diagnostic_kinds()) {
    EXPECT_EQ(denials.cover(kind.kind), kind.severity == Severity::warning) << kind.code;
  }
}

TEST(Denials, RefuseWhatIsNoLint) {
  Denials denials;
  EXPECT_THAT(denials.add("default-matrial").value(), HasSubstr("did you mean `default-material`"));
  EXPECT_THAT(denials.add("warning").value(), HasSubstr("did you mean `warnings`"));
  EXPECT_THAT(denials.add("file-unreadable").value(), HasSubstr("an error already"));
  EXPECT_THAT(denials.add("").value(), HasSubstr("explain --list"));
  EXPECT_FALSE(denials.cover(DiagnosticKind::default_material));
}

}  // namespace
}  // namespace scenec::runtime
