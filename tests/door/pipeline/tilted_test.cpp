#include <gtest/gtest.h>

#include <string>

#include "tests/door/pipeline/block.h"

// Features whose axes lean a little.

namespace capstan::pipeline {
namespace {

/// An upright hole, and one whose axis has this x (of a direction whose z is 1).
std::string two_holes(const std::string& leaning) {
  return "#60=DIRECTION('',(" + leaning +
         ",0.,1.));\n#61=TOLERANCED_LENGTH_MEASURE(8.,$);\n#63=ROUND_HOLE('H1',#4,(),#50,#53,#61,$,#67);\n"
         "#64=CARTESIAN_POINT('',(20.,20.,0.));\n#65=AXIS2_PLACEMENT_3D('',#64,#60,$);\n"
         "#66=ROUND_HOLE('H2',#4,(),#65,#53,#61,$,#67);\n#67=FLAT_HOLE_BOTTOM();\n";
}

std::size_t count(const std::string& text, const std::string& part) {
  std::size_t n = 0;
  for (auto at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) ++n;
  return n;
}

TEST(Tilted, ATiltThatIsHardlyMeantIsToldOnceWithItsAngle) {
  const auto made = block::bound(block::read(two_holes("0.001047")));
  EXPECT_EQ(made.plan.setups.size(), 2U) << made.said;
  EXPECT_EQ(count(made.said, "[PIP-TILT]"), 1U) << made.said;
  EXPECT_NE(made.said.find("feature 'H2': its axis is tilted by 0.06 degrees against set-up 'SETUP1'"),
            std::string::npos)
      << made.said;
  EXPECT_NE(made.said.find("below 0.5 degrees"), std::string::npos) << made.said;
}

TEST(Tilted, UprightAxesAndTiltsThatAreMeantAreNotToldOf) {
  for (const char* leaning : {"0.", "0.0000001", "0.1"}) {
    const auto made = block::bound(block::read(two_holes(leaning)));
    EXPECT_EQ(count(made.said, "[PIP-TILT]"), 0U) << leaning << "\n" << made.said;
  }
}

}  // namespace
}  // namespace capstan::pipeline
