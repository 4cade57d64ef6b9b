// Pockets as cycles of the control, whose path is its own: what the text states bounds that path, and the
// check finds a text that states anything else.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <string>
#include <vector>

#include "planner/controls/controls.h"
#include "planner/controls/gcode/moves/pocket_cycles.h"
#include "planner/controls/suitability.h"
#include "planner/door/service/options.h"
#include "planner/door/service/planning.h"
#include "planner/proof/verify/program/readers.h"
#include "planner/proof/verify/verify.h"
#include "tests/door/service/pockets/pocket_parts.h"
#include "tests/support/corpus.h"

namespace capstan::service {
namespace {

using namespace pocket_parts;

using ::testing::Contains;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;

/// What is told of pockets that are asked for as cycles: of a step, that it stays moves; of the program, what
/// the operator's table must have.
std::vector<std::string> told_of(const char* control, const model::Plan& plan, bool of_program) {
  std::vector<std::string> out;
  for (const auto& f : controls::suitability(plan, controls::find_dialect(control)->conformance)) {
    if (f.code == "FIT-POCKET-CYCLE" && f.step.empty() == of_program) out.push_back(f.message);
  }
  return out;
}
std::size_t notes_of(const char* control, const model::Plan& plan) {
  return told_of(control, plan, false).size();
}

struct Fault {
  std::size_t parameter;
  const char *value, *code;
};

void finds_all(const model::Plan& plan, const std::string& text, const std::string& call,
               const std::vector<Fault>& faults) {
  for (const Fault& f : faults) {
    const std::string spoilt = with(text, call, with_parameter(call, f.parameter, f.value));
    EXPECT_THAT(against(spoilt, plan), Contains(HasSubstr(f.code)))
        << f.parameter << " as " << f.value << " in place of " << parameter(call, f.parameter);
  }
}

// The bracket's pocket: 50 x 36, corners of 6, 12 deep, at (48, 40); the mill is 10 wide and leaves 0.3 and
// 0.2. The tool comes from z = 20 and is fed from 1.
TEST(PocketCycles, OfSiemensAreReadBackWithinWhatThePlanProves) {
  const model::Plan& plan = planned("siemens", bracket());
  const std::string text = program_of(plan), call = call_in(text, "POCKET3(");
  EXPECT_THAT(call, ::testing::StartsWith("POCKET3(20,0.8,0.2,-12,50,36,6,48,40,0,"));
  EXPECT_EQ(parameter(call, 11), "0.3");
  EXPECT_EQ(parameter(call, 12), "0.2");
  EXPECT_EQ(parameter(call, 16), "21");
  EXPECT_EQ(parameter(call, 17), "8");
  EXPECT_EQ(parameter(call, 21), "4.5");
  EXPECT_THAT(text,
              HasSubstr("\n;it counts with the radius that the control's tool list has for T2: 5 mm\n"));
  EXPECT_THAT(text, HasSubstr(" s as planned, which tool life counts\n"));
  EXPECT_THAT(text,
              HasSubstr("\n;in along a helix: prove it in the control's simulation before the first cut\n"));
  EXPECT_THAT(against(text, plan, true), IsEmpty());
}

TEST(PocketCycles, OfSiemensAreFoundWhereAParameterIsAnother) {
  const model::Plan& plan = planned("siemens", bracket());
  const std::string text = program_of(plan), call = call_in(text, "POCKET3(");
  finds_all(plan, text, call, {{0, "15", "CHK-POCKET-CYCLE"},     {0, "0.5", "CHK-CYCLE"},
                               {1, "0.5", "CHK-POCKET-CYCLE"},    {1, "2", "CHK-POCKET-CYCLE"},
                               {2, "0.1", "CHK-POCKET-CYCLE"},    {2, "2", "CHK-POCKET-CYCLE"},
                               {3, "-12.01", "CHK-POCKET-CYCLE"}, {3, "-11.9", "CHK-POCKET-CYCLE"},
                               {4, "50.01", "CHK-POCKET-CYCLE"},  {4, "49.9", "CHK-POCKET-CYCLE"},
                               {5, "36.01", "CHK-POCKET-CYCLE"},  {6, "6.02", "CHK-POCKET-CYCLE"},
                               {6, "5.9", "CHK-POCKET-CYCLE"},    {6, "4", "CHK-CYCLE"},
                               {7, "48.01", "CHK-POCKET-CYCLE"},  {8, "40.01", "CHK-POCKET-CYCLE"},
                               {9, "0.1", "CHK-POCKET-CYCLE"},    {9, "90", "CHK-POCKET-CYCLE"},
                               {10, "12", "CHK-POCKET-CYCLE"},    {10, "11.8", "CHK-POCKET-CYCLE"},
                               {10, "6.3", "CHK-POCKET-CYCLE"},   {11, "0.2", "CHK-POCKET-CYCLE"},
                               {11, "0", "CHK-POCKET-CYCLE"},     {12, "0.1", "CHK-POCKET-CYCLE"},
                               {12, "0", "CHK-POCKET-CYCLE"},     {13, "9000", "CHK-CYCLE-FEED"},
                               {13, "2600", "CHK-CYCLE-FEED"},    {13, "", "CHK-CYCLE"},
                               {14, "2500", "CHK-CYCLE-FEED"},    {15, "1", "CHK-POCKET-CYCLE"},
                               {15, "2", "CHK-POCKET-CYCLE"},     {16, "11", "CHK-UNVERIFIABLE"},
                               {16, "22", "CHK-UNVERIFIABLE"},    {17, "10.5", "CHK-POCKET-CYCLE"},
                               {18, "40", "CHK-UNVERIFIABLE"},    {21, "5.5", "CHK-POCKET-CYCLE"},
                               {21, "2", "CHK-POCKET-CYCLE"},     {22, "4", "CHK-POCKET-CYCLE"}});
}

TEST(PocketCycles, OfSiemensTakeRoundAndTurnedPockets) {
  const model::Plan& round = planned("siemens", round_pocket());
  const std::string text = program_of(round), call = call_in(text, "POCKET4(");
  EXPECT_THAT(call, ::testing::StartsWith("POCKET4(20,0.8,0.2,-12,18,48,40,"));
  EXPECT_THAT(against(text, round, true), IsEmpty());
  finds_all(round, text, call,
            {{4, "18.01", "CHK-POCKET-CYCLE"},
             {5, "48.01", "CHK-POCKET-CYCLE"},
             {8, "0.2", "CHK-POCKET-CYCLE"},
             {10, "9000", "CHK-CYCLE-FEED"}});
  const model::Plan& turned = planned("siemens", turned_pocket());
  const std::string other = program_of(turned), turned_call = call_in(other, "POCKET3(");
  EXPECT_EQ(parameter(turned_call, 9), "20");
  EXPECT_THAT(against(other, turned, true), IsEmpty());
  finds_all(turned, other, turned_call, {{9, "19.9", "CHK-POCKET-CYCLE"}, {9, "160", "CHK-POCKET-CYCLE"}});
}

// A slot with round ends is a rectangle with corners half as wide: 30 + 14 long, along Y, 8 deep.
TEST(PocketCycles, TakeSlotsWithRoundEndsAsRectanglesWithRoundEnds) {
  const model::Plan& plan = planned("siemens", closed_slot());
  const std::string text = program_of(plan), call = call_in(text, "POCKET3(20,0.8,0.2,-8,");
  EXPECT_THAT(call, ::testing::StartsWith("POCKET3(20,0.8,0.2,-8,44,14,7,103,40,90,"));
  EXPECT_THAT(against(text, plan, true), IsEmpty());
  finds_all(plan, text, call,
            {{4, "44.01", "CHK-POCKET-CYCLE"},
             {5, "14.02", "CHK-POCKET-CYCLE"},
             {6, "6.9", "CHK-POCKET-CYCLE"},
             {8, "40.01", "CHK-POCKET-CYCLE"},
             {9, "90.1", "CHK-POCKET-CYCLE"},
             {10, "8", "CHK-POCKET-CYCLE"},
             {22, "3", "CHK-POCKET-CYCLE"}});
  const model::Plan& other = planned("heidenhain", closed_slot());
  EXPECT_THAT(program_of(other), HasSubstr("Q218=+44 ;"));
  EXPECT_THAT(against(program_of(other), other, true), IsEmpty());
}

// Half of such a width has a decimal more than the control: corners of 7.938 or 4.763 would be rounder than
// half of 15.875 or 9.525, which is 7.9375 and 4.7625.
TEST(PocketCycles, OfWidthsWithAnOddLastDecimalHaveCornersNoRounderThanHalfTheWidth) {
  for (const auto& [width, corner] :
       std::vector<std::pair<std::string, std::string>>{{"15.875", "7.937"}, {"9.525", "4.762"}}) {
    const model::Plan& plan = planned("siemens", closed_slot(width));
    const std::string text = program_of(plan), call = call_in(text, "POCKET3(20,0.8,0.2,-8,");
    EXPECT_EQ(parameter(call, 5), width);
    EXPECT_EQ(parameter(call, 6), corner);
    EXPECT_THAT(against(text, plan, true), IsEmpty());
    const model::Plan& other = planned("heidenhain", closed_slot(width));
    EXPECT_THAT(program_of(other), HasSubstr("Q219=+" + width + " ;SLOT WIDTH"));
    EXPECT_THAT(against(program_of(other), other, true), IsEmpty());
  }
}

struct Other {
  const char *from, *to, *code;
};

void finds_others(const model::Plan& plan, const std::string& text, const std::vector<Other>& others) {
  for (const Other& o : others)
    EXPECT_THAT(against(with(text, o.from, o.to), plan), Contains(HasSubstr(o.code)))
        << o.to << " in place of " << o.from;
}

// Heights are distances from the surface Q203, 0.2 below where the tool is fed from, 1; rings are 0.7 of
// the mill's diameter apart, for Q370 counts in radii and is 1.414 at most.
TEST(PocketCycles, OfHeidenhainAreReadBackWithinWhatThePlanProves) {
  const model::Plan& plan = planned("heidenhain", bracket());
  const std::string text = program_of(plan);
  for (const char* line : {"CYCL DEF 251 RECTANGULAR POCKET ~", "Q218=+50 ;", "Q219=+36 ;", "Q220=+6 ;",
                           "Q368=+0.3 ;", "Q369=+0.2 ;", "Q224=+0 ;", "Q201=-12.8 ;", "Q200=+0.2 ;",
                           "Q203=+0.8 ;", "Q204=+19.2 ;", "Q370=+1.4 ;"})
    EXPECT_THAT(text, HasSubstr(line));
  EXPECT_THAT(against(text, plan, true), IsEmpty());
}

TEST(PocketCycles, OfHeidenhainAreFoundWhereAParameterIsAnother) {
  const model::Plan& plan = planned("heidenhain", bracket());
  const std::string text = program_of(plan);
  const std::size_t at = text.find("CYCL DEF 251");
  ASSERT_NE(at, std::string::npos);
  const auto q = [&](const char* name) {
    const std::size_t begin = text.find(name, at);
    return text.substr(begin, text.find(' ', begin) - begin);
  };
  const std::string level = q("Q202="), mill = q("Q207="), plunge = q("Q206=");
  finds_others(plan, text, {{"Q218=+50 ;", "Q218=+50.01 ;", "CHK-POCKET-CYCLE"},
                            {"Q219=+36 ;", "Q219=+35.9 ;", "CHK-POCKET-CYCLE"},
                            {"Q220=+6 ;", "Q220=+6.02 ;", "CHK-POCKET-CYCLE"},
                            {"Q220=+6 ;", "Q220=+0 ;", "CHK-POCKET-CYCLE"},
                            {"Q368=+0.3 ;", "Q368=+0.2 ;", "CHK-POCKET-CYCLE"},
                            {"Q369=+0.2 ;", "Q369=+0 ;", "CHK-POCKET-CYCLE"},
                            {"Q224=+0 ;", "Q224=+0.1 ;", "CHK-POCKET-CYCLE"},
                            {"Q201=-12.8 ;", "Q201=-12.81 ;", "CHK-POCKET-CYCLE"},
                            {"Q201=-12.8 ;", "Q201=+12.8 ;", "CHK-CYCLE"},
                            {"Q200=+0.2 ;", "Q200=+2 ;", "CHK-POCKET-CYCLE"},
                            {"Q203=+0.8 ;", "Q203=+0.7 ;", "CHK-POCKET-CYCLE"},
                            {"Q203=+0.8 ;", "Q203=+0.9 ;", "CHK-CYCLE"},
                            {"Q204=+19.2 ;", "Q204=+9.2 ;", "CHK-POCKET-CYCLE"},
                            {"Q215=+1 ;", "Q215=+0 ;", "CHK-UNVERIFIABLE"},
                            {"Q367=+0 ;", "Q367=+1 ;", "CHK-UNVERIFIABLE"},
                            {"Q366=+1 ;", "Q366=+0 ;", "CHK-UNVERIFIABLE"},
                            {"Q351=+1 ;", "Q351=-1 ;", "CHK-POCKET-CYCLE"},
                            {"Q370=+1.4 ;", "Q370=+1.5 ;", "CHK-CYCLE"},
                            {level.c_str(), "Q202=+6.3", "CHK-POCKET-CYCLE"},
                            {level.c_str(), "Q202=+12", "CHK-POCKET-CYCLE"},
                            {mill.c_str(), "Q207=9000", "CHK-CYCLE-FEED"},
                            {plunge.c_str(), "Q206=2500", "CHK-CYCLE-FEED"}});
  const std::string way = text.substr(text.find("L X+48 Y+40 R0 FMAX"), 19);
  finds_others(plan, text, {{way.c_str(), "L X+48.01 Y+40 R0 FMAX", "CHK-"}});
  const std::size_t angle = text.find("; ANGLE of T");
  ASSERT_NE(angle, std::string::npos);
  const std::string told = text.substr(angle, text.find('\n', angle) - angle);
  finds_others(plan, text,
               {{told.c_str(), "; ANGLE of T2 in the tool table: 30 degrees at most", "CHK-POCKET-CYCLE"},
                {told.c_str(), "; as steep as it likes", "CHK-UNVERIFIABLE"}});
}

// The tool table has one ANGLE for the mill that roughs both the pocket and the slot: the lesser, rounded
// down to hundredths.
TEST(PocketCycles, OfOneToolHaveOneAngleOfTheTableTheLeastOfAll) {
  const model::Plan& plan = planned("heidenhain", closed_slot());
  double least = 90.0, most = 0.0;
  for (std::size_t n = 0; n < plan.steps.size(); ++n) {
    const auto c = controls::gcode::pocket_of(plan, n).cycle;
    if (!c) continue;
    ASSERT_EQ(c->tool, 2);
    const double angle = std::atan(c->turn_mm / (2.0 * std::numbers::pi * c->helix_mm));
    least = std::min(least, angle * 180.0 / std::numbers::pi);
    most = std::max(most, angle * 180.0 / std::numbers::pi);
  }
  ASSERT_GT(most, least + 0.1);
  const std::string text = program_of(plan), begin = "; ANGLE of T2 in the tool table: ";
  const std::size_t at = text.find(begin);
  ASSERT_NE(at, std::string::npos);
  EXPECT_LT(at, text.find("; CAPSTAN STEP "));
  EXPECT_EQ(text.find("ANGLE of T", at + begin.size()), std::string::npos);
  const double told = std::stod(text.substr(at + begin.size()));
  EXPECT_LE(told, least);
  EXPECT_GT(told, least - 0.01 - 1e-9);
  EXPECT_THAT(against(text, plan, true), IsEmpty());
  // A second one of the same tool says something else of the same table.
  EXPECT_THAT(against(with(text, "; it counts with the radius that the control's tool list has for T2: 5 mm",
                           "; ANGLE of T2 in the tool table: 3 degrees at most"),
                      plan),
              Contains(HasSubstr("ANGLE of T2 in the tool table is 3 degrees at most here")));
}

// The table is the operator's: neither program nor check has it.
TEST(PocketCycles, TellOnceWhatTheToolTableOfTheControlMustHave) {
  const auto of_heidenhain = told_of("heidenhain", planned("heidenhain", closed_slot()), true);
  ASSERT_EQ(of_heidenhain.size(), 1U);
  EXPECT_THAT(of_heidenhain[0], HasSubstr("see that it has: R of T2 5 mm; ANGLE of T2 in the tool table: "));
  const auto of_siemens = told_of("siemens", planned("siemens", bracket()), true);
  ASSERT_EQ(of_siemens.size(), 1U);
  EXPECT_THAT(of_siemens[0], HasSubstr("see that it has: R of T2 5 mm; tool life counts the "));
  EXPECT_THAT(told_of("fanuc", planned("fanuc", bracket()), true), IsEmpty());
}

TEST(PocketCycles, OfHeidenhainTakeRoundAndTurnedPockets) {
  const model::Plan& round = planned("heidenhain", round_pocket());
  const std::string text = program_of(round);
  EXPECT_THAT(text, HasSubstr("CYCL DEF 252 CIRCULAR POCKET ~"));
  EXPECT_THAT(against(text, round, true), IsEmpty());
  finds_others(round, text, {{"Q223=+36 ;", "Q223=+36.02 ;", "CHK-POCKET-CYCLE"}});
  const model::Plan& turned = planned("heidenhain", turned_pocket());
  EXPECT_THAT(program_of(turned), HasSubstr("Q224=+20 ;"));
  EXPECT_THAT(against(program_of(turned), turned, true), IsEmpty());
}

// Where there is no cycle a comment at the step says why, and its moves are the plan's.
TEST(PocketCycles, AreMovesWhereTheControlHasNoneOrThePocketIsNoneForIt) {
  const model::Plan& fanuc = planned("fanuc", bracket());
  EXPECT_THAT(program_of(fanuc), HasSubstr("(NO CYCLE OF THE CONTROL FOR THIS POCKET: IT HAS NONE)"));
  EXPECT_THAT(against(program_of(fanuc), fanuc, true), IsEmpty());
  EXPECT_EQ(notes_of("fanuc", fanuc), 1U);
  // Nor does it become a cycle where another control's profile is held against it: its program is the same.
  EXPECT_EQ(notes_of("siemens", fanuc), 1U);
  EXPECT_EQ(notes_of("siemens", planned("siemens", bracket())), 0U);
  const model::Plan& one_sided = planned(
      "siemens", with(bracket(), "#57=PLUS_MINUS_VALUE(0.1,0.1,3);", "#57=PLUS_MINUS_VALUE(0.1,0.,3);"));
  EXPECT_THAT(program_of(one_sided),
              HasSubstr(";no cycle of the control for this pocket: its tolerances lie to one side"));
  EXPECT_THAT(program_of(one_sided), Not(HasSubstr("POCKET3(")));
}

// The path that is swept for a cycle: the mill's middle comes to 25 - 5 - 0.3 and 18 - 5 - 0.3 mm from the
// pocket's at each level, and no farther; levels divide the way from 0.8 to -11.8 evenly.
TEST(PocketCycles, AreFollowedUpToTheirContourLevelByLevel) {
  for (const char* control : {"siemens", "heidenhain"}) {
    const model::Plan& plan = planned(control, bracket());
    const verify::Program p = verify::reader_of(control)->program(program_of(plan), plan.machine);
    ASSERT_EQ(p.pockets.size(), 1U) << control;
    const double depth = 12.6, levels = std::ceil(depth / p.pockets[0].level_mm - 1e-6);
    std::map<long, std::pair<double, double>> reached;  // by level
    for (const verify::Block& b : p.blocks) {
      if (b.pocket < 0 || b.kind != verify::Block::Kind::kMove || b.move == model::MoveKind::kRapid) continue;
      const double level = (0.8 - b.to.z) / (depth / levels);
      if (std::abs(level - std::round(level)) > 1e-6) continue;
      auto& [along, across] = reached[std::lround(level)];
      along = std::max(along, std::abs(b.to.x - 48.0));
      across = std::max(across, std::abs(b.to.y - 40.0));
      EXPECT_GE(b.to.z, -11.8 - 1e-9);
    }
    EXPECT_EQ(static_cast<double>(reached.size()), levels) << control;
    for (const auto& [level, reach] : reached) {
      EXPECT_NEAR(reach.first, 19.7, 1e-6) << control << " " << level;
      EXPECT_NEAR(reach.second, 12.7, 1e-6) << control << " " << level;
    }
  }
}

// What would become more moves than a reader follows, or none, is a fault.
TEST(PocketCycles, ThatCannotBeFollowedAreFaults) {
  const model::Plan& plan = planned("siemens", bracket());
  const std::string text = program_of(plan), call = call_in(text, "POCKET3(");
  for (const auto& [n, value] : std::vector<std::pair<std::size_t, const char*>>{{4, "1e9"},
                                                                                 {4, "-50"},
                                                                                 {6, "1e9"},
                                                                                 {10, "1e-9"},
                                                                                 {10, "0"},
                                                                                 {10, "-4"},
                                                                                 {17, "1e-9"},
                                                                                 {13, "0"},
                                                                                 {21, "20"},
                                                                                 {22, "1e-9"},
                                                                                 {22, "0"},
                                                                                 {2, "-1"},
                                                                                 {3, "R1"},
                                                                                 {9, "1e300"},
                                                                                 {11, "30"},
                                                                                 {16, "1"}}) {
    const std::string spoilt = with(text, call, with_parameter(call, n, value));
    EXPECT_THAT(against(spoilt, plan), Not(IsEmpty())) << n << " as " << value;
  }
  EXPECT_THAT(against(with(text, call, "MCALL " + call), plan), Contains(HasSubstr("CHK-UNVERIFIABLE")));
  EXPECT_THAT(against(with(text, call, call.substr(0, call.size() - 1) + ",,,1)"), plan),
              Contains(HasSubstr("CHK-UNVERIFIABLE")));
}

// One pocket each, and two in the part of two set-ups.
TEST(PocketCycles, OfShippedPartsAreReadBackClean) {
  for (const char* control : {"siemens", "heidenhain"}) {
    for (const auto& [part, cycles] : std::vector<std::pair<std::string, std::size_t>>{
             {"plate_bound.p21", 1U}, {"reference_pocket.p21", 1U}, {"two_setups.p21", 2U}}) {
      const model::Plan& plan = planned(control, testing::slurp(testing::source_dir() + "/examples/" + part));
      const std::string text = program_of(plan);
      std::size_t n = 0;
      for (const char* call : {"\nPOCKET", " CYCL DEF 25"}) {
        for (std::size_t at = text.find(call); at != std::string::npos; at = text.find(call, at + 1)) ++n;
      }
      EXPECT_EQ(n, cycles) << part << " " << control;
      EXPECT_THAT(against(text, plan), IsEmpty()) << part << " " << control;
    }
  }
}

// An edit says it of one step: the part's other cycles and moves are as its machine has them.
TEST(PocketCycles, MayBeAskedForOfOneStep) {
  Request request;
  ASSERT_TRUE(set(request, "control", "siemens"));
  ASSERT_TRUE(set(request, "set", "POCKET*/cycles=pocket"));
  Job job;
  const auto out = plan(request, {.name = "bracket.p21", .bytes = bracket()}, job);
  ASSERT_TRUE(out) << to_text(out.error().what);
  const std::string text = program_of(out->plan);
  EXPECT_THAT(text, HasSubstr("\nPOCKET3("));
  EXPECT_THAT(against(text, out->plan, true), IsEmpty());
  ASSERT_TRUE(set(request, "set", "POCKET*/cycles=explicit"));
  const auto moves = plan(request, {.name = "bracket.p21", .bytes = bracket()}, job);
  ASSERT_TRUE(moves) << to_text(moves.error().what);
  EXPECT_THAT(program_of(moves->plan), Not(HasSubstr("POCKET3(")));
}

// The step's other figures are held too: its speed, and that nothing else moves.
TEST(PocketCycles, AreFoundBesideASecondOneOrWithAnotherSpeed) {
  const model::Plan& plan = planned("siemens", bracket());
  const std::string text = program_of(plan), call = call_in(text, "POCKET3(");
  EXPECT_THAT(against(with(text, call, call + "\n" + call), plan), Not(IsEmpty()));
  EXPECT_THAT(against(with(text, call, call + "\nG1 X50 Z-13"), plan), Not(IsEmpty()));
  EXPECT_THAT(against(with(text, call, "S9000\n" + call), plan), Not(IsEmpty()));
  EXPECT_THAT(against(with(text, call, "M9\n" + call), plan), Not(IsEmpty()));
  EXPECT_THAT(against(with(text, call + "\n", ""), plan), Not(IsEmpty()));
}

}  // namespace
}  // namespace capstan::service
