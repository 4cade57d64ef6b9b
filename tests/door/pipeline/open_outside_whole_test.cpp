#include <gtest/gtest.h>

#include "planner/making/step/cut_samples.h"
#include "planner/proof/verify/verify.h"
#include "tests/door/pipeline/block.h"

// Open outside profiles wider than a cutter takes in one pass are planned whole, wall and floor.

namespace capstan::pipeline {
namespace {

using namespace block;

TEST(OpenOutside, IsPlannedWholeWhereItIsWiderThanOnePass) {
  // Below the line y = 28 to 36, which bends round what stays, 5 mm deep.
  const Planned p =
      bound(read("#60=PLUS_MINUS_VALUE(0.07,0.07,3);\n#61=TOLERANCED_LENGTH_MEASURE(5.,#60);\n"
                 "#62=CARTESIAN_POINT('',(0.,36.,0.));\n#63=CARTESIAN_POINT('',(30.,28.,0.));\n"
                 "#64=CARTESIAN_POINT('',(70.,28.,0.));\n#65=CARTESIAN_POINT('',(100.,36.,0.));\n"
                 "#66=POLYLINE('',(#62,#63,#64,#65));\n#67=GENERAL_PROFILE($,#66);\n"
                 "#68=DIRECTION('',(0.,0.,-1.));\n#69=LINEAR_PATH($,#61,#68);\n"
                 "#70=GENERAL_OUTSIDE_PROFILE('O',#4,(),#28,#53,#69,#67);\n"));
  EXPECT_TRUE(p.plan.unplanned.empty()) << p.said;
  ASSERT_EQ(p.plan.steps.size(), 2U) << p.said;  // roughed, finished
  Job job;
  for (const auto& f : findings_of(p.plan, job)) EXPECT_NE(f.code, "CHK-LEFT") << f.message;
}

}  // namespace
}  // namespace capstan::pipeline
