#include <gtest/gtest.h>

#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "tests/mutation/controls/touched.h"

// Touches that the machine's macro makes: written where their way is clear, read back, and held to it.

namespace capstan::mutation {
namespace {

using namespace touched;

constexpr const char* kMacro = "G65 P9810 X{x} Y{y} Z{z} | G65 P9811 {axis}{nominal} T{probe}";

/// By the macro of the shop.
model::Plan measured(const Touched& t, const std::string& dialect,
                     std::vector<model::ControlOption> more = {}) {
  more.push_back({"probe_macro", kMacro});
  return touched::measured({t}, dialect, std::move(more));
}

TEST(ProbeMacro, ATouchWhoseWayIsClearIsMadeByTheMachinesMacroAndTheStopStays) {
  for (const char* dialect : {"fanuc", "haas", "siemens"}) {
    const model::Plan plan = measured(kTop, dialect, kProbe);
    const std::string text = text_of(plan);
    const bool points = std::string(dialect) != "siemens";
    const std::string macro = points ? "\nG65 P9810 X80. Y80. Z8.\nG65 P9811 Z0. T20\n"
                                     : "\nG65 P9810 X80 Y80 Z8\nG65 P9811 Z0 T20\n";
    EXPECT_TRUE(has(text, macro)) << text;
    const std::size_t at = text.find(macro);
    EXPECT_LT(at, text.find("\nM0\n", at)) << "it stops behind it";
    EXPECT_EQ(found(plan, text), "") << text;
  }
}

TEST(ProbeMacro, BesideThePieceTheStylusGoesDownWhereTheProbeStaysAbove) {
  const Touched side{{110, 50, -5}, {-1, 0, 0}, 7.0};
  const model::Plan plan = measured(side, "fanuc", kProbe);
  const std::string text = text_of(plan);
  EXPECT_TRUE(has(text, "\nG65 P9810 X110. Y50. Z-5.\nG65 P9811 X100. T20\n")) << text;
  EXPECT_EQ(found(plan, text), "");
  const model::Plan tight = measured(side, "fanuc", {{"probe_radius_mm", "25"}, {"probe_stylus_mm", "4"}});
  EXPECT_FALSE(has(text_of(tight), "G65"));
  EXPECT_NE(found(tight, text).find("CHK-PROBE-WAY"), std::string::npos);
}

TEST(ProbeMacro, WhatIsNotProvenClearStaysAStopThatSaysWhy) {
  const auto says = [](const Touched& t, std::vector<model::ControlOption> more, const char* why) {
    const model::Plan plan = measured(t, "haas", std::move(more));
    const std::string text = text_of(plan);
    EXPECT_FALSE(has(text, "G65")) << text;
    EXPECT_TRUE(has(text, why)) << why << "\n" << text;
    EXPECT_EQ(found(plan, text), "");
  };
  says({{50, 50, -5}, {1, 0, 0}, 17.0}, kProbe,
       "by hand, not by the macro: its way is not proven clear of the piece");
  says({{50, -4, -30}, {0, 1, 0}, 3.0}, kProbe,
       "by hand, not by the macro: its way is not proven clear of the piece");
  says(kTop, {}, "probe_radius_mm");
  says({{80, 80, 8}, {0, 0.6, -0.8}, 5.0}, kProbe, "along no axis");
  // Down to where the jaw stands: 5 mm of its height and 2 of clearance.
  says({{50, -20, -41}, {0, 1, 0}, 17.0}, {{"probe_radius_mm", "5"}, {"probe_stylus_mm", "100"}},
       "clear of jaw");
}

// Without its point X12 is 0.012 mm on one machine and 12 mm on another: FANUC parameter 3401, Haas settings
// 77 and 162. A Siemens counts millimetres, and zero is zero.
TEST(ProbeMacro, APlaceWithoutADecimalPointIsFoundWhereAControlMayCountThousandths) {
  const Touched at{{12, 80, 8}, {0, 0, -1}, 5.0};
  for (const char* dialect : {"fanuc", "haas"}) {
    const model::Plan plan = measured(at, dialect, kProbe);
    const std::string text = text_of(plan);
    const std::string call = "G65 P9810 X12. Y80. Z8.\nG65 P9811 Z0. T20\n";
    ASSERT_EQ(found(plan, text), "") << text;
    for (const char* other :
         {"G65 P9810 X12 Y80. Z8.\nG65 P9811 Z0. T20\n", "G65 P9810 X12. Y80 Z8.\nG65 P9811 Z0. T20\n",
          "G65 P9810 X12. Y80. Z8\nG65 P9811 Z0. T20\n"})
      EXPECT_NE(found(plan, replaced(text, call, other)), "") << dialect << " " << other;
    EXPECT_EQ(found(plan, replaced(text, call, "G65 P9810 X12.0 Y80. Z8.\nG65 P9811 Z0 T20\n")), "");
  }
  const model::Plan siemens = measured(at, "siemens", kProbe);
  const std::string text = text_of(siemens);
  EXPECT_TRUE(has(text, "G65 P9810 X12 Y80 Z8\n")) << text;
  EXPECT_EQ(found(siemens, text), "");
}

TEST(ProbeMacro, AMacroElsewhereOrOtherwiseIsFound) {
  const model::Plan plan = measured(kTop, "fanuc", kProbe);
  const std::string text = text_of(plan);
  const std::string macro = "G65 P9810 X80. Y80. Z8.\nG65 P9811 Z0. T20\n";
  ASSERT_EQ(found(plan, text), "");
  for (const auto& [from, to] : {std::pair{"X80. Y80. Z8.", "X80. Y80.01 Z8."},
                                 std::pair{"Z8.\nG65", "Z6.\nG65"}, std::pair{"P9811 Z0.", "P9811 Z-2."},
                                 std::pair{"P9811 Z0.", "P9811 X0."}, std::pair{"Z0. T20", "Z0. T2"}})
    EXPECT_NE(found(plan, replaced(text, from, to)), "") << to;
  const std::string without = replaced(text, macro, "");
  EXPECT_EQ(found(plan, without), "") << "by hand";
  EXPECT_NE(found(plan, replaced(text, macro, macro + macro)), "") << "twice";
  EXPECT_TRUE(has(found(plan, replaced(without, "\nM30", "\n" + macro + "M30")), "CHK-PROBE-CALL"));
  // Before the tool is away; and without going there again behind it.
  const std::string away = "G0 G49 G53 Z0.\nM5\nM9\n";
  EXPECT_NE(found(plan, replaced(text, macro + away, macro)), "");
  EXPECT_TRUE(has(found(plan, replaced(text, "T2 M6\n", "")), "CHK-PROBE-CALL"));
}

// Numbers alone stand in front of a Heidenhain's blocks, and go on where the macro's were.
TEST(ProbeMacro, AHeidenhainTouchesByItsOwnLanguage) {
  std::vector<model::ControlOption> options = kProbe;
  options.push_back({"probe_macro",
                     "TOOL CALL {probe} Z | L X{x} Y{y} R0 FMAX | L Z{security} R0 FMAX | L Z{z} R0 F2000 | "
                     "TCH PROBE 0.0 REF. PLANE Q5 {axis}{sign} | TCH PROBE 0.1 X{x} Y{y} Z{z} | L "
                     "Z{security} R0 FMAX"});
  const model::Plan plan = touched::measured({kTop}, "heidenhain", options);
  const std::string text = text_of(plan);
  for (const char* block :
       {" TOOL CALL 20 Z\n", " L X80 Y80 R0 FMAX\n", " L Z10 R0 FMAX\n", " L Z8 R0 F2000\n",
        " TCH PROBE 0.0 REF. PLANE Q5 Z-\n", " TCH PROBE 0.1 X80 Y80 Z8\n"})
    EXPECT_TRUE(has(text, block)) << block << "\n" << text;
  EXPECT_EQ(found(plan, text), "") << text;
  for (const auto& [from, to] :
       {std::pair{"Q5 Z-", "Q5 Z+"}, std::pair{"Q5 Z-", "Q5 X-"},
        std::pair{"0.1 X80 Y80 Z8", "0.1 X80 Y80 Z6"}, std::pair{"TOOL CALL 20 Z", "TOOL CALL 2 Z"},
        std::pair{"L Z8 R0 F2000", "L Z-8 R0 F2000"}})
    EXPECT_NE(found(plan, replaced(text, from, to)), "") << to;
}

TEST(ProbeMacro, AShippedOneIsWrittenOnlyWhereTheShopHasConfirmedIt) {
  for (const auto& [dialect, id, call] :
       {std::tuple("fanuc", "renishaw_9811", "\nG65 P9811 Z0.\n"),
        std::tuple("haas", "renishaw_9811", "\nG65 P9810 Z8. F3000.\nG65 P9811 Z0.\n"),
        std::tuple("siemens", "siemens_cycle978",
                   "\nG1 Z8 F2000\nCYCLE978(0,,,1,0,5,5,3,2,1,\"\",,0,1.01,1.01,-1.01,,,,,1,1)\nG0 Z10\n"),
        std::tuple("heidenhain", "tch_probe_0", " TCH PROBE 0.0 REF. PLANE Q5 Z-\n")}) {
    std::vector<model::ControlOption> options = kProbe;
    options.push_back({"probe_macro", id});
    const model::Plan before = touched::measured({kTop}, dialect, options);
    const std::string unsaid = text_of(before);
    EXPECT_FALSE(has(unsaid, call)) << unsaid;
    EXPECT_TRUE(has(unsaid, "confirmed") || has(unsaid, "CONFIRMED")) << unsaid;
    EXPECT_EQ(found(before, unsaid), "");
    options.push_back({"probe_macro_confirmed", "yes"});
    const model::Plan plan = touched::measured({kTop}, dialect, options);
    const std::string text = text_of(plan);
    EXPECT_TRUE(has(text, call)) << text;
    EXPECT_EQ(found(plan, text), "") << text;
    EXPECT_NE(found(before, text), "") << "not confirmed";
  }
}

}  // namespace
}  // namespace capstan::mutation
