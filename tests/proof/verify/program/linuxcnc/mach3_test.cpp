#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

#include "planner/ground/base/number.h"
#include "planner/proof/verify/program/linuxcnc/reader.h"
#include "tests/proof/verify/plans.h"

// What Mach3 makes of blocks, where that is another thing than LinuxCNC makes of them.

namespace capstan::verify::linuxcnc {
namespace {

Program read(const std::string& body, std::vector<model::ControlOption> options = {},
             const std::string& arcs = " G91.1") {
  model::Machine m = testing::machine();
  m.control.dialect = "mach3";
  m.control.path_tolerance_mm = 0.02;
  m.control_options = model::ControlOptions{std::move(options)};
  return read_mach3("G21 G17 G90" + arcs +
                        " G94 G40 G49 G80\nG54\nT1 M6\nG43 H1\nS1000 M3\nG0 X5 Y6\nG0 Z20\n" + body + "M30\n",
                    m);
}
bool finds(const Program& p, const std::string& code) {
  return std::any_of(p.faults.begin(), p.faults.end(), [&](const auto& f) { return f.code == code; });
}
std::string faults(const Program& p) {
  std::string out;
  for (const auto& f : p.faults) out += f.code + " " + f.message + "\n";
  return out;
}

TEST(Mach3Reader, ConstantVelocityRoundsAsTheMachinesFileSaysAndTakesNoP) {
  const Program p = read("G64\nG1 X9 F100\n");
  EXPECT_EQ(faults(p), "");
  EXPECT_EQ((p.blocks.end() - 2)->tolerance_mm, 0.02);
  EXPECT_TRUE(finds(read("G64 P0.05\n"), "CHK-WORD"));
  // Nor where the motion that goes on has a P or Q of its own elsewhere.
  const std::string arc = "G91.1\nG1 X0 Y0 Z0 F100\nG2 X2 Y0 I1 J0\n",
                    cycle = "G98\nG82 X1 Y1 Z-1 R1 P0.5 F50\n";
  for (const std::string& before : {arc, cycle}) {
    EXPECT_FALSE(finds(read(before + "G64\n"), "CHK-WORD")) << before;
    EXPECT_TRUE(finds(read(before + "G64 P0.05\n"), "CHK-WORD")) << before;
  }
}

TEST(Mach3Reader, PCountsAsTheSettingSays) {
  const auto waits = [](const Program& p) {
    const auto at = std::find_if(p.blocks.begin(), p.blocks.end(),
                                 [](const Block& b) { return b.kind == Block::Kind::kDwell; });
    return at == p.blocks.end() ? -1.0 : at->dwell_s;
  };
  EXPECT_EQ(waits(read("G4 P500\n")), 500.0);
  EXPECT_EQ(waits(read("G4 P500\n", {{"dwell", "milliseconds"}})), 0.5);
  EXPECT_EQ(waits(read("G98 G82 X5 Y6 Z-8 R2 P250 F100\nG80\n", {{"dwell", "milliseconds"}})), 0.25);
}

TEST(Mach3Reader, ACentreBeforeTheProgramSaysHowItCountsIsAFault) {
  EXPECT_FALSE(finds(read("G1 X5 F100\nG2 X7 Y6 I1 J0\n"), "CHK-ARC"));
  EXPECT_TRUE(finds(read("G1 X5 F100\nG2 X7 Y6 I1 J0\n", {}, ""), "CHK-ARC"));
  EXPECT_FALSE(finds(read("G1 X5 F100\nG90.1\nG2 X7 Y6 I6 J6\n", {}, ""), "CHK-ARC"));
}

// NIST RS274/NGC 3, G85 and G89: at feed to clear Z.
TEST(Mach3Reader, AReamerComesOutAtFeedToWhereTheCycleEnds) {
  const Program p = read("G98 G85 X5 Y6 Z-8 R2 F100\nG80\n");
  EXPECT_EQ(faults(p), "");
  const auto out = std::find_if(p.blocks.begin(), p.blocks.end(), [](const Block& b) {
    return b.kind == Block::Kind::kMove && b.from.z == -8.0;
  });
  ASSERT_NE(out, p.blocks.end());
  EXPECT_EQ(out->move, model::MoveKind::kLine);
  EXPECT_EQ(out->to.z, 20.0);
}

TEST(Mach3Reader, WhatIsLinuxCncsAloneOrASettingIsAFault) {
  for (const char* block :
       {"G38.2 Z-5 F50\n", "G59.1\n", "G61.1\n", "G33.1 Z-5 K1\n", "M60\n", "G43.1 Z50\n"})
    EXPECT_TRUE(finds(read(block), "CHK-CODE")) << block;
  EXPECT_TRUE(finds(read("M55\n"), "CHK-CODE"));
  EXPECT_EQ(faults(read("M55\n", {{"shop_codes", "M55"}})), "");
  EXPECT_TRUE(finds(read("M98\n", {{"shop_codes", "M98"}}), "CHK-UNVERIFIABLE"));
  EXPECT_TRUE(finds(read("G1 X9 F100 ; a comment\n"), "CHK-SYNTAX"));
  EXPECT_TRUE(finds(read("G98 G83 X5 Y6 Z-8 R2 Q3 F100\nG80\n"), "CHK-UNVERIFIABLE"));
  EXPECT_TRUE(finds(read("G98 G84 X5 Y6 Z-8 R2 F100\nG80\n"), "CHK-TAP-FEED"));
}

TEST(Mach3Reader, NamesTheControlThatRefuses) {
  const std::string said = faults(read("G1 X9 F100 N5\n"));
  EXPECT_NE(said.find("Mach3 reads it"), std::string::npos) << said;
  EXPECT_EQ(said.find("LinuxCNC"), std::string::npos) << said;
}

TEST(Mach3Reader, G31EndsAtATouch) {
  const Program p = read("G31 Z-2 F100\n");
  EXPECT_EQ(faults(p), "");
  EXPECT_TRUE(std::any_of(p.blocks.begin(), p.blocks.end(), [](const Block& b) { return b.probes; }));
  EXPECT_TRUE(finds(read("G31 F100\n"), "CHK-WORD"));
}

}  // namespace
}  // namespace capstan::verify::linuxcnc
