#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <numbers>

#include "rules/rules.h"
#include "tests/rules/proposed.h"
#include "tests/rules/shop.h"

// Plain holes by size, grade and bottom.

namespace capstan::rules {
namespace {

using drawn::hole;
using drawn::toleranced;
using model::CutterClass;
using model::FeatureShape;
using model::HoleBottom;
using model::Proposal;
using model::TypeId;
using testing::ElementsAre;
using testing::HasSubstr;

constexpr double kDegree = std::numbers::pi / 180.0;

// A shop's spot of 25 mm would else not do for a hole of 31 mm.
TEST(Hole, AsksOfItsSpotTheReachOfTheSpotAlone) {
  const auto chain = proposed(h(hole(8, 31), 12)).chains.at(0);
  ASSERT_EQ(chain.size(), 2U);
  const auto &spot = chain[0], &drill = chain[1];
  EXPECT_LE(spot.depth_mm, 4.0) << "half the hole's diameter, at a point of 90 degrees";
  EXPECT_LE(spot.tool.reach_mm - spot.depth_mm, drill.tool.reach_mm - drill.depth_mm) << "clearance alone";
  EXPECT_GE(drill.tool.reach_mm, 31.0);
}

TEST(Hole, WithATighterToleranceGetsAnotherChainAndCitesItsRow) {
  const FeatureShape s = hole(20, 30);
  const Proposal it12 = proposed(h(s, 12));
  EXPECT_THAT(first(it12), ElementsAre(TypeId::kCenterDrilling, TypeId::kDrilling));
  EXPECT_EQ(row(it12), "hole.drill");
  const Proposal it11 = proposed(h(s, 11));
  EXPECT_EQ(row(it11), "hole.drill");
  const Proposal it10 = proposed(h(s, 10));
  EXPECT_THAT(first(it10), ElementsAre(TypeId::kCenterDrilling, TypeId::kDrilling, TypeId::kReaming));
  EXPECT_EQ(row(it10), "hole.ream.it9");
  const Proposal it7 = proposed(h(s, 7));
  EXPECT_EQ(row(it7), "hole.ream.it7");
  EXPECT_THAT(first(it7), ElementsAre(TypeId::kCenterDrilling, TypeId::kDrilling, TypeId::kReaming));
  EXPECT_THAT(kinds(it7.chains[1]), ElementsAre(TypeId::kCenterDrilling, TypeId::kDrilling, TypeId::kBoring));
  EXPECT_EQ(row(proposed(h(s, 6))), "hole.fine");
  EXPECT_THAT(proposed(h(s, 5)).cannot, HasSubstr("[hole.grind]"));
}

/// What the first chain of the hole alone in its part asks of its first drill.
model::ToolRequirement first_drill(const FeatureShape& s, const Context& c) {
  const Proposal p = propose_members(shipped(), std::vector{s}, c).at(0);
  for (const auto& step : p.chains.at(0))
    if (step.operation == TypeId::kDrilling || step.operation == TypeId::kMultistepDrilling) return step.tool;
  return {};
}

// Inserts cut wider than they measure, start by themselves, and are never pecked.
TEST(Hole, MayBeDrilledWithInsertsWhereItsToleranceAndDepthLetThem) {
  const auto inserts_do = [](const FeatureShape& s, const Context& c) {
    return first_drill(s, c).point_angle_most_rad == std::numbers::pi;
  };
  const FeatureShape wide = toleranced(hole(22, 40), -0.2, 0.2);
  Context c = steel();
  EXPECT_TRUE(inserts_do(wide, c));
  EXPECT_EQ(propose_members(shipped(), std::vector{wide}, c).at(0).chains.at(0).size(), 1U)
      << "without a spot";
  EXPECT_FALSE(inserts_do(h(hole(22, 40), 11), c)) << "0.13 mm in all: no room for its oversize";
  EXPECT_FALSE(inserts_do(toleranced(hole(12, 20), -0.2, 0.2), c)) << "none is made below 14 mm";
  EXPECT_FALSE(inserts_do(toleranced(hole(22, 50), -0.2, 0.2), c)) << "deeper than two diameters by flood";
  FeatureShape pointed = toleranced(hole(22, 40, HoleBottom::kConical), -0.2, 0.2);
  pointed.bottom_angle_rad = 31.0 * kDegree;
  EXPECT_FALSE(inserts_do(pointed, c)) << "its cone asks a point";
  c.has_through_coolant = true;
  EXPECT_TRUE(inserts_do(toleranced(hole(22, 60), -0.2, 0.2), c)) << "chips are washed out";
  EXPECT_FALSE(inserts_do(toleranced(hole(22, 80), -0.2, 0.2), c)) << "pecked";
  c.has_through_coolant = c.has_coolant = false;
  EXPECT_FALSE(inserts_do(wide, c)) << "dry";
}

TEST(Hole, OutsideTheH7ZoneIsBoredToTheMiddleOfItsTolerance) {
  const Proposal p = proposed(toleranced(hole(20, 30), -0.035, -0.014));  // P7
  EXPECT_EQ(row(p), "hole.bore.it7");
  EXPECT_NEAR(p.chains[0].back().tool.diameter_exact_mm, 20.0 - 0.0245, 1e-12);
}

TEST(Hole, IsDrilledSmallerForTheReamerAndTheReamerKnows) {
  const auto chain = proposed(h(hole(20, 30), 7)).chains.at(0);
  // Table ream_stock: 0.3 from 20 mm; half of it to twice is admitted.
  EXPECT_DOUBLE_EQ(chain[1].tool.diameter_min_mm, 19.4);
  EXPECT_DOUBLE_EQ(chain[1].tool.diameter_max_mm, 19.85);
  EXPECT_DOUBLE_EQ(chain[2].tool.diameter_exact_mm, 20.0);
  EXPECT_DOUBLE_EQ(chain[2].start_diameter_mm, 19.625);
  EXPECT_THAT(chain[2].after, ElementsAre(1));
  EXPECT_GT(chain[2].tool.reach_mm, 30.0);
}

TEST(Hole, AsksOfAReamerFlutesAsLongAsTheHoleAndReachBelowIt) {
  const auto ream = proposed(h(hole(15, 50), 7)).chains.at(0).back();
  ASSERT_EQ(ream.operation, TypeId::kReaming);
  EXPECT_DOUBLE_EQ(ream.tool.depth_of_cut_mm, 50.0) << "what is cut; the lead goes 2 mm below it";
  EXPECT_DOUBLE_EQ(ream.depth_mm, 52.0);
  EXPECT_GE(ream.tool.reach_mm, 53.0);
}

TEST(Hole, AsksForItsNominalDrillThenForAnyUpToTheMiddleOfTheTolerance) {
  const Proposal p = proposed(toleranced(hole(10, 20), -0.1, 0.1));
  EXPECT_DOUBLE_EQ(p.chains.at(0).at(1).tool.diameter_exact_mm, 10.0);
  EXPECT_DOUBLE_EQ(p.chains.at(0).at(1).tool.diameter_tolerance_mm, 0.0)
      << "10.1 would leave no room for oversize";
  const auto any = p.chains.at(1).at(1).tool;
  EXPECT_DOUBLE_EQ(any.diameter_exact_mm - any.diameter_tolerance_mm, 9.9);
  EXPECT_DOUBLE_EQ(any.diameter_exact_mm + any.diameter_tolerance_mm, 10.0);
  // No drill is sold as 9.97: any between 9.87 and that.
  const auto odd = proposed(toleranced(hole(9.97, 20), -0.1, 0.1)).chains.at(0).at(1).tool;
  EXPECT_NEAR(odd.diameter_exact_mm, 9.92, 1e-12);
  EXPECT_NEAR(odd.diameter_tolerance_mm, 0.05, 1e-12);
}

TEST(Hole, WithoutToleranceSaysWhatWasTaken) {
  EXPECT_THAT(proposed(hole(10, 20)).chains.at(0).at(1).why.text,
              HasSubstr("taken as IT13 (default, unsourced)"));
  Context c = steel();
  c.global_tolerance_mm = 0.01;
  const Proposal p = proposed(hole(10, 20), c);
  EXPECT_THAT(p.chains.at(0).at(1).why.text, HasSubstr("general +-0.01 mm"));
  EXPECT_EQ(p.chains[0][0].why.id, "hole.bore.it7")
      << "0.02 mm on 10 mm is IT7, and H7 does not lie within +-0.01";
}

TEST(Hole, IsPeckedFromThreeDiametersAndRefusedFromTwelve) {
  const auto drill = [](double depth) { return proposed(hole(10, depth)).chains.at(0).at(1); };
  EXPECT_FALSE(drill(29.0).peck);
  EXPECT_TRUE(drill(30.0).peck);
  EXPECT_THAT(drill(30.0).why.text, HasSubstr("[drill_depth.break]"));
  EXPECT_EQ(drill(30.0).peck_retract_mm, 0.5) << "up to five diameters in steel the chip is broken";
  EXPECT_EQ(drill(50.0).peck_retract_mm, 0.0) << "deeper the drill comes out";
  Context tough = steel();
  tough.material.iso_group = "M";
  EXPECT_EQ(proposed(hole(10, 30), tough).chains.at(0).at(1).peck_retract_mm, 0.0)
      << "long chips are not broken";
  EXPECT_THAT(proposed(hole(2, 40)).cannot, HasSubstr("[hole.gun.dry]"));
  EXPECT_THAT(proposed(hole(2, 240)).cannot, HasSubstr("[hole.gun.too_deep]"));
}

TEST(Hole, WithAFlatBottomIsDrilledShortAndMilled) {
  const auto chain = proposed(hole(12, 20, HoleBottom::kFlat)).chains.at(0);
  EXPECT_THAT(kinds(chain),
              ElementsAre(TypeId::kCenterDrilling, TypeId::kDrilling, TypeId::kBottomAndSideFinishMilling));
  const double drill = chain[1].tool.diameter_max_mm;
  EXPECT_LE(chain[1].depth_mm + std::tan(31.0 * kDegree) * 0.5 * drill, 20.0)
      << "the tip stays above the bottom";
  EXPECT_LT(chain[1].tool.diameter_max_mm, 12.0);
  EXPECT_TRUE(chain[2].tool.corner_radius_limited);
  EXPECT_EQ(chain[2].tool.corner_radius_max_mm, 0.0);
}

TEST(Hole, TooShallowForADrillsTipIsMilledAlone) {
  const Proposal p = proposed(hole(12, 3, HoleBottom::kFlat));
  EXPECT_THAT(first(p), ElementsAre(TypeId::kBottomAndSideRoughMilling, TypeId::kBottomAndSideFinishMilling));
  ASSERT_EQ(p.rejected.size(), 1U);
  EXPECT_THAT(p.rejected[0].why, HasSubstr("tip"));
}

TEST(Hole, WithARadiusAtTheBottomAsksForThatRadius) {
  FeatureShape s = hole(20, 20, HoleBottom::kFlatWithRadius);
  s.bottom_hole_radius_mm = 2.0;
  const auto chain = proposed(s).chains.at(0);
  EXPECT_EQ(chain.back().tool.corner_radius_exact_mm, 2.0);
  EXPECT_THAT(chain.back().tool.classes, ElementsAre(CutterClass::kBullnoseEndmill));
}

TEST(Hole, WithADrillsConeAsksForThatPointAndWithAnotherGivesAReason) {
  FeatureShape s = hole(10, 20, HoleBottom::kConical);
  s.bottom_angle_rad = 20.0 * kDegree;  // 140 degrees
  EXPECT_NEAR(proposed(s).chains.at(0).at(1).tool.point_angle_rad, 140.0 * kDegree, 1e-12);
  s.bottom_angle_rad = 45.0 * kDegree;
  EXPECT_EQ(row(proposed(s)), "hole.cone.countersink");
  s.bottom_angle_rad = 10.0 * kDegree;
  EXPECT_THAT(proposed(s).cannot, HasSubstr("[hole.cone.other]"));
}

TEST(Hole, WithASphericalBottomIsFinishedByTheBallThatFits) {
  FeatureShape s = hole(10, 20, HoleBottom::kSpherical);
  s.bottom_hole_radius_mm = 5.0;
  const auto chain = proposed(s).chains.at(0);
  EXPECT_THAT(chain.back().tool.classes, ElementsAre(CutterClass::kBallEndmill));
  EXPECT_DOUBLE_EQ(chain.back().depth_mm, 15.0);
  s.bottom_hole_radius_mm = 8.0;
  EXPECT_THAT(proposed(s).cannot, HasSubstr("no half sphere"));
}

TEST(Hole, ThatIsWideIsOpenedFromAPilotAndKeepsAlternativesInOrder) {
  const Proposal p = proposed(h(hole(60, 30), 12));
  EXPECT_THAT(first(p), ElementsAre(TypeId::kCenterDrilling,
                                    testing::AnyOf(TypeId::kDrilling, TypeId::kMultistepDrilling),
                                    TypeId::kBottomAndSideRoughMilling, TypeId::kBottomAndSideFinishMilling));
  EXPECT_LE(p.chains[0][1].tool.diameter_max_mm, 20.0);
  ASSERT_EQ(p.chains.size(), 3U);
  for (std::size_t i = 0; i < 3; ++i) EXPECT_EQ(p.chains[i][0].priority, static_cast<int>(i));
  EXPECT_EQ(row(proposed(h(hole(24.99, 30), 12))), "hole.drill");
  EXPECT_EQ(row(proposed(h(hole(25, 30), 12))), "hole.large");
}

TEST(Hole, ThatTapersGetsACountersinkOrAReason) {
  FeatureShape s = hole(20, 5);
  s.bottom_diameter_mm = 10.0;  // 90 degrees
  EXPECT_THAT(proposed(s).cannot, HasSubstr("[hole.countersink.blind]"));
  Context c = steel();
  c.core_diameter_mm = 10.0;
  const Proposal p = proposed(s, c);
  EXPECT_THAT(first(p), ElementsAre(TypeId::kCounterSinking));
  EXPECT_NEAR(p.chains[0][0].tool.point_angle_rad, 90.0 * kDegree, 1e-12);
  EXPECT_EQ(p.chains[0][0].depth_mm, 0.0) << "follows from the tip of the cutter chosen";
  EXPECT_GE(p.chains[0][0].tool.diameter_min_mm, 20.0);
}

TEST(Hole, WithALeaningWallIsDrilledNarrowMilledInLevelsAndFinishedByABall) {
  FeatureShape s = hole(18, 20, HoleBottom::kFlat);
  s.bottom_diameter_mm = 12.0;
  const auto chain = proposed(s).chains.at(0);
  EXPECT_EQ(chain[0].why.id, "hole.tapered");
  EXPECT_THAT(kinds(chain),
              ElementsAre(TypeId::kCenterDrilling, TypeId::kDrilling, TypeId::kBottomAndSideRoughMilling,
                          TypeId::kBottomAndSideFinishMilling, TypeId::kBottomAndSideFinishMilling));
  EXPECT_LT(chain[1].tool.diameter_max_mm, 12.0);
  EXPECT_LT(chain[1].depth_mm + 0.3 * chain[1].tool.diameter_max_mm, 20.0)
      << "its tip stays above the bottom";
  EXPECT_LT(chain[2].tool.diameter_max_mm + 2.0 * chain[2].allowance_side_mm, 12.0);
  EXPECT_THAT(chain[4].tool.classes, ElementsAre(model::CutterClass::kBallEndmill));
  EXPECT_LT(chain[4].tool.diameter_max_mm, 12.0);
  Context c = steel();
  c.core_diameter_mm = 8.0;
  EXPECT_EQ(row(proposed(s, c)), "hole.tapered.over");
  EXPECT_EQ(row(proposed(h(s, 9))), "hole.tapered");
  EXPECT_THAT(proposed(h(s, 8)).cannot, HasSubstr("[hole.tapered.tight]"));
  s.bottom = HoleBottom::kSpherical;
  EXPECT_THAT(proposed(s).cannot, HasSubstr("[hole.tapered.bottom]"));
  s.bottom = HoleBottom::kFlat;
  s.bottom_diameter_mm = 20.0;
  EXPECT_THAT(proposed(s).cannot, HasSubstr("wider below"));
}

TEST(Counterbore, IsMadeFromTheNarrowHoleOutwards) {
  FeatureShape wide = hole(20, 8, HoleBottom::kFlat);
  FeatureShape narrow = hole(11, 22);
  narrow.frame.origin.z = -8.0;
  const auto shapes = from_the_top({wide, narrow});
  EXPECT_EQ(shapes[1].frame.origin.z, 0.0);
  EXPECT_EQ(shapes[1].depth_mm, 30.0);
  EXPECT_THAT(member_order(shapes), ElementsAre(std::pair<std::size_t, std::size_t>(1, 0)));
  const auto proposals = propose_members(shipped(), shapes, steel());
  EXPECT_EQ(row(proposals[1]), "hole.drill");
  EXPECT_EQ(row(proposals[0]), "hole.shoulder");
  EXPECT_EQ(proposals[0].chains[0][0].start_diameter_mm, 11.0);
  EXPECT_THAT(kinds(proposals[0].chains.at(1)), ElementsAre(TypeId::kCounterSinking));
}

// Every hole of a wide grid of sizes, grades and bottoms gets a chain or a reason, and each chain's drill
// stays within the hole.
TEST(Hole, OfAnySizeGradeAndBottomGetsAChainOrAReasonAndNoDrillLeavesIt) {
  int chains = 0;
  for (const double d : {0.4, 0.5, 1.9, 2.0, 3.0, 5.9, 6.0, 6.3, 12.0, 24.9, 25.0, 26.0, 51.0, 300.0}) {
    for (int grade = 4; grade <= 18; ++grade) {
      for (const auto bottom : {HoleBottom::kThrough, HoleBottom::kFlat, HoleBottom::kFlatWithRadius,
                                HoleBottom::kConical, HoleBottom::kSpherical}) {
        for (const double depth : {0.2 * d, 2.0 * d, 6.0 * d}) {
          FeatureShape s = h(hole(d, depth, bottom), grade);
          s.bottom_angle_rad = 31.0 * kDegree;
          s.bottom_hole_radius_mm = bottom == HoleBottom::kSpherical ? 0.5 * d : 0.1 * d;
          const Proposal p = proposed(s);
          for (const auto& chain : p.chains) {
            ++chains;
            for (const auto& step : chain) {
              if (!step.tool.classes.empty() && step.tool.classes[0] == CutterClass::kTwistDrill) {
                EXPECT_LE(step.tool.diameter_max_mm, s.diameter.nominal_mm + s.diameter.upper_mm);
                if (bottom == HoleBottom::kFlat) {
                  EXPECT_LE(step.depth_mm + 0.3 * step.tool.diameter_max_mm, depth);
                }
              }
              if (step.tool.diameter_exact_mm > 0.0) {
                EXPECT_LE(step.tool.diameter_exact_mm, d + s.diameter.upper_mm);
              }
            }
          }
        }
      }
    }
  }
  EXPECT_GT(chains, 1000);
}

}  // namespace
}  // namespace capstan::rules
