#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <iterator>
#include <set>
#include <stop_token>
#include <string>
#include <string_view>
#include <utility>

#include "capstan/capstan.h"
#include "planner/door/service/options.h"
#include "tests/support/corpus.h"
#include "tests/support/scratch.h"

// The library as other programs use it.

namespace capstan {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;
using ::testing::StartsWith;

const std::string kBracket = capstan::testing::source_dir() + "/examples/bracket.p21";

TEST(Facade, GivesNoProgramThatTheCheckCondemnsUnlessAsked) {
  // Operations, tools and depths of a strong machine are asked of a weak one.
  const std::string strong = plan_file(kBracket, {}).json;
  PlanOptions options;
  options.machine = "small_router";
  options.reopen = "technology";
  const PlanOutput held = plan_bytes(strong, "strong.json", options);
  ASSERT_TRUE(held.planned);
  EXPECT_FALSE(held.json.empty());
  EXPECT_FALSE(held.iso14649.empty());
  EXPECT_TRUE(held.linuxcnc.empty());
  EXPECT_TRUE(held.tool_table.empty());
  ASSERT_FALSE(held.condemned.empty());
  EXPECT_EQ(held.condemned[0].severity, "error");
  EXPECT_FALSE(held.condemned[0].text.empty());
  options.allow_findings = true;
  const PlanOutput all_the_same = plan_bytes(strong, "strong.json", options);
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
  PlanOutput first = plan_file(capstan::testing::source_dir() + "/examples/plate_bound.p21", {});
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

TEST(Facade, AJsonPlanMayBeginWithAByteOrderMark) {
  const std::string json = plan_file(capstan::testing::source_dir() + "/examples/plate_bound.p21", {}).json;
  ASSERT_FALSE(json.empty());
  const PlanOutput marked = plan_bytes("\xEF\xBB\xBF" + json, "marked.json", {});
  EXPECT_TRUE(marked.planned) << (marked.diagnostics.empty() ? "" : marked.diagnostics.back().text);
  EXPECT_TRUE(marked.linuxcnc == plan_bytes(json, "marked.json", {}).linuxcnc);
}

TEST(Facade, HasAFieldForEachOptionOfTheCommand) {
  std::set<std::string> fields;
  for (const std::string& name : option_names()) fields.insert(name);
  for (const service::Option& o : service::options())
    EXPECT_EQ(fields.erase(std::string(o.name)), 1U) << o.name;
  EXPECT_TRUE(fields.empty()) << *fields.begin();
}

TEST(Facade, OptionsReachThePlan) {
  PlanOptions options;
  options.workholding = "auto";
  options.general_tolerance = "ISO 2768-m";
  options.batch = 7;
  options.stock_allowance_mm = 3.0;
  options.feeds = "constant";
  const PlanOutput out = plan_file(kBracket, options);
  ASSERT_TRUE(out.planned) << out.diagnostics.back().text;
  for (const char* told : {"ISO 2768-m", "block:+3", "constant"})
    EXPECT_TRUE(out.json.find(told) != std::string::npos) << told;
  options.workholding = "no such fixture";
  const PlanOutput refused = plan_file(kBracket, options);
  EXPECT_FALSE(refused.planned);
  options = {};
  options.reopen = "everything";
  const PlanOutput wrong = plan_file(kBracket, options);
  ASSERT_FALSE(wrong.diagnostics.empty());
  EXPECT_EQ(wrong.diagnostics.back().code, "OPTION-VALUE");
}

/// The file of a machine like `generic_vmc` with a table of 2,000 x 1,200 mm.
std::string machine_with_a_large_table() {
  std::ifstream in(capstan::testing::source_dir() + "/tooling/data/machines/generic_vmc.yaml");
  std::string text{std::istreambuf_iterator<char>(in), {}};
  for (const auto& [field, now] : {std::pair{"table_length_mm: 900", "table_length_mm: 2000"},
                                   std::pair{"table_width_mm: 410", "table_width_mm: 1200"}}) {
    const auto at = text.find(field);
    EXPECT_NE(at, std::string::npos) << field;
    if (at != std::string::npos) text.replace(at, std::string_view(field).size(), now);
  }
  std::string file = capstan::testing::scratch_file("large_table.yaml");
  std::ofstream(file) << text;
  return file;
}

// Cells of the height map are 1.7 mm wide on a piece of 1,600 x 1,100 mm. Sections were sampled by them, and
// cuts of a 3 mm mill that the map told wrongly by half went by the map: 45 min instead of 18, by a 1.5 mm
// mill.
TEST(Facade, APocketIsCutTheSameInALargeRawPiece) {
  PlanOptions options;
  options.material = "6061";
  options.limit = {"tool.diameter<=3"};
  options.machine = machine_with_a_large_table();
  const std::string part = capstan::testing::source_dir() + "/examples/reference_pocket.p21";
  options.stock = "box:-5,-5,-30,105,85,0";
  const PlanOutput small = plan_file(part, options);
  options.stock = "box:-700,-500,-30,900,600,0";
  const PlanOutput large = plan_file(part, options);
  ASSERT_TRUE(small.planned && large.planned);
  EXPECT_TRUE(small.findings.empty() && large.findings.empty());
  EXPECT_EQ(small.tool_table, large.tool_table);
  EXPECT_NEAR(large.time_s / small.time_s, 1.0, 0.01);
}

// Nothing stands higher than what a rough leaves, 0.5 mm: the rough is left out, and not the surface.
TEST(Facade, AReliefThatIsLowerThanARoughLeavesIsFinishedAlone) {
  constexpr int kCells = 30;
  const auto at = [](int i, int j) {
    const double x = 1.2 * i, y = 1.0 * j;
    return std::to_string(x) + " " + std::to_string(y) + " " +
           std::to_string(0.15 * (std::sin(0.2 * x) * std::cos(0.15 * y) - 1.0));
  };
  std::string stl = "solid relief\n";
  const auto facet = [&](const std::string& a, const std::string& b, const std::string& c) {
    stl += "facet normal 0 0 0\nouter loop\nvertex " + a + "\nvertex " + b + "\nvertex " + c +
           "\nendloop\nendfacet\n";
  };
  for (int j = 0; j < kCells; ++j) {
    for (int i = 0; i < kCells; ++i) {
      facet(at(i, j), at(i + 1, j), at(i + 1, j + 1));
      facet(at(i, j), at(i + 1, j + 1), at(i, j + 1));
    }
  }
  PlanOptions options;
  options.material = "6061";
  options.stock = "box:0,0,-10,36,30,0";
  const PlanOutput out = plan_bytes(stl + "endsolid relief\n", "relief.stl", options);
  ASSERT_TRUE(out.planned) << out.diagnostics.back().text;
  EXPECT_EQ(out.unplanned, 0U);
  EXPECT_TRUE(out.findings.empty()) << out.findings.front().text;
  EXPECT_FALSE(out.linuxcnc.empty());
  const bool told = std::any_of(out.diagnostics.begin(), out.diagnostics.end(),
                                [](const PlanMessage& m) { return m.code == "PIP-GONE"; });
  EXPECT_TRUE(told);
}

TEST(Facade, ARawPieceThatStockStatesIsNotSaidToBeMissing) {
  const std::string surface = capstan::testing::source_dir() + "/examples/surface.stl";
  const auto says_missing = [&](const PlanOptions& options) {
    const PlanOutput out = plan_file(surface, options);
    return std::any_of(out.diagnostics.begin(), out.diagnostics.end(),
                       [](const PlanMessage& m) { return m.code == "PIP-STOCK"; });
  };
  PlanOptions options;
  options.material = "6061";
  options.bind = "none";
  EXPECT_TRUE(says_missing(options));
  options.stock_allowance_mm = 2.0;
  EXPECT_FALSE(says_missing(options));
}

TEST(Facade, APersonsEditsHoldInThePlanAndComeBackAsAFile) {
  PlanOptions options;
  options.set = {"SLOT area_rough/feed=1111"};
  options.limit = {"feed<=1500"};
  const PlanOutput out = plan_file(kBracket, options);
  ASSERT_TRUE(out.planned);
  EXPECT_FALSE(out.linuxcnc.empty());
  EXPECT_THAT(out.linuxcnc, HasSubstr("F1111"));
  EXPECT_THAT(out.forms.at("edits"),
              HasSubstr("- set: \"SLOT area_rough/feed=1111\"\n  - limit: \"feed<=1500\""));
  options.set = {"SLOT area_rough/feed=9000"};
  options.limit = {};
  const PlanOutput broken = plan_file(kBracket, options);
  EXPECT_TRUE(broken.linuxcnc.empty());
  ASSERT_FALSE(broken.condemned.empty());
  std::string condemned;  // what the whole plan needs comes first; the step's own finding names the edit
  for (const auto& f : broken.condemned) condemned += f.text + "\n";
  EXPECT_THAT(condemned, HasSubstr("set SLOT area_rough/feed=9000"));
  options.set = {"SLIT/feed=9000"};
  EXPECT_FALSE(plan_file(kBracket, options).planned);
}

TEST(Facade, PicturesDrawTheStepsThatAreAskedForAndCostNoDeadline) {
  PlanOptions options;
  options.draw = {"2", "SLOT*"};
  const PlanOutput out = plan_file(kBracket, options);
  for (const char* drawn : {"2", "6", "7"})
    EXPECT_THAT(out.forms.at("svg"), HasSubstr("data-step=\"" + std::string(drawn) + "\"")) << drawn;
  EXPECT_THAT(out.forms.at("svg"), Not(HasSubstr("data-step=\"3\"")));
  options.draw = {"no such step"};
  const PlanOutput none = plan_file(kBracket, options);
  EXPECT_TRUE(none.planned);
  EXPECT_FALSE(none.forms.contains("svg"));
  EXPECT_TRUE(std::any_of(none.diagnostics.begin(), none.diagnostics.end(),
                          [](const PlanMessage& m) { return m.code == "PIC-STEP"; }));
  options.draw = {};
  options.deadline = "60s";
  EXPECT_FALSE(bind_bytes(out.json, "bracket.json", options).forms.contains("png"));
}

TEST(Facade, FormsStandUnderTheNamesOfTheirFormats) {
  const PlanOutput out = plan_file(capstan::testing::source_dir() + "/examples/plate_bound.p21", {});
  ASSERT_TRUE(out.planned);
  EXPECT_TRUE(out.forms.at("json") == out.json);
  EXPECT_TRUE(out.forms.at("linuxcnc") == out.linuxcnc);
  EXPECT_TRUE(out.forms.at("linuxcnc_tools") == out.tool_table);
  EXPECT_THAT(out.forms.at("png"), StartsWith("\x89PNG"));
  const CheckOutput checked = check_bytes({{"plate.json", out.json}, {"plate.ngc", out.linuxcnc}}, {});
  EXPECT_TRUE(checked.checked);
  for (const auto& f : checked.findings) EXPECT_NE(f.severity, "error") << f.text;
  const CheckOutput nothing = check_bytes({}, {});
  EXPECT_FALSE(nothing.checked);
  EXPECT_EQ(nothing.diagnostics.back().code, "APP-NOTHING");
}

TEST(Facade, ExplainsAPlanAStepAndAValue) {
  const std::string json = plan_file(capstan::testing::source_dir() + "/examples/plate_bound.p21", {}).json;
  const ExplainOutput whole = explain_bytes(json, "plate.json");
  ASSERT_TRUE(whole.explained);
  const ExplainOutput step = explain_bytes(json, "plate.json", "1");
  ASSERT_TRUE(step.explained);
  EXPECT_TRUE(step.text != whole.text);
  EXPECT_TRUE(explain_bytes(json, "plate.json", "1", "feed").explained);
  const ExplainOutput none = explain_bytes(json, "plate.json", "no such step");
  EXPECT_FALSE(none.explained);
  EXPECT_EQ(none.diagnostics.back().code, "EXP-STEP");
}

TEST(Facade, BindsWithTheToolsThatAreLoaded) {
  PlanOptions options;
  options.tools = capstan::testing::source_dir() + "/tests/door/late/magazine.tbl";
  options.deadline = "1ms";
  const PlanOutput late = bind_file(capstan::testing::source_dir() + "/examples/plate_bound.p21", options);
  ASSERT_TRUE(late.planned) << late.diagnostics.back().text;
  EXPECT_TRUE(late.late);
  EXPECT_FALSE(late.linuxcnc.empty());
}

TEST(Facade, TellsProgressAndAStoppedPlanHasNoProgram) {
  PlanOptions options;
  std::stop_source source;
  int told = 0;
  options.stop = source.get_token();
  options.progress = [&](std::string_view stage, double fraction) {
    EXPECT_FALSE(stage.empty());
    EXPECT_GE(fraction, 0.0);
    EXPECT_LE(fraction, 1.0);
    ++told;
    source.request_stop();
  };
  const PlanOutput out = plan_file(kBracket, options);
  EXPECT_GT(told, 0);
  EXPECT_TRUE(out.linuxcnc.empty());
}

}  // namespace
}  // namespace capstan
