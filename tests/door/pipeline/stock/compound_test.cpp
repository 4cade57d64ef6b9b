#include <gtest/gtest.h>

#include <cmath>
#include <set>
#include <string>

#include "planner/ground/base/number.h"
#include "planner/model/nouns/all.h"
#include "tests/support/corpus.h"
#include "tests/support/shop.h"

// Where compounds and patterns are cut; every coordinate stands in the part's comments.

namespace capstan::pipeline {
namespace {

std::string part() {
  const std::string folder = capstan::testing::source_dir();
  return testing::slurp(folder + "/tests/door/pipeline/parts/compounds.p21");
}

/// Replaces the first of what must be there.
void put(std::string& text, const std::string& from, const std::string& to) {
  const auto at = text.find(from);
  ASSERT_NE(at, std::string::npos) << from;
  text.replace(at, from.size(), to);
}

/// A drill of 8 mm as #103, with the angle of its dimension, with technology (#106) and functions (#107).
std::string drill_8(int angle_deg) {
  return R"(#103=MILLING_CUTTING_TOOL('DRILL 8',#104,(#105),60.,$,$);
#104=TWIST_DRILL(#108,2,.RIGHT.,.F.,$);
#105=CUTTING_COMPONENT(50.,$,$,$,$);
#106=MILLING_TECHNOLOGY(0.003,.TCP.,$,-20.,$,.F.,.F.,.F.,$);
#107=MILLING_MACHINE_FUNCTIONS(.F.,$,$,.F.,$,(),.T.,$,$,());
#108=MILLING_TOOL_DIMENSION(8.,)" +
         std::to_string(angle_deg) + ".,$,50.,$,$,$);\n";
}

struct Planned {
  model::Plan plan;
  std::vector<Diagnostic> said;
};

Planned planned(const std::string& text, Reopen reopen = Reopen::kNothing) {
  Job job;
  auto in = load_shop({}, job);
  EXPECT_TRUE(in);
  auto plan = read_plan(text, "part.p21", job);
  EXPECT_TRUE(plan) << (plan ? "" : to_text(plan.error()));
  if (!in || !plan) return {};
  Policy policy;
  policy.reopen = reopen;
  auto out = bind(*std::move(plan), *in, policy, job);
  EXPECT_TRUE(out) << (out ? "" : to_text(out.error()));
  return {out ? *std::move(out) : model::Plan{}, job.take_diagnostics()};
}

/// "20,30 40,30": where a feature's steps go below a height, by rising x, then y. Holes are drilled along z.
std::string cut_at(const model::Plan& plan, const std::string& feature, double below) {
  std::set<std::pair<long, long>> places;
  for (const auto& s : plan.steps) {
    if (!model::step_id(plan, s).starts_with(feature) || !s.path) continue;
    for (std::size_t i = 0; i < s.path->size(); ++i) {
      const auto p = s.path->point(i);
      if (p.z < below) places.emplace(std::lround(p.x * 10), std::lround(p.y * 10));
    }
  }
  std::string out;
  for (const auto& [x, y] : places) {
    if (!out.empty()) out.push_back(' ');
    out.append(trimmed(0.1 * static_cast<double>(x), 1))
        .append(",")
        .append(trimmed(0.1 * static_cast<double>(y), 1));
  }
  return out;
}

TEST(Compounds, AreCutWhereTheirPlacementsPutThem) {
  const Planned p = planned(part());
  for (const auto& u : p.plan.unplanned) ADD_FAILURE() << u.reason;
  EXPECT_EQ(cut_at(p.plan, "COUNTERBORED", -8.0), "100,50");
  EXPECT_EQ(cut_at(p.plan, "PAIRS", -8.0), "20,30 20,60 40,30 40,60");
  EXPECT_EQ(cut_at(p.plan, "CIRCLE", -8.0), "145,60 160,45 160,75 175,60");
  Job job;
  for (const auto& f : findings_of(p.plan, job))
    EXPECT_EQ(f.severity, Severity::kNote) << f.code << " " << f.message;
}

TEST(ThroughHoles, ThatEndInsideThePieceAreCutDownToItsUnderside) {
  std::string text = part();
  const std::string bottom = "#49=CONICAL_HOLE_BOTTOM(140.,$);";
  ASSERT_NE(text.find(bottom), std::string::npos);
  text.replace(text.find(bottom), bottom.size(), "#49=THROUGH_BOTTOM_CONDITION();");
  // 10 mm deep as stated, in a plate of 30 mm: the finished part is not thinner there.
  const Planned p = planned(text);
  for (const auto& u : p.plan.unplanned) ADD_FAILURE() << u.reason;
  EXPECT_EQ(cut_at(p.plan, "PAIRS", -30.0), "20,30 20,60 40,30 40,60");
  std::string said;
  for (const auto& d : p.said) said += d.message + "\n";
  EXPECT_NE(said.find("ends 20 mm above the underside of the piece"), std::string::npos) << said;
  Job job;
  for (const auto& f : findings_of(p.plan, job))
    EXPECT_EQ(f.severity, Severity::kNote) << f.code << " " << f.message;
}

TEST(Compounds, AnOperationIsDoneForTheElementsThatListIt) {
  std::string text = part();
  put(text, "(),$,#8,$);", "(#101),$,#8,$);");
  put(text, "'SECOND',#4,(),#63", "'SECOND',#4,(#102),#63");
  put(text, "ENDSEC;\nEND-ISO", R"(#101=MACHINING_WORKINGSTEP('PAIRS',#31,#69,#102,$);
#102=DRILLING($,$,'DRILL',20.,$,#103,#106,#107,$,10.,0.,$,$,$);
)" + drill_8(20) + R"(ENDSEC;
END-ISO)");
  const Planned p = planned(text);
  EXPECT_EQ(cut_at(p.plan, "PAIRS", -8.0), "40,30 40,60");
}

TEST(Compounds, WhoseElementsHaveTheirOwnStepsAreNotMadeAgain) {
  std::string text = part();
  put(text, "(),$,#8,$);", "(#101,#111),$,#8,$);");
  put(text, "ENDSEC;\nEND-ISO", R"(#101=MACHINING_WORKINGSTEP('ONE',#31,#64,#102,$);
#111=MACHINING_WORKINGSTEP('TWO',#31,#65,#102,$);
#102=DRILLING($,$,'DRILL',20.,$,#103,#106,#107,$,10.,0.,$,$,$);
)" + drill_8(70) + R"(ENDSEC;
END-ISO)");
  // Without the pattern: the compound alone, at the origin of the pattern's.
  put(text, "#69=GENERAL_PATTERN('PAIRS',#4,(),#61,#66,(#68,#28));", "");
  put(text, "COMPOUND_FEATURE('PAIR',#4,(),#28", "COMPOUND_FEATURE('PAIR',#4,(),#61");
  const Planned p = planned(text);
  EXPECT_EQ(cut_at(p.plan, "ONE", -8.0), "20,30");
  EXPECT_EQ(cut_at(p.plan, "TWO", -8.0), "40,30");
  EXPECT_EQ(cut_at(p.plan, "PAIR", -8.0), "");
}

// A toolpath's coordinates are the feature's own, and its element's where the compound puts it.
TEST(Compounds, AGivenPathOfAnElementRunsWhereTheElementStands) {
  std::string text = part();
  put(text, "(),$,#8,$);", "(#101),$,#8,$);");
  put(text, "ENDSEC;\nEND-ISO", R"(#101=MACHINING_WORKINGSTEP('GIVEN',#31,#53,#102,$);
#102=DRILLING(#110,$,'DRILL',20.,$,#103,#106,#107,$,10.,0.,$,$,$);
)" + drill_8(70) + R"(#110=TOOLPATH_LIST((#111));
#111=CUTTER_LOCATION_TRAJECTORY(.T.,.CONTACT.,$,$,$,$,#112,$,$);
#112=POLYLINE('',(#113,#114));
#113=CARTESIAN_POINT('',(0.,0.,20.));
#114=CARTESIAN_POINT('',(0.,0.,-9.));
ENDSEC;
END-ISO)");
  EXPECT_EQ(cut_at(planned(text).plan, "GIVEN", -8.0), "100,50");
}

TEST(Compounds, AReadingThatWasAssumedIsSaid) {
  std::string text = part();
  const std::string relative = "ON CIRCLE',(15.,0.,0.)", absolute = "ON CIRCLE',(175.,60.,0.)";
  const auto at = text.find(relative);
  ASSERT_NE(at, std::string::npos);
  text.replace(at, relative.size(), absolute);
  const Planned p = planned(text);
  EXPECT_EQ(cut_at(p.plan, "CIRCLE", -8.0), "145,60 160,45 160,75 175,60");
  std::string said;
  for (const auto& d : p.said) {
    if (d.code == "PIP-ASSUMED") said.append(d.message).append("\n");
  }
  EXPECT_NE(said.find("placement of its elements read as workpiece coordinates: relative to the pattern they "
                      "would lie at X335 Y120"),
            std::string::npos)
      << said;
}

}  // namespace
}  // namespace capstan::pipeline
