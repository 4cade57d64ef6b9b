#include <gtest/gtest.h>

#include <algorithm>
#include <string>

#include "tests/door/pipeline/block.h"

// A boss that no feature lists stands all the same: a face that is cut around it makes it.

namespace capstan::pipeline {
namespace {

using block::read;

/// The whole top of the block is cut 5 mm deep; in its middle stands a boss of 14 mm that the face does not
/// list.
const char* const kBossInAFace =
    "#60=TOLERANCED_LENGTH_MEASURE(14.,$);\n#61=CIRCULAR_CLOSED_PROFILE($,#60);\n"
    "#62=BOSS('B',#4,(),#50,#53,#61,$);\n"
    "#63=DIRECTION('',(0.,1.,0.));\n#64=TOLERANCED_LENGTH_MEASURE(100.,$);\n"
    "#65=LINEAR_PATH($,#64,#63);\n#66=NUMERIC_PARAMETER('profile length',100.,'mm');\n"
    "#67=LINEAR_PROFILE($,#66);\n#70=CARTESIAN_POINT('',(0.,0.,0.));\n"
    "#71=AXIS2_PLACEMENT_3D('',#70,#21,#22);\n#72=PLANAR_FACE('F',#4,(),#71,#53,#65,#67,$,());\n";

TEST(SparedBosses, AreNotCalledUnplanned) {
  Job job;
  const auto out = bind_checked(read(kBossInAFace), block::shop(), {}, job);
  ASSERT_TRUE(out) << to_text(out.error());
  std::string said;
  for (const auto& d : job.diagnostics()) said += to_text(d) + "\n";
  EXPECT_TRUE(out->plan.unplanned.empty()) << said;
  EXPECT_TRUE(std::none_of(out->findings.begin(), out->findings.end(),
                           [](const auto& f) { return f.severity == Severity::kError; }));
  EXPECT_NE(said.find("'F' is cut around the boss 'B', which stands"), std::string::npos) << said;
  EXPECT_EQ(said.find("PIP-UNPLANNED"), std::string::npos) << said;
}

}  // namespace
}  // namespace capstan::pipeline
