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

}  // namespace
}  // namespace capstan::verify::linuxcnc
