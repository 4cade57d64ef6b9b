#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/removal/simulation/compare.h"
#include "tests/support/rs274.h"

// The simulation is held against programs written by hand, right and wrong, so that its silence means
// something.

namespace capstan::testing::removal {
namespace {

using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::SizeIs;

// A block of 40 x 30 x 12 mm with a slot 10 mm wide, 4 mm deep along x at y = 10, a pocket of 12 x 12 mm,
// corners R3, 5 mm deep about (30, 23), and a drilled hole of 6 mm through at (8, 23).
const Box kBlock{{0, 0, -12}, {40, 30, 0}};
constexpr const char* kTable = "T1 P1 Z+60 D+10\nT2 P2 Z+70 D+6\nT3 P3 Z+80.5 D+6\n";
constexpr const char* kHead = "G21 G17 G90 G94 G40 G49 G80\nG53 G0 Z250\n";

std::map<int, CutterBody> tools() {
  std::map<int, CutterBody> out;
  out.emplace(1, CutterBody({{0, 5}, {20, 5}}, {{20, 5}, {30, 5}, {30, 20}, {60, 20}}));
  out.emplace(2, CutterBody({{0, 3}, {12, 3}}, {{12, 3}, {22, 3}, {22, 20}, {60, 20}}));
  out.emplace(3, CutterBody({{0, 0}, {1.8026, 3}, {40, 3}}, {}));  // 118 degrees
  return out;
}

Target target() {
  Target t(box(kBlock.lo, kBlock.hi));
  t.cut(along({-1, 10, 0}, {41, 10, 0}, rectangle(-5, -4, 5, 1)));
  t.cut(prism(rounded_rectangle(24, 17, 36, 29, 3), -5, 1));
  t.cut(cylinder(8, 23, 3, -13, 1));
  return t;
}

std::string step(int n, int tool) {
  const std::string t = std::to_string(tool);
  return "(CAPSTAN STEP id=\"step%20" + std::to_string(n) + "\" n=" + std::to_string(n) + " tool=" + t +
         " setup=1)\nG53 G0 Z250\nG54\nT" + t + " M6\nG43 H" + t + "\nS3000 M3\n";
}
const std::string kSlot = step(1, 1) + "G0 X-7 Y10\nG0 Z5\nG0 Z-4\nG1 X47 F500\nG0 Z5\n";
std::string pocket(const std::string& depth, const std::string& right = "33") {
  return step(2, 2) + "G0 X30 Y23\nG0 Z2\nG1 Z-" + depth + " F100\nG1 X27 Y20 F300\nG1 X" + right +
         "\nG1 Y26\n" + "G1 X27\nG1 Y20\nG0 Z5\n";
}
std::string hole(const std::string& x) {
  return step(3, 3) + "G0 X" + x + " Y23\nG0 Z2\nG1 Z-15 F100\nG0 Z5\n";
}

Verdict run(const std::string& text) {
  const Motions motions = read_motions(std::string(kHead) + text + "G53 G0 Z250\nM2\n", kTable);
  return simulate(motions, tools(), {{1, Frame{}}}, kBlock, target(), {0.3, 0.1, 0.1});
}

TEST(RemovalSimulation, FindsNothingWrongWithAProgramThatMakesThePart) {
  CAPSTAN_NEEDS_RS274();
  const Verdict v = run(kSlot + pocket("5") + hole("8"));
  EXPECT_TRUE(v.agrees()) << v.text();
  EXPECT_EQ(v.steps, 3U);
}

TEST(RemovalSimulation, FindsAMovedHole) {
  CAPSTAN_NEEDS_RS274();
  const Verdict v = run(kSlot + pocket("5") + hole("9"));
  ASSERT_THAT(v.gouges, SizeIs(1)) << v.text();
  EXPECT_THAT(v.gouges[0], HasSubstr("step%203"));
  EXPECT_THAT(v.left, SizeIs(1)) << v.text();
}

TEST(RemovalSimulation, FindsAPocketThatIsTooDeep) {
  CAPSTAN_NEEDS_RS274();
  const Verdict v = run(kSlot + pocket("5.4") + hole("8"));
  ASSERT_THAT(v.gouges, SizeIs(1)) << v.text();
  EXPECT_THAT(v.gouges[0], HasSubstr("step%202"));
  EXPECT_THAT(v.left, IsEmpty());
}

TEST(RemovalSimulation, FindsAPocketThatIsNotDeepEnough) {
  CAPSTAN_NEEDS_RS274();
  const Verdict v = run(kSlot + pocket("4.6") + hole("8"));
  EXPECT_THAT(v.gouges, IsEmpty());
  EXPECT_THAT(v.left, SizeIs(1)) << v.text();
}

TEST(RemovalSimulation, FindsASkippedStep) {
  CAPSTAN_NEEDS_RS274();
  const Verdict v = run(kSlot + step(2, 2) + hole("8"));
  EXPECT_THAT(v.left, SizeIs(1)) << v.text();
  ASSERT_THAT(v.idle, SizeIs(1)) << v.text();
  EXPECT_THAT(v.idle[0], HasSubstr("step%202"));
}

TEST(RemovalSimulation, FindsAnUnsweptCorner) {
  CAPSTAN_NEEDS_RS274();
  // The corner at (36, 29) is cut off along a chord, the rest is right.
  const Verdict v = run(kSlot + step(2, 2) +
                        "G0 X30 Y23\nG0 Z2\nG1 Z-5 F100\nG1 X27 Y20 F300\nG1 X33\nG1 Y24.5\nG1 X31.5 Y26\n"
                        "G1 X27\nG1 Y20\nG0 Z5\n" +
                        hole("8"));
  ASSERT_THAT(v.left, SizeIs(1)) << v.text();
  EXPECT_THAT(v.gouges, IsEmpty());
}

TEST(RemovalSimulation, FindsAStepThatCutsNothing) {
  CAPSTAN_NEEDS_RS274();
  const Verdict v = run(kSlot + pocket("5") + hole("8") + step(4, 3) + "G0 X8 Y23\nG1 Z-14 F100\nG0 Z5\n");
  EXPECT_THAT(v.gouges, IsEmpty());
  ASSERT_THAT(v.idle, SizeIs(1)) << v.text();
  EXPECT_THAT(v.idle[0], HasSubstr("step%204"));
}

TEST(RemovalSimulation, FindsARapidThroughMaterial) {
  CAPSTAN_NEEDS_RS274();
  const Verdict v = run(kSlot + step(3, 3) + "G0 X8 Y23\nG0 Z-15\nG0 Z5\n" + pocket("5"));
  ASSERT_THAT(v.rapids, SizeIs(1)) << v.text();
  EXPECT_THAT(v.rapids[0], HasSubstr("step%203"));
}

TEST(RemovalSimulation, FindsAShankInMaterial) {
  CAPSTAN_NEEDS_RS274();
  auto t = tools();
  t.erase(2);  // two millimetres of edges on a shank as wide: the pocket is cut with the shank
  t.emplace(2, CutterBody({{0, 3}, {2, 3}}, {{2, 3.4}, {22, 3.4}}));
  const Motions motions = read_motions(std::string(kHead) + kSlot + pocket("5") + hole("8") + "M2\n", kTable);
  const Verdict v = simulate(motions, t, {{1, Frame{}}}, kBlock, target(), {0.3, 0.1, 0.1});
  EXPECT_THAT(v.rubs, SizeIs(1)) << v.text();
  EXPECT_THAT(v.gouges, SizeIs(1)) << v.text();
}

TEST(RemovalSimulation, FindsTheLengthOfAnotherTool) {
  CAPSTAN_NEEDS_RS274();
  std::string wrong = hole("8");
  wrong.replace(wrong.find("G43 H3"), 6, "G43 H2");
  // T3 is 10.5 mm longer than T2: the tip is that much lower.
  const Verdict v = run(kSlot + pocket("5") + wrong);
  EXPECT_FALSE(v.rapids.empty() && v.gouges.empty()) << v.text();
}

TEST(RemovalSimulation, HoldsUndercuts) {
  CAPSTAN_NEEDS_RS274();
  // A disc of 16 mm, 3 mm high on a neck of 8 mm runs in the slot: what stands over it stays.
  auto t = tools();
  t.erase(1);
  t.emplace(1, CutterBody({{0, 5}, {20, 5}}, {}));
  t.emplace(4, CutterBody({{0, 8}, {3, 8}}, {{3, 4}, {30, 4}}));
  const std::string table = std::string(kTable) + "T4 P4 Z+60 D+16\n";
  const std::string deep = step(1, 1) + "G0 X-7 Y10\nG0 Z-9\nG1 X47 F500\nG0 Z5\n";
  const std::string tee = step(2, 4) + "G0 X-10 Y10\nG0 Z-9\nG1 X50 F300\nG0 Z5\n";
  const Motions motions = read_motions(std::string(kHead) + deep + tee + "M2\n", table);
  Target wanted(box(kBlock.lo, kBlock.hi));
  wanted.cut(along({-1, 10, 0}, {41, 10, 0}, rectangle(-5, -9, 5, 1)));
  Target missing = wanted;
  wanted.cut(along({-1, 10, 0}, {41, 10, 0}, rectangle(-8, -9, 8, -6)));
  const Grid grid{0.3, 0.1, 0.1};
  const Verdict right = simulate(motions, t, {{1, Frame{}}}, kBlock, wanted, grid);
  EXPECT_TRUE(right.agrees()) << right.text();
  const Verdict wrong = simulate(motions, t, {{1, Frame{}}}, kBlock, missing, grid);
  EXPECT_THAT(wrong.gouges, SizeIs(1)) << wrong.text();
}

TEST(RemovalSimulation, CutsFromTheOtherSideAfterTurningThePieceOver) {
  CAPSTAN_NEEDS_RS274();
  // Turned about x: what is programmed at (8, 7) from the underside lies at (8, 23).
  Frame over;
  over.origin = {0, 30, -12};
  over.axis = {1, -2, -3};
  std::string text = hole("8");
  text.replace(text.find("Y23"), 3, "Y7");
  text.replace(text.find("setup=1"), 7, "setup=2");
  const Motions motions = read_motions(std::string(kHead) + kSlot + pocket("5") + text + "M2\n", kTable);
  const Verdict v = simulate(motions, tools(), {{1, Frame{}}, {2, over}}, kBlock, target(), {0.3, 0.1, 0.1});
  EXPECT_TRUE(v.agrees()) << v.text();
}

TEST(RemovalSimulation, ReadsAWholeCircleAndAHelix) {
  CAPSTAN_NEEDS_RS274();
  // A hole of 14 mm, 3 mm deep about (20, 20): a helix of radius 4 by the 6 mm mill, then a turn on the
  // floor.
  const std::string text = step(1, 2) +
                           "G0 X24 Y20\nG0 Z1\nG1 Z0 F100\nG3 X24 Y20 Z-1.5 I-4 J0\nG3 X24 Y20 Z-3 I-4 J0\n"
                           "G3 X24 Y20 I-4 J0\nG1 X20 Y20\nG1 X21\nG3 X21 Y20 I-1 J0\nG0 Z5\n";
  const Motions motions = read_motions(std::string(kHead) + text + "M2\n", kTable);
  Target wanted(box(kBlock.lo, kBlock.hi));
  wanted.cut(cylinder(20, 20, 7, -3, 1));
  const Verdict v = simulate(motions, tools(), {{1, Frame{}}}, kBlock, wanted, {0.3, 0.1, 0.1});
  EXPECT_TRUE(v.agrees()) << v.text();
}

}  // namespace
}  // namespace capstan::testing::removal
