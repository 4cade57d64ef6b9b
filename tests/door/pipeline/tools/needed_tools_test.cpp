// What a shop has to add to its tools so that all of a part is planned.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <string>

#include "planner/model/plan/corner_rest.h"
#include "tests/door/pipeline/block.h"
#include "tooling/library/library.h"

namespace capstan::pipeline {
namespace {

using namespace block;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

/// A plain hole of 6.6 mm through the block, one of 8 H7, and a pocket with corners of R3, 10 mm deep.
const char* const kParts =
    "#61=TOLERANCED_LENGTH_MEASURE(6.6,$);\n"
    "#62=CARTESIAN_POINT('',(0.,0.,-20.));\n#67=AXIS2_PLACEMENT_3D('',#62,#21,#22);\n#68=PLANE('',#67);\n"
    "#64=CARTESIAN_POINT('',(20.,20.,0.));\n#65=AXIS2_PLACEMENT_3D('',#64,#21,#22);\n"
    "#66=ROUND_HOLE('PLAIN',#4,(),#65,#68,#61,$,#58);\n"
    "#70=PLUS_MINUS_VALUE(0.015,0.,3);\n#71=TOLERANCED_LENGTH_MEASURE(8.,#70);\n"
    "#72=CARTESIAN_POINT('',(80.,20.,0.));\n#73=AXIS2_PLACEMENT_3D('',#72,#21,#22);\n"
    "#74=ROUND_HOLE('FITTED',#4,(),#73,#68,#71,$,#58);\n"
    "#80=TOLERANCED_LENGTH_MEASURE(40.,$);\n#81=TOLERANCED_LENGTH_MEASURE(30.,$);\n"
    "#82=TOLERANCED_LENGTH_MEASURE(3.,$);\n#83=RECTANGULAR_CLOSED_PROFILE($,#81,#80);\n"
    "#84=CLOSED_POCKET('POCKET',#4,(),#50,#56,(),$,#57,$,#82,#83);\n";

Inputs shop_with(const std::vector<std::string>& ids) {
  Inputs in = shop();
  std::erase_if(in.library,
                [&](const model::Cutter& c) { return std::find(ids.begin(), ids.end(), c.id) == ids.end(); });
  return in;
}

std::vector<std::string> entries_of(const model::Plan& plan) {
  std::vector<std::string> out;
  for (const auto& p : plan.provenance) {
    if (p.what.starts_with("needed tool ")) out.push_back(p.value);
  }
  return out;
}

std::vector<model::Cutter> read_list(const std::vector<std::string>& entries) {
  std::string text = "capstan_tools: 1\nunit: mm\nsource: \"the list of what is needed\"\ntools:\n";
  for (const std::string& e : entries) text += "  - " + e + "\n";
  Job job;
  auto cutters = tooling::read_own_list(text, "needed.yaml", job);
  EXPECT_TRUE(cutters) << (cutters ? "" : to_text(cutters.error())) << "\n" << text;
  return cutters ? *std::move(cutters) : std::vector<model::Cutter>{};
}

TEST(NeededTools, AreListedAtOnceAndAddingExactlyThesePlansAllOfThePart) {
  const Inputs poor = shop_with({"generic/spot_drill_90/8", "generic/endmill_3f_short/16"});
  const Planned lacking = bound(read(kParts), poor);
  ASSERT_EQ(lacking.plan.unplanned.size(), 2U) << lacking.said;
  ASSERT_EQ(model::corner_rests(lacking.plan).size(), 1U) << "the pocket keeps corners of the wide mill";
  EXPECT_THAT(lacking.said, HasSubstr("to plan all of this part you need: "));
  const auto entries = entries_of(lacking.plan);
  ASSERT_FALSE(entries.empty());

  Inputs richer = poor;
  for (model::Cutter& c : read_list(entries)) richer.library.push_back(std::move(c));
  const Planned whole = bound(read(kParts), richer);
  EXPECT_THAT(whole.plan.unplanned, IsEmpty()) << whole.said;
  EXPECT_THAT(model::corner_rests(whole.plan), IsEmpty()) << whole.said;
  EXPECT_THAT(entries_of(whole.plan), IsEmpty());

  // Exactly these: without any one of them something is missing again.
  for (std::size_t i = 0; i < entries.size(); ++i) {
    std::vector<std::string> fewer = entries;
    fewer.erase(fewer.begin() + static_cast<std::ptrdiff_t>(i));
    Inputs less = poor;
    if (!fewer.empty())
      for (model::Cutter& c : read_list(fewer)) less.library.push_back(std::move(c));
    const model::Plan lacks = bound(read(kParts), less).plan;
    EXPECT_FALSE(lacks.unplanned.empty() && model::corner_rests(lacks).empty()) << entries[i];
  }
}

TEST(NeededTools, OfOneKindAreOneToolForAllFeaturesThatAskForIt) {
  const Inputs poor = shop_with({"generic/spot_drill_90/8"});
  const Planned p = bound(read(kTwoHoles), poor);
  ASSERT_EQ(p.plan.unplanned.size(), 2U) << p.said;
  const auto entries = entries_of(p.plan);
  ASSERT_EQ(entries.size(), 1U) << p.said;
  EXPECT_THAT(entries[0], HasSubstr("class: twist_drill"));
  EXPECT_THAT(entries[0], HasSubstr("cutting_diameter: 8,"));
  const auto row = std::find_if(p.plan.provenance.begin(), p.plan.provenance.end(),
                                [](const auto& x) { return x.what == "needed tool 1"; });
  EXPECT_EQ(row->source, "for 'H1', 'H2'");
}

TEST(NeededTools, AreNotNamedWhereNoToolWouldHelp) {
  // This machine's spindle is too weak for any drill.
  Inputs weak = shop_with({"generic/spot_drill_90/8"});
  for (auto& point : weak.machine.spindle.curve) point.torque_nm *= 1e-6, point.power_w *= 1e-6;
  const Planned p = bound(read(kTwoHoles), weak);
  ASSERT_FALSE(p.plan.unplanned.empty());
  EXPECT_THAT(entries_of(p.plan), IsEmpty()) << p.said;
}

}  // namespace
}  // namespace capstan::pipeline
