// What bounds a pocket cycle where the plan's path, its loads or the mill are not as usual.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <memory>
#include <string>

#include "tests/door/service/pockets/pocket_parts.h"

namespace capstan::service {
namespace {

using namespace pocket_parts;
using ::testing::AllOf;
using ::testing::Contains;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;

/// The plan with corners of this radius at its T2, 10 wide.
model::Plan with_corners(model::Plan plan, double radius_mm) {
  for (model::Cutter& c : plan.cutters) {
    if (c.pocket == 2) c.corner_radius_mm = radius_mm;
  }
  return plan;
}

// Corners of 1 leave 8 of 10 mm flat: rings 80 % of that apart, and a helix 90 % of half of it.
TEST(PocketBounds, OfMillsWithACornerRadiusAreRingsThatLeaveNoRidges) {
  const model::Plan plan = with_corners(planned("siemens", bracket()), 1.0);
  const std::string text = program_of(plan), call = call_in(text, "POCKET3(");
  EXPECT_EQ(parameter(call, 17), "6.4");
  EXPECT_EQ(parameter(call, 21), "3.6");
  // Rings with square corners leave posts from 0.854 of the 8 mm on.
  for (const char* wide : {"6.9", "8.1"})
    EXPECT_THAT(against(with(text, call, with_parameter(call, 17, wide)), plan),
                Contains(HasSubstr("leave material on the floor")))
        << wide;
  EXPECT_THAT(against(with(text, call, with_parameter(call, 17, "-6.4")), plan), Not(IsEmpty()));
  const model::Plan ball = with_corners(planned("siemens", bracket()), 5.0);
  EXPECT_THAT(program_of(ball), Not(HasSubstr("POCKET3(")));
}

/// The bracket's roughing of its pocket, n 2 of the program.
model::StepResult& roughing(model::Plan& plan) { return plan.steps[1]; }

// A path whose first ramp goes down half as steeply as the rest: the flattest one bounds the way in.
TEST(PocketBounds, OfTheWayInIsTheFlattestRampOfThePath) {
  model::Plan plan = planned("siemens", bracket());
  const std::string text = program_of(plan), call = call_in(text, "POCKET3(");
  EXPECT_THAT(against(text, plan), IsEmpty());
  auto path = std::make_shared<model::CutterPath>(*roughing(plan).path);
  std::size_t ramp = 0;
  while (ramp < path->size() &&
         !(path->role[ramp] == model::MoveRole::kRamp && path->z[ramp] < path->z[ramp - 1]))
    ++ramp;
  ASSERT_LT(ramp, path->size());
  path->z[ramp] += 0.5 * (path->z[ramp - 1] - path->z[ramp]);
  roughing(plan).path = path;
  EXPECT_THAT(against(text, plan),
              Contains(AllOf(HasSubstr("CHK-POCKET-CYCLE"), HasSubstr("goes in at a slope of "))));
}

// Without the largest force of the planned path no feed in a slot is too fast for it.
TEST(PocketBounds, OfAPlanThatStatesNoForceAreNone) {
  model::Plan plan = planned("siemens", bracket());
  const std::string text = program_of(plan);
  roughing(plan).loads.peak_force_n = 0.0;
  EXPECT_THAT(against(text, plan),
              Contains(AllOf(HasSubstr("CHK-POCKET-CYCLE"), HasSubstr("states no largest force"))));
  EXPECT_THAT(program_of(plan), Not(HasSubstr("POCKET3(")));
}

}  // namespace
}  // namespace capstan::service
