#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <functional>
#include <numbers>

#include "tests/proof/verify/checked.h"

// What a step's own numbers say of bending, of the tool and of the wall it leaves.

namespace capstan::verify {
namespace {

using ::testing::HasSubstr;
using testing::of;
using testing::PlanMaker;

/// A tolerance of +-0.1 on the width and length of the pocket.
void tolerate(PlanMaker& k, double each_way) {
  const auto* ws = k.plan.model.get<model::MachiningWorkingstep>(k.plan.steps[0].step);
  const auto* pocket = k.plan.model.get<model::ClosedPocket>(ws->its_feature);
  const auto* profile = k.plan.model.get<model::RectangularClosedProfile>(pocket->feature_boundary);
  for (const auto ref : {profile->profile_width, profile->profile_length}) {
    model::PlusMinusValue t;
    t.upper_limit = t.lower_limit = each_way;
    const auto made = k.plan.model.add(t);
    k.plan.model.get<model::TolerancedLengthMeasure>(ref)->implicit_tolerance = made;
  }
}

// A zone of 0.2 mm: a wall may be off by 0.1 mm at most, two walls by 0.05 mm each.
TEST(PredictedBending, OfAWallBeyondItsToleranceIsAnError) {
  PlanMaker k = testing::good_plan();
  tolerate(k, 0.1);
  k.plan.steps[0].loads.wall_error_mm = -0.18;
  auto found = of(k, "CHK-WALL-ERROR");
  ASSERT_EQ(found.size(), 1u);
  EXPECT_EQ(found[0].severity, Severity::kError);
  EXPECT_THAT(found[0].message, HasSubstr("0.18 mm"));
  EXPECT_THAT(found[0].message, HasSubstr("0.1 mm is the most that one wall may be off"));
  k.plan.steps[0].loads.wall_error_mm = 0.08;
  found = of(k, "CHK-WALL-ERROR");
  ASSERT_EQ(found.size(), 1u);
  EXPECT_EQ(found[0].severity, Severity::kWarning);
  k.plan.steps[0].loads.wall_error_mm = 0.05;
  EXPECT_TRUE(of(k, "CHK-WALL-ERROR").empty());
}

TEST(PredictedBending, OfAWallThatNoToleranceJudgesIsTold) {
  PlanMaker k = testing::good_plan();
  k.plan.steps[0].loads.wall_error_mm = 1.0;
  EXPECT_TRUE(of(k, "CHK-WALL-ERROR").empty());
  EXPECT_EQ(of(k, "CHK-BENDING").size(), 1u);
  k.plan.steps[0].loads.wall_error_mm = 0.2;
  EXPECT_TRUE(of(k, "CHK-BENDING").empty());
}

TEST(PredictedBending, ThatBreaksTheToolIsAnErrorWhateverTheWallDoes) {
  PlanMaker k = testing::good_plan();
  tolerate(k, 1.0);
  k.plan.cutters[0].substrate = model::Substrate::kCarbide;
  k.plan.steps[0].loads.deflection_mm = 1.0;
  k.plan.steps[0].loads.wall_error_mm = 0.02;
  const auto found = of(k, "CHK-BENDING");
  ASSERT_EQ(found.size(), 1u);
  EXPECT_EQ(found[0].severity, Severity::kError);
}

/// A counterbore of 20 mm over a hole of 10: step "pocket" mills it. Widths of the zones, 0: none stated.
PlanMaker counterbore(double wide_zone, double narrow_zone) {
  PlanMaker k = testing::good_plan();
  const auto hole = [&](double diameter, double zone) {
    const auto ref = k.hole("of it", 50, 50, diameter, 10);
    if (zone > 0.0) {
      model::PlusMinusValue t;
      t.upper_limit = t.lower_limit = 0.5 * zone;
      const auto made = k.plan.model.add(t);
      k.plan.model.get<model::TolerancedLengthMeasure>(k.plan.model.get<model::RoundHole>(ref)->diameter)
          ->implicit_tolerance = made;
    }
    return ref;
  };
  model::CounterboreHole both;
  both.its_id = "counterbore";
  both.elements.push_back(hole(20, wide_zone));
  both.elements.push_back(hole(10, narrow_zone));
  const auto ref = k.plan.model.add(both);
  k.plan.model.get<model::MachiningWorkingstep>(k.plan.steps[0].step)->its_feature = ref;
  k.plan.steps[0].loads.wall_error_mm = 0.08;
  return k;
}

TEST(PredictedBending, OfACompoundHoleIsJudgedByTheWidestOfItsElements) {
  EXPECT_TRUE(of(counterbore(0.4, 0.015), "CHK-WALL-ERROR").empty());
  const auto found = of(counterbore(0.1, 0.015), "CHK-WALL-ERROR");
  ASSERT_EQ(found.size(), 1u);
  EXPECT_EQ(found[0].severity, Severity::kError);
  EXPECT_TRUE(of(counterbore(0.0, 0.015), "CHK-WALL-ERROR").empty());
}

TEST(PredictedBending, OfARoughingToolIsTold) {
  PlanMaker k = testing::good_plan();
  k.plan.steps[0].axial_depth_mm = 5.0;
  k.plan.steps[0].radial_depth_mm = 5.0;
  k.plan.steps[0].loads.deflection_mm = 0.45;
  const auto found = of(k, "CHK-BENDING");
  ASSERT_EQ(found.size(), 1u);
  EXPECT_EQ(found[0].severity, Severity::kWarning);
}

TEST(PredictedBending, OfAToolThatReachesTheFinishedWallIsTold) {
  PlanMaker k = testing::good_plan();
  const auto* ws = k.plan.model.get<model::MachiningWorkingstep>(k.plan.steps[0].step);
  ASSERT_NE(ws, nullptr);
  auto* op = k.plan.model.get<model::BottomAndSideMilling>(ws->its_operation);
  ASSERT_NE(op, nullptr);
  k.plan.cutters[0].substrate = model::Substrate::kCarbide;
  // The next pass is to find five edge radii, 0.04 mm.
  op->allowance_side = 0.3;
  k.plan.steps[0].loads.deflection_mm = 0.26;
  EXPECT_TRUE(of(k, "CHK-BENDING").empty());
  k.plan.steps[0].loads.deflection_mm = 0.29;
  EXPECT_EQ(of(k, "CHK-BENDING").size(), 1u);
  op->allowance_side = 0.1;
  k.plan.steps[0].loads.deflection_mm = 0.1;
  const auto found = of(k, "CHK-BENDING");
  ASSERT_EQ(found.size(), 1u);
  EXPECT_THAT(found[0].message, HasSubstr("at most 0.06 mm of the 0.1 mm that it leaves on its walls"));
  // An allowance of 3 mm does not let it bend by 3 mm.
  op->allowance_side = 3.0;
  k.plan.steps[0].loads.deflection_mm = 0.39;
  EXPECT_TRUE(of(k, "CHK-BENDING").empty());
  k.plan.steps[0].loads.deflection_mm = 0.45;
  EXPECT_EQ(of(k, "CHK-BENDING").size(), 1u);
}

// Flutes of 25 mm on 10 mm of carbide: I = pi 8^4 / 64 = 201.06 mm4, so that 2000 N are 2000 * 25 * 5 / I =
// 1243.
TEST(PredictedBending, ThatTiresTheToolIsTold) {
  PlanMaker k = testing::good_plan();
  model::Cutter& c = k.plan.cutters[0];
  c.substrate = model::Substrate::kCarbide;
  c.cutting_diameter_mm = 10.0;
  c.maximum_depth_of_cut_mm = 25.0;
  c.stick_out_mm = 40.0;
  k.plan.steps[0].loads.deflection_mm = 0.05;
  k.plan.steps[0].loads.peak_force_n = 1700.0;  // 1057 N/mm2 of 1000, as near as it is known
  EXPECT_TRUE(of(k, "CHK-BENDING").empty());
  k.plan.steps[0].loads.peak_force_n = 2000.0;
  const auto found = of(k, "CHK-BENDING");
  ASSERT_EQ(found.size(), 1u);
  EXPECT_EQ(found[0].severity, Severity::kWarning);
  EXPECT_THAT(found[0].message, HasSubstr("a stress of 1243 N/mm2"));
}

// A neck of 8 mm that ends 38 mm above the tip: 32 x 1500 N x 38 / (pi 8^3) = 1134; the flutes bear 932.
TEST(PredictedBending, ThatTiresTheNeckIsTold) {
  PlanMaker k = testing::good_plan();
  model::Cutter& c = k.plan.cutters[0];
  c.substrate = model::Substrate::kCarbide;
  c.maximum_depth_of_cut_mm = 25.0;
  c.stick_out_mm = 40.0;
  k.plan.steps[0].loads.deflection_mm = 0.05;
  k.plan.steps[0].loads.peak_force_n = 1500.0;
  EXPECT_TRUE(of(k, "CHK-BENDING").empty());
  c.neck_diameter_mm = 8.0;
  c.neck_length_mm = 38.0;
  auto found = of(k, "CHK-BENDING");
  ASSERT_EQ(found.size(), 1u);
  EXPECT_THAT(found[0].message, HasSubstr("a stress of 1134 N/mm2 in its neck"));
  // A shank of 8 mm that is 70 mm out: 32 x 1500 x 70 / (pi 8^3) = 2089.
  c.neck_diameter_mm = 0.0;
  c.shank_diameter_mm = 8.0;
  c.stick_out_mm = 70.0;
  found = of(k, "CHK-BENDING");
  ASSERT_EQ(found.size(), 1u);
  EXPECT_THAT(found[0].message, HasSubstr("a stress of 2089 N/mm2 in its shank"));
}

// Carbide of 10 mm, 40 mm out, bent by 1 mm: 1.5 x 580000 x 10 x 1 / 40^2 = 5437 N/mm2.
TEST(PredictedBending, ThatBreaksTheToolIsAnError) {
  PlanMaker k = testing::good_plan();
  k.plan.cutters[0].substrate = model::Substrate::kCarbide;
  k.plan.steps[0].axial_depth_mm = 5.0;
  k.plan.steps[0].radial_depth_mm = 5.0;
  k.plan.steps[0].loads.deflection_mm = 1.0;
  const auto found = of(k, "CHK-BENDING");
  ASSERT_EQ(found.size(), 1u);
  EXPECT_EQ(found[0].severity, Severity::kError);
  EXPECT_THAT(found[0].message, HasSubstr("a stress of 5438 N/mm2"));  // 5437.5
}

}  // namespace
}  // namespace capstan::verify
