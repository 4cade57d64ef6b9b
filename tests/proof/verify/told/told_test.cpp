#include <gtest/gtest.h>

#include <algorithm>

#include "planner/proof/verify/program/program_checks.h"
#include "tests/proof/verify/checked.h"
#include "tests/proof/verify/told/two_setups.h"

namespace capstan::verify {
namespace {

using testing::replaced;
using testing::text_of_two;
using testing::told;
using testing::two_setups;

std::vector<model::Finding> check(const std::string& text, const model::Plan& plan) {
  return check_program_text({"part.ngc", text, testing::tool_table_of(plan)}, &plan, plan.machine,
                            plan.cutters);
}

bool told_otherwise(const std::string& text, const model::Plan& plan) {
  const auto findings = check(text, plan);
  return std::any_of(findings.begin(), findings.end(), [](const auto& f) {
    return f.code == "CHK-TEXT-TOLD" && f.severity == Severity::kError;
  });
}

struct Edit {
  const char* name;
  const char* code;
  const char* from;  ///< replaced, once
  const char* to;
};
void PrintTo(const Edit& e, std::ostream* out) { *out << e.name; }

class ToldOtherwise : public ::testing::TestWithParam<Edit> {};

TEST_P(ToldOtherwise, IsAnError) {
  const Edit& e = GetParam();
  model::Plan plan = two_setups();
  plan.machine.id = "mill";
  const std::string sound = replaced(text_of_two(), "(material", "(machine: mill)\n(material");
  ASSERT_TRUE(check(sound, plan).empty()) << told(check(sound, plan));
  const std::string text = replaced(sound, e.from, e.to);
  ASSERT_FALSE(text.empty()) << "the program has no " << e.from;
  const auto findings = check(text, plan);
  const auto f = std::find_if(findings.begin(), findings.end(), [&](const auto& x) {
    return x.code == e.code && x.severity == Severity::kError;
  });
  EXPECT_NE(f, findings.end()) << told(findings);
}

const Edit kEdits[] = {
    {"Machine", "CHK-HEADER-MACHINE", "machine: mill", "machine: router"},
    {"NoMachine", "CHK-HEADER-MACHINE", "(machine: mill)\n", ""},
    {"Material", "CHK-TEXT-TOLD", "material: steel", "material: brass"},
    {"RawPiecesSize", "CHK-TEXT-TOLD", "100 x 50 mm", "100 x 70 mm"},
    {"SecurityPlane", "CHK-HEADER-SETUP", "security=10", "security=2"},
    {"NoSecurityPlane", "CHK-HEADER-SETUP", " security=10", ""},
    {"NoLineOfASetUp", "CHK-HEADER-SETUP", "(CAPSTAN SETUP n=2 offset=G55 security=10)\n", ""},
    {"AnotherTool", "CHK-HEADER-TOOL", "id=\"em10\"", "id=\"em12\""},
    {"AnotherKindOfTool", "CHK-HEADER-TOOL", "\" endmill)", "\" facemill)"},
    {"AToolWithoutItsLength", "CHK-HEADER-TOOL", "length=100 ", ""},
    {"NoLineOfATool", "CHK-HEADER-TOOL", "(CAPSTAN TOOL T2 H2 length=130 diameter=8 id=\"d8\" twist_drill)\n",
     ""},
    {"ZeroElsewhere", "CHK-TEXT-TOLD", "Z0 at its top;", "Z0 10 mm below its top;"},
    {"ZeroAtTheOtherSide", "CHK-TEXT-TOLD", "X0 at its left side", "X0 at its right side"},
    {"RawPieceReachesHigher", "CHK-TEXT-TOLD", "to X100 Y100 Z0)", "to X100 Y100 Z10)"},
    {"AnotherSideUp", "CHK-TEXT-TOLD", "workpiece's +Z up", "workpiece's -Z up"},
    {"NoHolding", "CHK-TEXT-TOLD",
     "(set-up 1: what holds the piece is not planned: fixtures and clamps are not checked)\n", ""},
    {"ZeroSaidTwiceAndOtherwise", "CHK-TEXT-TOLD", "(set-up 1: the raw",
     "(set-up 1: zero G54 on the raw piece as it lies: Z0 at its underside)\n(set-up 1: the raw"},
    {"NoTurn", "CHK-TEXT-TOLD", "(set-up 2: the workpiece is not turned after set-up 1)\n", ""},
    {"AnotherTurn", "CHK-TEXT-TOLD", "is not turned after", "is turned over after"},
    {"AnotherOffsetInTheMessage", "CHK-TEXT-TOLD", "; set G55:", "; set G54:"},
    {"AMessageReworded", "CHK-TEXT-TOLD", "clamp the workpiece anew", "go on with the workpiece"},
    {"AMessageThatIsNotShown", "CHK-TEXT-TOLD", "(MSG, set-up 2", "(set-up 2"},
};

INSTANTIATE_TEST_SUITE_P(Program, ToldOtherwise, ::testing::ValuesIn(kEdits),
                         [](const auto& i) { return std::string(i.param.name); });

TEST(CheckTold, AnOperatorsOwnCommentIsHisOwn) {
  const model::Plan plan = two_setups();
  for (const char* own : {"(jaws greased)\n", "(set-up 1: use the torque wrench)\n", "(MSG, look here)\n"}) {
    const std::string text = replaced(text_of_two(), "(set-up 1: zero", std::string(own) + "(set-up 1: zero");
    ASSERT_FALSE(text.empty());
    EXPECT_TRUE(check(text, plan).empty()) << told(check(text, plan));
  }
}

TEST(CheckTold, ATextThatGoesOnInTheNextCommentIsWhole) {
  const std::string text = replaced(text_of_two(), "Y0 at its front, Z0", "Y0 at its front,)\n(   Z0");
  EXPECT_TRUE(check(text, two_setups()).empty()) << told(check(text, two_setups()));
  const std::string wrong = replaced(text, "(   Z0 at its top", "(   Z0 at its underside");
  ASSERT_FALSE(wrong.empty());
  EXPECT_TRUE(told_otherwise(wrong, two_setups())) << told(check(wrong, two_setups()));
}

TEST(CheckTold, WhatIsSaidOfASolidIsHeldAgainstItsPlace) {
  model::Plan plan = testing::good_plan().plan;
  plan.setups[0].holding.description = "vise";
  plan.setups[0].holding.pickup_text = "left corner";
  model::FixtureSolid jaw;
  jaw.id = "jaw";
  jaw.outline = {{0, 100}, {100, 100}, {100, 120}, {0, 120}};
  jaw.bottom_mm = -60;
  jaw.top_mm = -40;
  plan.setups[0].holding.solids = {jaw};
  std::string lines = testing::lines_of_setup("1", "G54");
  lines = replaced(lines,
                   "(set-up 1: what holds the piece is not planned: fixtures and clamps are not checked)\n",
                   "(set-up 1: pick up G54: left corner)\n(set-up 1: held by vise)\n"
                   "(set-up 1: jaw: X 0 to 100, Y 100 to 120, Z -60 to -40 mm, does not press)\n");
  const std::string sound =
      replaced(testing::program_of(plan), "(a part)\n",
               "(CAPSTAN PROGRAM version=1)\n(material: steel)\n(stock: 100 x 100 x 50 mm)\n"
               "(CAPSTAN SETUP n=1 offset=G54 security=10)\n"
               "(CAPSTAN TOOL T1 H1 length=100 diameter=10 id=\"em10\" endmill)\n"
               "(CAPSTAN TOOL T2 H2 length=130 diameter=8 id=\"d8\" twist_drill)\n" +
                   lines);
  EXPECT_TRUE(check(sound, plan).empty()) << told(check(sound, plan));
  for (const auto& [from, to] : {std::pair{"Z -60 to -40", "Z -60 to -45"},
                                 {"held by vise", "held by plate"},
                                 {"G54: left corner", "G54: right corner"}}) {
    const std::string wrong = replaced(sound, from, to);
    ASSERT_FALSE(wrong.empty()) << from;
    EXPECT_TRUE(told_otherwise(wrong, plan)) << to;
  }
}

TEST(CheckTold, ALyingPieceTurnedOverIsToldSo) {
  model::Plan plan = two_setups();
  // A frame turned over about X in the second set-up: z down, y to the front.
  testing::PlanMaker k;
  k.plan = std::move(plan);
  model::Direction down, right;
  down.direction_ratios = {{0, 0, -1}, true};
  right.direction_ratios = {{1, 0, 0}, true};
  model::Axis2Placement3d over;
  over.location = k.point(0, 100, -50);
  over.axis = k.plan.model.add(down);
  over.ref_direction = k.plan.model.add(right);
  model::WorkpieceSetup ws =
      *k.plan.model.get<model::WorkpieceSetup>(k.plan.model.all(model::TypeId::kWorkpieceSetup).front());
  ws.its_origin = k.plan.model.add(over);
  model::Setup s;
  s.its_id = "over";
  s.its_workpiece_setup.push_back(k.plan.model.add(ws));
  k.plan.setups[1].setup = k.plan.model.add(s);
  const auto findings = check(text_of_two(), k.plan);
  const auto f =
      std::find_if(findings.begin(), findings.end(), [](const auto& x) { return x.code == "CHK-TEXT-TOLD"; });
  ASSERT_NE(f, findings.end()) << told(findings);
  EXPECT_NE(f->message.find("turned over, 180 deg about its X axis"), std::string::npos) << told(findings);
}

TEST(CheckTold, AProgramByOtherHandsHasNoHeaderToHoldItTo) {
  const model::Plan plan = testing::good_plan().plan;
  EXPECT_TRUE(check(testing::program_of(plan), plan).empty()) << told(check(testing::program_of(plan), plan));
}

TEST(CheckTold, WithoutAPlanAnotherMachineThanTheHeadersIsNoted) {
  model::Plan plan = two_setups();
  plan.machine.id = "mill";
  for (const auto& [named, noted] : {std::pair{"(MACHINE: MILL)\n", false}, {"(machine: router)\n", true}}) {
    const auto findings = check_program_text(
        {"part.ngc", replaced(text_of_two(), "(material", std::string(named) + "(material"), ""}, nullptr,
        plan.machine, plan.cutters);
    const auto f = std::find_if(findings.begin(), findings.end(),
                                [](const auto& x) { return x.code == "CHK-HEADER-MACHINE"; });
    ASSERT_EQ(f != findings.end(), noted) << told(findings);
    if (noted) {
      EXPECT_EQ(f->severity, Severity::kNote);
    }
  }
}

}  // namespace
}  // namespace capstan::verify
