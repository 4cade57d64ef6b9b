#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "rules/rules.h"
#include "tests/rules/shop.h"

// Pockets, slots, steps and outsides whose size is finer than a mill holds by itself.

namespace capstan::rules {
namespace {

using model::FeatureShape;
using model::ShapeKind;
using model::TypeId;
using testing::HasSubstr;

/// 40 mm wide, 10 deep, corners R8, its width within a zone about the nominal.
FeatureShape mill(ShapeKind kind, double zone) {
  FeatureShape s;
  s.kind = kind;
  s.name = "F";
  s.depth_mm = 10.0;
  s.area = s.reach = geometry::rectangle({-40, -20}, {40, 20});
  s.width.nominal_mm = 40.0;
  s.width.lower_mm = -0.5 * zone;
  s.width.upper_mm = 0.5 * zone;
  s.width.given = true;
  if (kind == ShapeKind::kPocket) s.corner_radius_mm = 8.0;
  s.open = kind == ShapeKind::kStep || kind == ShapeKind::kOutside;
  if (kind == ShapeKind::kSlot) s.spine = {{-40, 0}, {40, 0}};
  return s;
}

// ISO 286-1, above 30 up to 50 mm: IT5 11, IT6 16, IT7 25 um.
constexpr double kIt5 = 0.011, kIt6 = 0.016;

TEST(MilledSizes, OfIt6AreMeasuredBeforeTheLastPassAndFinerTakesGrinding) {
  for (const ShapeKind kind : {ShapeKind::kPocket, ShapeKind::kSlot, ShapeKind::kStep, ShapeKind::kOutside}) {
    const auto six = propose(shipped(), mill(kind, kIt6), iron());
    ASSERT_FALSE(six.chains.empty()) << model::to_text(kind) << ": " << six.cannot;
    const auto& chain = six.chains.front();
    ASSERT_EQ(chain.size(), 4U);
    EXPECT_EQ(chain[2].operation, TypeId::kWorkpieceProbing);
    EXPECT_DOUBLE_EQ(chain[1].allowance_side_mm, 0.05) << "what the last pass takes";
    EXPECT_DOUBLE_EQ(chain[3].allowance_side_mm, 0.0);
    EXPECT_THAT(chain[3].why.text, HasSubstr("grinding")) << "and says what a finer size takes";
    EXPECT_THAT(propose(shipped(), mill(kind, kIt5), iron()).cannot, HasSubstr("grinding"));
  }
}

TEST(MilledSizes, OfAStepsDepthOfIt6AreMeasured) {
  FeatureShape s = mill(ShapeKind::kStep, 0.2);
  s.depth_tolerance.nominal_mm = 10.0;
  s.depth_tolerance.upper_mm = 0.009;  // IT6 above 6 up to 10 mm
  s.depth_tolerance.given = true;
  const auto p = propose(shipped(), s, iron());
  ASSERT_FALSE(p.chains.empty()) << p.cannot;
  EXPECT_EQ(p.chains.front()[2].operation, TypeId::kWorkpieceProbing);
}

TEST(SlotFloors, WithASmallRadiusAreFinishedByACutterOfThatRadius) {
  FeatureShape s = mill(ShapeKind::kSlot, 0.2);
  s.bottom_radius_mm = 0.1;
  const auto p = propose(shipped(), s, iron());
  ASSERT_FALSE(p.chains.empty()) << p.cannot;
  const auto& tool = p.chains.front().back().tool;
  EXPECT_DOUBLE_EQ(tool.corner_radius_exact_mm, 0.1);
  EXPECT_THAT(tool.classes, testing::Contains(model::CutterClass::kBullnoseEndmill));
}

TEST(TeeSlots, TakeALowerAndNarrowerHeadInPassesInOneChain) {
  FeatureShape s = mill(ShapeKind::kSlot, 0.2);
  s.open = true;
  s.depth_mm = 30.0;
  s.width.nominal_mm = 20.0;
  s.slot_profile = {{0, 16}, {20, 16}, {20, 10}, {30, 10}};
  const auto p = propose(shipped(), s, iron());
  ASSERT_EQ(p.chains.size(), 1U) << p.cannot;
  const auto& tool = p.chains.front().back().tool;
  EXPECT_NEAR(tool.diameter_min_mm, 0.6 * 32.0, 1e-9);
  EXPECT_NEAR(tool.diameter_max_mm, 32.0, 1e-9);
  EXPECT_NEAR(tool.cutting_width_max_mm, 20.0, 1e-9);
  EXPECT_NEAR(tool.neck_diameter_max_mm, 19.8, 1e-9);
}

}  // namespace
}  // namespace capstan::rules
