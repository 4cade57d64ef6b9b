#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "tests/door/pipeline/block.h"
#include "tooling/library/library.h"
#include "tooling/selection/select.h"

// The feed of thread mills, by hand.

namespace capstan::pipeline {
namespace {

/// M20 x 2.5, left-hand, 15 mm deep in a core of 17.5 mm right through the block: milled.
const char* const kM20 =
    "#70=CARTESIAN_POINT('',(0.,0.,-20.));\n#71=AXIS2_PLACEMENT_3D('',#70,#21,#22);\n#72=PLANE('',#71);\n"
    "#60=PLUS_MINUS_VALUE(0.2,0.2,3);\n#61=TOLERANCED_LENGTH_MEASURE(17.5,#60);\n"
    "#75=ROUND_HOLE('CORE',#4,(),#50,#72,#61,$,#58);\n#80=CARTESIAN_POINT('',(0.,0.,-15.));\n"
    "#81=AXIS2_PLACEMENT_3D('',#80,#21,#22);\n#82=PLANE('',#81);\n"
    "#121=PARTIAL_AREA_DEFINITION(15.,#50,$);\n#122=DESCRIPTIVE_PARAMETER('fit class','6H');\n"
    "#123=DESCRIPTIVE_PARAMETER('form','M');\n#124=NUMERIC_PARAMETER('threads per mm',0.4,'mm');\n"
    "#125=DESCRIPTIVE_PARAMETER('hand','left');\n"
    "#126=DEFINED_THREAD('M20',#4,(),#50,#82,#121,(#75),.T.,$,#122,#123,20.,#124,#125,18.376,17.294,$);\n";

TEST(ThreadMill, ItsCentreIsFedByTheSmallerCircle) {
  const auto made = block::bound(block::read(kM20));
  const auto step = std::find_if(made.plan.steps.begin(), made.plan.steps.end(), [&](const auto& s) {
    const auto* c = model::find_cutter(made.plan, s.cutter_id);
    return c != nullptr && c->cutter_class == model::CutterClass::kThreadMill;
  });
  ASSERT_NE(step, made.plan.steps.end()) << made.said;
  const model::Cutter& c = *model::find_cutter(made.plan, step->cutter_id);
  const double fz = tooling::start_values(c, made.plan.material, made.plan.machine).fz_mm;
  ASSERT_GT(fz, 0.0);
  const double major = 20.0, d = c.cutting_diameter_mm, core = 17.5;
  // Sandvik's formulas of internal thread milling, chip = the table's feed per tooth.
  const double ae = (major * major - core * core) / (4.0 * (major - d));
  const double arc = std::acos(1.0 - 2.0 * ae / d);
  const double edge_fz = fz / std::min(1.0, std::sin(std::min(arc, 1.5708)));
  const double most = edge_fz * c.teeth * std::abs(step->spindle_rpm) * (major - d) / major;
  double fastest = 0.0;
  for (std::size_t i = 1; i < step->path->size(); ++i) {
    const bool arc_move =
        step->path->kind[i] == model::MoveKind::kArcCw || step->path->kind[i] == model::MoveKind::kArcCcw;
    if (arc_move) fastest = std::max(fastest, step->schedule->feed_mm_min[i]);
  }
  EXPECT_GT(fastest, 0.0);
  EXPECT_LE(fastest, most * 1.001);
  EXPECT_GE(fastest, 0.5 * most);  // and not needlessly slow: aluminium, no other limit is near
}

}  // namespace
}  // namespace capstan::pipeline
