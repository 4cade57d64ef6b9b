#include <gtest/gtest.h>

#include <numbers>

#include "tests/door/pipeline/block.h"

// A countersink cuts by as much of its cone as the hole is wide.

namespace capstan::pipeline {
namespace {

using namespace block;

TEST(Countersunk, IsCutByASmallToolAtTheSpeedAndTorqueOfTheConesWidth) {
  // 90 degrees, 13 mm wide, over 6.6 mm through.
  const Planned p =
      bound(read("#60=PLUS_MINUS_VALUE(0.2,0.2,3);\n#61=TOLERANCED_LENGTH_MEASURE(6.6,#60);\n"
                 "#62=CARTESIAN_POINT('',(0.,0.,-3.2));\n#63=AXIS2_PLACEMENT_3D('',#62,#21,#22);\n"
                 "#64=PLANE('',#63);\n#65=PLUS_MINUS_VALUE(0.3,0.3,3);\n"
                 "#66=TOLERANCED_LENGTH_MEASURE(13.,#65);\n#67=DIAMETER_TAPER(#61);\n"
                 "#68=ROUND_HOLE('CONE',#4,(),#28,#64,#66,#67,#58);\n"
                 "#69=CARTESIAN_POINT('',(0.,0.,-16.8));\n#70=AXIS2_PLACEMENT_3D('',#69,#21,#22);\n"
                 "#71=PLANE('',#70);\n#72=TOLERANCED_LENGTH_MEASURE(6.6,#60);\n"
                 "#73=ROUND_HOLE('HOLE',#4,(),#63,#71,#72,$,#58);\n"
                 "#74=COUNTERSUNK_HOLE('SUNK',#4,(),#50,(#68,#73));\n"));
  const model::StepResult* sunk = nullptr;
  const model::Cutter* cutter = nullptr;
  for (const auto& s : p.plan.steps) {
    const auto* c = model::find_cutter(p.plan, s.cutter_id);
    if (c != nullptr && c->cutter_class == model::CutterClass::kCountersink) sunk = &s, cutter = c;
  }
  ASSERT_NE(sunk, nullptr) << p.said;
  EXPECT_EQ(cutter->id, "generic/countersink_90/16.5") << "the next one above 13 mm";
  // 72 m/min, where the cone leaves the material.
  EXPECT_NEAR(sunk->spindle_rpm, 72000.0 / (std::numbers::pi * 13.0), 2.0);
  // Of the whole tool's ring, 31^2 - 6.6^2, it were 40 Nm; of the cone's it is a seventh at the same feed.
  EXPECT_LT(sunk->loads.torque_nm, 10.0);
  EXPECT_GT(sunk->loads.torque_nm, 1.0);
}

}  // namespace
}  // namespace capstan::pipeline
