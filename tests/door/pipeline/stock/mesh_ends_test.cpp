#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <memory>
#include <string>
#include <utility>

#include "planner/ground/geometry/mesh.h"
#include "tests/door/pipeline/block.h"

// What the nouns say of a slot's ends holds for a part that is given as a mesh, too.

namespace capstan::pipeline {
namespace {

using namespace block;
using ::testing::HasSubstr;

/// The whole block, as if nothing were cut: which features a mesh has is not what is asked here.
std::shared_ptr<const geometry::Mesh> whole_block() {
  geometry::Mesh m;
  for (int i = 0; i < 8; ++i)
    m.vertices.push_back({i % 2 * 100.0, i / 2 % 2 * 100.0, i / 4 % 2 * 20.0 - 20.0});
  // Two triangles a side, counter-clockwise from outside; vertices by bits x, y, z.
  m.triangles = {{0, 2, 1}, {1, 2, 3}, {4, 5, 6}, {5, 7, 6}, {0, 1, 4}, {1, 5, 4},
                 {2, 6, 3}, {3, 6, 7}, {0, 4, 2}, {2, 4, 6}, {1, 3, 5}, {3, 7, 5}};
  return std::make_shared<const geometry::Mesh>(std::move(m));
}

/// A slot 16 mm wide and 5 mm deep from (30, 50) to (70, 50) with these two ends.
Planned slotted(const std::string& ends) {
  model::Plan plan = read(
      "#80=CARTESIAN_POINT('',(30.,50.,0.));\n#81=AXIS2_PLACEMENT_3D('',#80,#21,#22);\n"
      "#82=TOLERANCED_LENGTH_MEASURE(40.,$);\n#83=LINEAR_PATH($,#82,#22);\n"
      "#84=TOLERANCED_LENGTH_MEASURE(16.,$);\n#85=SQUARE_U_PROFILE($,#84,$,$,$,$);\n" +
      ends + "#88=SLOT('S',#4,(),#81,#53,#83,#85,(#86,#87));\n");
  plan.target_mesh = whole_block();
  return bound(std::move(plan));
}

TEST(EndsBesideAMesh, AWoodruffEndIsRefusedAsItIsWithout) {
  const Planned p = slotted(
      "#86=WOODRUFF_SLOT_END_TYPE(#89);\n#87=RADIUSED_SLOT_END_TYPE();\n"
      "#89=TOLERANCED_LENGTH_MEASURE(10.,$);\n");
  ASSERT_EQ(p.plan.unplanned.size(), 1U) << p.said;
  EXPECT_THAT(p.plan.unplanned.front().reason, HasSubstr("its woodruff end at (30, 50, 0) rises to the top"));
  EXPECT_TRUE(p.plan.steps.empty());
}

TEST(EndsBesideAMesh, AFlatEndWithUnequalCornersIsRefusedAsItIsWithout) {
  const Planned p = slotted(
      "#86=FLAT_SLOT_END_TYPE(#89,#90);\n#87=RADIUSED_SLOT_END_TYPE();\n"
      "#89=TOLERANCED_LENGTH_MEASURE(7.,$);\n#90=TOLERANCED_LENGTH_MEASURE(2.,$);\n");
  ASSERT_EQ(p.plan.unplanned.size(), 1U) << p.said;
  EXPECT_THAT(p.plan.unplanned.front().reason, HasSubstr("states corners of radius 7 and 2 mm"));
}

TEST(EndsBesideAMesh, ASquareEndIsNoneWhereTheMeshTellsWhatStands) {
  const Planned p = slotted(
      "#86=FLAT_SLOT_END_TYPE(#89,#89);\n#87=RADIUSED_SLOT_END_TYPE();\n"
      "#89=TOLERANCED_LENGTH_MEASURE(0.,$);\n");
  EXPECT_EQ(p.said.find("is square, solid stands beyond it"), std::string::npos) << p.said;
}

}  // namespace
}  // namespace capstan::pipeline
