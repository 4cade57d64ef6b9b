#include <gtest/gtest.h>

#include <set>

#include "tests/door/pipeline/block.h"

// Levels of what is milled through: those that the cut was chosen for, the overrun below the bottom
// among them.

namespace capstan::pipeline {
namespace {

using namespace block;

TEST(ThroughLevels, AreThoseOfTheDepthWithTheOverrun) {
  // Round a cylinder of 50 mm, through the block of 20 mm; cut 1 mm below it.
  const Planned p =
      bound(read("#60=PLUS_MINUS_VALUE(0.1,0.1,3);\n#61=TOLERANCED_LENGTH_MEASURE(20.,#60);\n"
                 "#62=CARTESIAN_POINT('',(0.,0.,-20.));\n#63=AXIS2_PLACEMENT_3D('',#62,#21,#22);\n"
                 "#64=PLANE('',#63);\n#65=DIRECTION('',(0.,0.,-1.));\n#66=LINEAR_PATH($,#61,#65);\n"
                 "#67=THROUGH_PROFILE_FLOOR();\n#68=TOLERANCED_LENGTH_MEASURE(50.,#60);\n"
                 "#69=CIRCULAR_CLOSED_PROFILE($,#68);\n"
                 "#70=CIRCULAR_CLOSED_SHAPE_PROFILE('O',#4,(),#50,#64,#66,#67,#21,#69);\n"));
  ASSERT_EQ(p.plan.steps.size(), 2U) << p.said;  // roughed, finished
  constexpr double kDepth = 21.0;
  for (const auto& s : p.plan.steps) {
    std::set<double> heights;
    for (std::size_t i = 0; s.path && i < s.path->size(); ++i) {
      if (s.path->role[i] == model::MoveRole::kCut) heights.insert(s.path->z[i]);
    }
    ASSERT_FALSE(heights.empty()) << p.said;
    EXPECT_NEAR(*heights.begin(), -kDepth, 1e-6) << p.said;
    EXPECT_NEAR(static_cast<double>(heights.size()) * s.axial_depth_mm, kDepth, 1e-3) << p.said;
  }
}

}  // namespace
}  // namespace capstan::pipeline
