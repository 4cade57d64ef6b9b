#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "tests/door/pipeline/block.h"

// Features that are longer than the machine travels.

namespace capstan::pipeline {
namespace {

using namespace block;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

/// A pocket of 40 x 30 mm with corners of R3, 10 mm deep.
const char* const kPocket =
    "#80=TOLERANCED_LENGTH_MEASURE(40.,$);\n#81=TOLERANCED_LENGTH_MEASURE(30.,$);\n"
    "#82=TOLERANCED_LENGTH_MEASURE(3.,$);\n#83=RECTANGULAR_CLOSED_PROFILE($,#81,#80);\n"
    "#84=CLOSED_POCKET('POCKET',#4,(),#50,#56,(),$,#57,$,#82,#83);\n";

/// No cutter is wider than 16 mm.
Inputs shop_of(double travel_mm) {
  Inputs in = shop();
  std::erase_if(in.library, [](const model::Cutter& c) { return c.cutting_diameter_mm > 16.0; });
  for (const std::size_t axis : {0U, 1U}) {
    in.machine.axes[axis].travel_min_mm = 0.0;
    in.machine.axes[axis].travel_max_mm = travel_mm;
  }
  return in;
}

// The cutter's middle spans 40 - 16 = 24 mm at least. 15 x 15 mm are 21.2 mm from corner to corner.
TEST(Travel, AFeatureLongerThanTheMachineTravelsIsRefusedBeforeAnythingIsTried) {
  const Planned p = bound(read(kPocket), shop_of(15.0));
  ASSERT_EQ(p.plan.unplanned.size(), 1U) << p.said;
  EXPECT_THAT(p.plan.unplanned[0].reason, HasSubstr("it is 40 mm long"));
  EXPECT_THAT(p.plan.unplanned[0].reason, HasSubstr("travels 15 x 15 mm"));
  EXPECT_THAT(p.said, ::testing::Not(HasSubstr("PIP-ANEW")));
}

TEST(Travel, AFeatureThatTheMachineReachesIsPlanned) {
  const Planned p = bound(read(kPocket), shop_of(40.0));
  EXPECT_THAT(p.plan.unplanned, IsEmpty()) << p.said;
}

}  // namespace
}  // namespace capstan::pipeline
