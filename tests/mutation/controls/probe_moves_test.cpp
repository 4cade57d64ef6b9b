#include <gtest/gtest.h>

#include <string>
#include <utility>
#include <vector>

#include "tests/mutation/controls/touched.h"
#include "tests/support/rs274.h"

// Touches by moves of the program's own, which end where the probe touches (LinuxCNC and Grbl: G38.2, Mach3:
// G31): written where their way is clear, read back as moves, and held to it.

namespace capstan::mutation {
namespace {

using namespace touched;

std::vector<model::ControlOption> by_moves(const std::string& dialect) {
  std::vector<model::ControlOption> out = kProbe;
  out.push_back({"probe_feed_mm_min", "100"});
  out.push_back({"probe_way_mm_min", "1500"});
  out.push_back({"probe_overtravel_mm", "2"});
  if (dialect == "grbl") out.push_back({"tool_length", "g43.1"});
  return out;
}

model::Plan moved(const std::vector<Touched>& touches, const std::string& dialect) {
  return touched::measured(touches, dialect, by_moves(dialect));
}

/// The value of an option is another one, or none.
model::Plan with(model::Plan plan, const std::string& option, const std::string& value) {
  std::vector<model::ControlOption> kept;
  for (const auto& o : plan.machine.control_options->chosen)
    if (o.name != option) kept.push_back(o);
  if (!value.empty()) kept.push_back({option, value});
  plan.machine.control_options = model::ControlOptions{std::move(kept)};
  return plan;
}

const Touched kSide{{110, 50, -5}, {-1, 0, 0}, 7.0};  // its side meets X100

TEST(ProbeMoves, ATouchWhoseWayIsClearIsMovedToAndTheStopStays) {
  for (const auto& [dialect, code] :
       {std::pair{"linuxcnc", "G38.2"}, std::pair{"grbl", "G38.2"}, std::pair{"mach3", "G31"}}) {
    const model::Plan plan = moved({kTop}, dialect);
    const std::string text = text_of(plan);
    const std::size_t call = text.find("\nT20 M6\n"), over = text.find("\nG0 X80 Y80\nG1 Z5 F1500\n", call);
    ASSERT_NE(call, std::string::npos) << text;
    ASSERT_NE(over, std::string::npos) << text;
    const std::size_t touch = text.find("\n" + std::string(code) + " Z-2 F100\n", over);
    ASSERT_NE(touch, std::string::npos) << text;
    const std::size_t back = text.find("\nG1 Z5 F1500\nG53 G0 Z0\n", touch);
    ASSERT_NE(back, std::string::npos) << text;
    EXPECT_LT(back, text.find("\nM0\n", back)) << "it stops behind it";
    EXPECT_TRUE(has(text, "expected at Z0")) << text;
    EXPECT_EQ(found(plan, text), "") << text;
  }
}

TEST(ProbeMoves, TheProbeIsCalledOnceForAllTouchesAndTheBallsSideMeetsAWall) {
  const model::Plan plan = moved({kTop, kSide}, "linuxcnc");
  const std::string text = text_of(plan);
  EXPECT_TRUE(has(text, "\nG0 X110 Y50\nG1 Z-8 F1500\nG38.2 X101 F100\n")) << text;
  EXPECT_TRUE(has(text, "\nG1 X110 F1500\nG53 G0 Z0\n")) << text;
  EXPECT_TRUE(has(text, "X#5061 Y#5062 Z#5063, expected at X103)")) << text;
  const std::size_t call = text.find("T20 M6");
  EXPECT_EQ(text.find("T20 M6", call + 1), std::string::npos) << text;
  EXPECT_EQ(found(plan, text, controls::tool_table_of(plan)), "") << text;
}

TEST(ProbeMoves, LinuxCncsInterpreterTakesThem) {
  CAPSTAN_NEEDS_RS274();
  const model::Plan plan = moved({kTop, kSide}, "linuxcnc");
  const auto ran = testing::run_rs274(controls::tool_table_of(plan), text_of(plan));
  EXPECT_EQ(ran.status, 0) << ran.output;
  const auto probed = ran.only({"STRAIGHT_PROBE"});
  ASSERT_EQ(probed.size(), 2U) << ran.output;
  EXPECT_DOUBLE_EQ(probed[0].numbers[2], -2.0);
  EXPECT_DOUBLE_EQ(probed[1].numbers[0], 101.0);
  EXPECT_EQ(ran.only({"PROGRAM_END"}).size(), 1U) << ran.output;
}

TEST(ProbeMoves, WhatIsNotProvenStaysAStopThatSaysWhy) {
  const auto says = [](const model::Plan& plan, const char* why) {
    const std::string text = text_of(plan);
    EXPECT_FALSE(has(text, "\nG38.2")) << text;
    EXPECT_TRUE(has(text, why)) << why << "\n" << text;
    EXPECT_EQ(found(plan, text), "");
  };
  const model::Plan plan = moved({kTop}, "linuxcnc");
  says(moved({{{50, 50, -5}, {1, 0, 0}, 17.0}}, "linuxcnc"), "not proven clear of the piece");
  says(moved({{{80, 80, 8}, {0, 0.6, -0.8}, 5.0}}, "linuxcnc"), "along no axis");
  says(with(plan, "probe_stylus_mm", ""), "probe_stylus_mm");
  says(with(plan, "probe_overtravel_mm", ""), "probe_overtravel_mm");
  // Clear to the wall, and not 2 mm beyond it.
  says(with(plan, "probe_stylus_mm", "3"), "not proven clear of the piece");
  EXPECT_TRUE(has(text_of(with(with(plan, "probe_stylus_mm", "3"), "probe_overtravel_mm", "0.3")), "G38.2"));
  model::Plan other = plan;
  other.cutters.pop_back();
  says(other, "none of the tool list");
  other = plan;
  other.cutters.back().functional_length_mm = 0.0;
  says(other, "is not measured");
  EXPECT_FALSE(has(text_of(with(plan, "probe_feed_mm_min", "")), "G38.2"));
  EXPECT_FALSE(has(text_of(with(moved({kTop}, "grbl"), "tool_length", "")), "G38.2")) << "zero by touch-off";
}

TEST(ProbeMoves, AStepThatGoesOnWithTheToolBeforeCallsItAgain) {
  for (const char* dialect : {"linuxcnc", "fanuc"}) {
    std::vector<model::ControlOption> options = by_moves(dialect);
    if (std::string(dialect) == "fanuc") {
      options = kProbe;
      options.push_back({"probe_macro", "G65 P9810 X{x} Y{y} Z{z} | G65 P9811 {axis}{nominal}"});
    }
    const auto plan_with = [&](bool touches) {
      model::Plan plan =
          touched::measured(touches ? std::vector{kTop} : std::vector<Touched>{}, dialect, options);
      plan.cutters[0].pocket = 2;
      plan.steps[0].cutter_id = plan.cutters[1].id;
      plan.cutters.erase(plan.cutters.begin());
      return plan;
    };
    const model::Plan plan = plan_with(true), none = plan_with(false);
    const std::string text = text_of(plan), without = text_of(none);
    const std::size_t first = text.find("\nT2 M6"), again = text.find("\nT2 M6", first + 1);
    ASSERT_NE(again, std::string::npos) << text;
    EXPECT_EQ(without.find("\nT2 M6", without.find("\nT2 M6") + 1), std::string::npos) << without;
    // A drill that mills has faults of its own, with and without the touch: none is of the call.
    for (const char* code : {"CHK-PROBE", "CHK-TEXT"})
      EXPECT_FALSE(has(found(plan, text), code)) << found(plan, text);
    std::string unsaid = text;
    unsaid.erase(again + 1, 6);
    EXPECT_TRUE(has(found(plan, unsaid), "CHK-PROBE-CALL")) << dialect;
    EXPECT_TRUE(has(found(none, replaced(without, "\nG0 X15", "\nT2 M6\nG0 X15")), "CHK-TEXT")) << dialect;
  }
}

TEST(ProbeMoves, OtherMovesAreFound) {
  const model::Plan plan = moved({kTop}, "linuxcnc");
  const std::string text = text_of(plan);
  ASSERT_EQ(found(plan, text), "");
  const std::string touch = "G38.2 Z-2 F100\n";
  for (const auto& [from, to] : std::vector<std::pair<std::string, std::string>>{
           {"G0 X80 Y80\nG1 Z5", "G0 X80 Y80.01\nG1 Z5"},  // elsewhere
           {"G1 Z5 F1500", "G1 Z4 F1500"},                 // lower
           {"G1 Z5 F1500", "G0 Z5"},                       // by rapid
           {"G1 Z5 F1500", "G1 Z5 F15000"},                // faster
           {"G1 Z5 F1500", "G1 Z5 X80 F1500"},             // across
           {touch, "G38.2 Z-3 F100\n"},                    // further
           {touch, "G38.2 Z-2 F1000\n"},                   // faster
           {touch, "G38.2 X70 F100\n"},                    // along another axis
           {touch, "G38.2 X80 Z-2 F100\n"},                // along two
           {touch, "G38.3 Z-2 F100\n"},                    // no error without a touch
           {touch, "G1 Z-2 F100\n"},                       // into the piece
           {touch, touch + "G0 X90\n"},                    // away before it is back
           {touch, touch + touch},                         // twice
           {"T20 M6", "T2 M6"},                            // a drill
           {"T20 M6\nG21 G17 G90 G94 G40 G80\nG61\nG54\nG43 H20\n",
            "T20 M6\nG21 G17 G90 G94 G40 G80\nG61\nG54\n"},  // without its length
           {"G43 H20", "G43 H2"},                            // with another
           {"G54\nG43 H20", "G55\nG43 H20"},                 // in another offset
           {"G61\nG54\nG43 H20", "G64 P0.1\nG54\nG43 H20"},  // corners rounded
           {"G43 H20\nG53 G0 Z0\n", "G43 H20\n"},            // height not known behind the change
           {"G43 H20\n", "G43 H20\nM3 S1000\n"},             // the spindle turns
       })
    EXPECT_NE(found(plan, replaced(text, from, to)), "") << from << " -> " << to;
  const std::size_t call = text.find("T20 M6"), away = text.find("G53 G0 Z0\nM5\nM9\n", call);
  const std::string all = text.substr(call, away - call);
  EXPECT_EQ(found(plan, replaced(text, all, "")), "") << "by hand";
  EXPECT_TRUE(has(found(plan, replaced(text, all, all + all)), "CHK-PROBE-CALL")) << "a second time";
  const std::string without = replaced(text, all, "");
  EXPECT_TRUE(has(found(plan, replaced(without, "\nM2", "\n" + all + "G53 G0 Z0\nM2")), "CHK-PROBE-CALL"));
  EXPECT_TRUE(has(found(plan, replaced(without, "\nM2", "\nG38.2 Z-2 F100\nM2")), "CHK-PROBE-CALL"));
}

TEST(ProbeMoves, ThePlansWayFeedAndLengthAreHeldAgainstTheText) {
  const model::Plan plan = moved({kTop}, "linuxcnc");
  const std::string text = text_of(plan);
  EXPECT_TRUE(has(found(with(plan, "probe_stylus_mm", "0.5"), text), "CHK-PROBE-WAY"));
  EXPECT_TRUE(has(found(with(plan, "probe_stylus_mm", ""), text), "CHK-PROBE-WAY"));
  for (const char* option : {"probe_feed_mm_min", "probe_way_mm_min", "probe_overtravel_mm"})
    EXPECT_TRUE(has(found(with(plan, option, ""), text), "CHK-PROBE-CALL")) << option;
  model::Plan other = plan;
  other.cutters.back().functional_length_mm = 0.0;
  EXPECT_TRUE(has(found(other, text), "CHK-PROBE-CALL"));
  EXPECT_TRUE(
      has(found(plan, text, replaced(controls::tool_table_of(plan), "T20 P20", ";")), "CHK-PROBE-CALL"));
  EXPECT_TRUE(has(found(plan, replaced(text, "T2 M6\n", "")), "CHK-PROBE-CALL"));
}

TEST(ProbeMoves, WithoutThePlanNothingIsProvenOfThem) {
  const model::Plan plan = moved({kTop}, "linuxcnc");
  Job job;
  bool unproved = false;
  for (const auto& f : verify::check_program({"a.ngc", text_of(plan), controls::tool_table_of(plan)}, nullptr,
                                             plan.machine, plan.cutters, job)) {
    EXPECT_NE(f.severity, Severity::kError) << f.code << " " << f.message;
    unproved = unproved || (f.code == "CHK-PROBE-WAY" && f.unproved);
  }
  EXPECT_TRUE(unproved);
}

}  // namespace
}  // namespace capstan::mutation
