#include "planner/proof/verify/program/linuxcnc/reader.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <string>

namespace capstan::verify::linuxcnc {
namespace {

// LinuxCNC 2.9, interp_cycles.cc, convert_cycle_g86: feed, dwell, the spindle stops, rapid, it starts again.
TEST(LinuxCncCycles, G86WaitsAtTheBottomAndComesOutWithTheSpindleStopped) {
  const Program p = read_program(
      "G21 G17 G90 G94 G40 G80\nG54\nT1 M6\nG43 H1\nS1000 M3\nG0 X5 Y6\nG0 Z10\n"
      "G98 G86 X5 Y6 Z-8 R2 P0.4 F100\nG80\nM2\n",
      "", "");
  const auto wait = std::find_if(p.blocks.begin(), p.blocks.end(),
                                 [](const Block& b) { return b.kind == Block::Kind::kDwell; });
  ASSERT_NE(wait, p.blocks.end());
  EXPECT_EQ(wait->dwell_s, 0.4);
  const auto out = wait + 1;
  ASSERT_NE(out, p.blocks.end());
  EXPECT_EQ(out->move, model::MoveKind::kRapid);
  EXPECT_EQ(out->from.z, -8.0);
  EXPECT_EQ(out->spindle_rpm, 0.0);
}

// 9.9 mm in pecks of 3.3, and 14.4 in pecks of 4.8, are three each, whatever the sums round to.
TEST(LinuxCncCycles, PecksThatDivideTheDepthAreNotOneMoreByRounding) {
  for (const char* hole : {"Z-7.9 R2 Q3.3", "Z-13.4 R1 Q4.8"}) {
    for (const char* mode : {"G83", "G73"}) {
      const Program p =
          read_program("G21 G17 G90 G94 G40 G80\nG54\nT1 M6\nG43 H1\nS1000 M3\nG0 X5 Y6\nG0 Z10\nG98 " +
                           std::string(mode) + " X5 Y6 " + hole + " F100\nG80\nM2\n",
                       "", "");
      EXPECT_EQ(std::count_if(p.blocks.begin(), p.blocks.end(),
                              [](const Block& b) {
                                return b.kind == Block::Kind::kMove && b.move == model::MoveKind::kLine;
                              }),
                3)
          << mode << " " << hole;
    }
  }
}

// Where it ended the program does not say.
TEST(LinuxCncProbing, G382EndsAtATouchWhoseAxisIsNotKnownBehindIt) {
  const auto read = [](const std::string& block) {
    return read_program("G21 G17 G90 G94 G40 G80\nG54\nT1 M6\nG43 H1\nG0 X5 Y6\nG0 Z10\n" + block + "M2\n",
                        "", "");
  };
  const Program p = read("G38.2 Z-2 F100\nG1 X9\n");
  EXPECT_TRUE(p.faults.empty()) << p.faults.front().message;
  const auto probes = std::find_if(p.blocks.begin(), p.blocks.end(), [](const Block& b) { return b.probes; });
  ASSERT_NE(probes, p.blocks.end());
  EXPECT_EQ(probes->to.z, -2.0);
  EXPECT_EQ(probes->feed_mm_min, 100.0);
  const Block& behind = *(probes + 1);
  EXPECT_FALSE(behind.known_from[2]);
  EXPECT_TRUE(behind.known_from[0]);
  for (const char* block : {"G38.2 F100\n", "G38.3 Z-2 F100\n", "G31 Z-2 F100\n", "G38.2 G1 Z-2 F100\n"})
    EXPECT_FALSE(read(block).faults.empty()) << block;
}

}  // namespace
}  // namespace capstan::verify::linuxcnc
