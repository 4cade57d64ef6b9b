#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "capstan/capstan.h"

// The library as other programs use it.

namespace capstan {
namespace {

using ::testing::HasSubstr;

const std::string kBracket = std::string(CAPSTAN_SOURCE_DIR) + "/examples/bracket.p21";

TEST(Facade, GivesNoProgramThatTheCheckCondemnsUnlessAsked) {
  PlanOptions options;
  options.machine = "small_router";
  options.margin = "careful";
  const PlanOutput held = plan_file(kBracket, options);
  ASSERT_TRUE(held.planned);
  EXPECT_FALSE(held.json.empty());
  EXPECT_FALSE(held.iso14649.empty());
  EXPECT_TRUE(held.linuxcnc.empty());
  EXPECT_TRUE(held.tool_table.empty());
  ASSERT_FALSE(held.condemned.empty());
  EXPECT_EQ(held.condemned[0].severity, "error");
  EXPECT_FALSE(held.condemned[0].text.empty());
  options.allow_findings = true;
  const PlanOutput all_the_same = plan_file(kBracket, options);
  EXPECT_THAT(all_the_same.linuxcnc, HasSubstr("condemned=\""));
  EXPECT_THAT(all_the_same.linuxcnc, HasSubstr("\nM0\n"));
  EXPECT_FALSE(all_the_same.tool_table.empty());
  EXPECT_EQ(all_the_same.condemned.size(), held.condemned.size());
}

TEST(Facade, GivesNoProgramOfAPlanThatSaysTwoThingsThoughAsked) {
  PlanOptions options;
  std::string text = plan_file(kBracket, options).iso14649;
  const auto at = text.find("'G54'", text.find("\n!CAPSTAN_SETUP"));
  ASSERT_NE(at, std::string::npos);
  text.replace(at, 5, "'G55'");
  options.allow_findings = true;
  const PlanOutput out = plan_bytes(text, "edited.p21", options);
  ASSERT_TRUE(out.planned);
  EXPECT_TRUE(out.linuxcnc.empty());
  EXPECT_TRUE(out.tool_table.empty());
  ASSERT_FALSE(out.condemned.empty());
  EXPECT_EQ(out.condemned[0].code, "PIP-CONTRADICTED");
}

TEST(Facade, AMaterialThatTheFileContradictsIsSettledByTheOneThatTheCallerNames) {
  PlanOutput first = plan_file(std::string(CAPSTAN_SOURCE_DIR) + "/examples/plate_bound.p21", {});
  ASSERT_TRUE(first.condemned.empty());
  // Somebody edits what the header lists of the material; the nouns still say another one.
  std::string& text = first.iso14649;
  const auto record = text.find("!CAPSTAN_MATERIAL");
  ASSERT_NE(record, std::string::npos);
  const auto value = text.find("1500.", record);  // kc1.1 of C45
  ASSERT_NE(value, std::string::npos);
  text.replace(value, 5, "1404.5");
  const PlanOutput refused = plan_bytes(text, "plate.p21", {});
  EXPECT_TRUE(refused.linuxcnc.empty());
  ASSERT_FALSE(refused.condemned.empty());
  EXPECT_EQ(refused.condemned[0].code, "PIP-CONTRADICTED");
  PlanOptions options;
  options.material = "C45";
  const PlanOutput named = plan_bytes(text, "plate.p21", options);
  EXPECT_TRUE(named.condemned.empty()) << named.condemned[0].text;
  EXPECT_FALSE(named.linuxcnc.empty());
}

TEST(Facade, RefusesAnUnknownMaterialWithTheNearestNames) {
  PlanOptions options;
  options.material = "steeel";
  const PlanOutput out = plan_file(kBracket, options);
  EXPECT_FALSE(out.planned);
  ASSERT_FALSE(out.diagnostics.empty());
  EXPECT_EQ(out.diagnostics.back().code, "NAME-UNKNOWN");
  EXPECT_THAT(out.diagnostics.back().text, HasSubstr("mild_steel"));
}

}  // namespace
}  // namespace capstan
