#include "ir/describe.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "ir/print.hpp"

namespace scenec::ir {
namespace {

const KindDescription& kind(std::string_view family, std::string_view name) {
  const auto& kinds = all_kinds();
  const auto found = std::find_if(kinds.begin(), kinds.end(), [&](const auto& k) {
    return k.family == family && k.name == name;
  });
  SCENEC_ASSERT(found != kinds.end());
  return *found;
}

TEST(Describe, ListsTheKindsOfEditionOne) {
  EXPECT_EQ(kind_names("shape"),
            (std::vector<std::string_view>{"sphere", "plane", "triangle", "quad", "disk", "box",
                                           "cylinder", "mesh", "revolve", "instance"}));
  EXPECT_EQ(kind_names("camera"),
            (std::vector<std::string_view>{"pinhole", "thin_lens", "orthographic", "panorama"}));
}

TEST(Describe, GivesTypeDefaultAndLegalValues) {
  const KindDescription& revolve = kind("shape", "revolve");
  EXPECT_EQ(revolve.keys[0].name, "profile");
  EXPECT_TRUE(revolve.keys[0].required);
  EXPECT_EQ(revolve.keys[2].type, "one of .certified .newton .tessellated");
  EXPECT_EQ(revolve.keys[2].default_text, ".certified");
  EXPECT_EQ(revolve.keys[2].legal_values.size(), 3u);
  EXPECT_EQ(kind("shape", "sphere").keys[1].default_text, "1");
  EXPECT_EQ(kind("material", "mirror").keys[0].default_text, "rgb(1, 1, 1)");
}

TEST(Describe, EveryKeyIsDocumentedAndUniqueInItsKind) {
  for (const KindDescription& described : all_kinds()) {
    std::set<std::string_view> names;
    for (const KeyDescription& key : described.keys) {
      EXPECT_FALSE(key.doc.empty()) << described.name << "." << key.name;
      EXPECT_TRUE(names.insert(key.name).second) << described.name << "." << key.name;
    }
    for (const KeyRule& rule : described.rules) {
      for (std::string_view name : rule.keys) {
        if (name.empty() || name.find('.') != std::string_view::npos) continue;
        EXPECT_TRUE(names.contains(name)) << "rule of " << described.name << " names " << name;
      }
    }
  }
}

TEST(Print, WritesNumbersShortAndExact) {
  EXPECT_EQ(value_text(1.0), "1");
  EXPECT_EQ(value_text(-2.5), "-2.5");
  EXPECT_EQ(value_text(0.1), "0.1");
  EXPECT_EQ(value_text(1e300), "1e+300");
  EXPECT_EQ(value_text(Angle{0.5}), "0.5rad");
  EXPECT_EQ(value_text(Curve{CurveKind::bspline, false, {{1, 2}, {3, 4}}}),
            "bspline([[1, 2], [3, 4]], clamped = false)");
}

}  // namespace
}  // namespace scenec::ir
