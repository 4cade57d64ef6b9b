#include <gtest/gtest.h>

#include <numbers>
#include <vector>

#include "planner/making/optimise/feeds.h"
#include "planner/physics/mechanics/life/arc_speed.h"
#include "tests/making/optimise/cut/questions.h"

namespace capstan::optimise {
namespace {

constexpr double kNarrow = 1.0;  // a tenth of the diameter
constexpr double kFaster = 1.35;
constexpr double kPi = std::numbers::pi;

/// A ramp, a narrow cut, a slot and a rapid.
model::CutterPath path() {
  model::CutterPath p;
  p.start({0, 0, 10});
  p.line({20, 0, -5}, model::MoveRole::kRamp);
  p.line({40, 0, -5}, model::MoveRole::kCut);
  p.line({60, 0, -5}, model::MoveRole::kCut);
  p.rapid({60, 0, 10}, model::MoveRole::kRetract);
  return p;
}

FeedQuestion asked() {
  FeedQuestion q;
  q.cut = questions::roughing();
  q.cut.material.iso_group = "P";
  q.cut.constant_engagement = true;
  q.n_rpm = 5000.0;
  q.feed_mm_min = 2000.0;
  q.feed_factor.assign(5, 1.0);
  q.speed_factor.assign(5, 1.0);
  q.samples = {{.move = 2, .ap_mm = 5.0, .ae_mm = kNarrow}, {.move = 3, .ap_mm = 5.0, .ae_mm = 10.0}};
  return q;
}

TEST(EntryAsASlot, TurnsAtTheTablesSpeedWhereTheCutIsWide) {
  FeedQuestion q = asked();
  enter_as_a_slot(q, kNarrow, path());
  EXPECT_NEAR(q.speed_factor[1], 1.0 / kFaster, 1e-9);  // the ramp
  EXPECT_EQ(q.speed_factor[2], 1.0);
  EXPECT_NEAR(q.speed_factor[3], 1.0 / kFaster, 1e-9);  // the slot
  EXPECT_EQ(q.speed_factor[4], 1.0);
}

TEST(EntryAsASlot, FeedsNoMoreThanTheTablesFeedPerTooth) {
  FeedQuestion q = asked();
  enter_as_a_slot(q, kNarrow, path());
  const double wide = q.cut.fz_start_mm * q.cut.cutter.teeth * q.n_rpm / kFaster;
  EXPECT_NEAR(q.feed_factor[1] * q.feed_mm_min, wide, 1e-6);
  EXPECT_EQ(q.feed_factor[2], 1.0);
}

TEST(EntryAsASlot, ChangesNothingOfRings) {
  FeedQuestion q = asked();
  q.cut.constant_engagement = false;
  q.feed_mm_min = 1000.0;
  enter_as_a_slot(q, kNarrow, path());
  EXPECT_EQ(q.speed_factor, std::vector<double>(5, 1.0));
  EXPECT_EQ(q.feed_factor, std::vector<double>(5, 1.0));
}

/// Rings of a cutter of 10 mm: a slot 10 mm deep, as deep a wide cut that is none, and a slot 5 mm deep.
FeedQuestion rings() {
  FeedQuestion q = asked();
  q.cut.constant_engagement = false;
  q.cut.vc_table_m_min = kPi * q.cut.cutter.cutting_diameter_mm * q.n_rpm / 1000.0;
  q.samples = {{.move = 1, .ap_mm = 10.0, .ae_mm = 10.0, .step_mm = 20.0, .exit_rad = kPi},
               {.move = 2, .ap_mm = 10.0, .ae_mm = 9.0, .step_mm = 20.0, .exit_rad = 0.8 * kPi},
               {.move = 3, .ap_mm = 5.0, .ae_mm = 10.0, .step_mm = 20.0, .exit_rad = kPi}};
  return q;
}

// Dormer Pramet, milling catalogue 2021-22, p. 114: 0.75 of the speed at 1 D, all of it at 0.5 D.
TEST(DeepSlots, AreCutAtThreeQuartersOfTheTablesSpeedWhereOneDiameterDeep) {
  FeedQuestion q = rings();
  slow_in_deep_slots(q);
  EXPECT_NEAR(q.speed_factor[1], 0.75, 1e-9);
  EXPECT_EQ(q.speed_factor[2], 1.0);
  EXPECT_EQ(q.speed_factor[3], 1.0);
}

// A ramp ends 10 mm deep: 0.75 of the speed there, 0.875 where it is 7.5 mm deep (linear between 0.5 D and 1
// D).
TEST(DeepSlots, HaveOneSpeedFromEndToEndWhichIsThatOfTheirDeepestPlace) {
  FeedQuestion q = rings();
  q.samples = {{.move = 1, .ap_mm = 7.5, .ae_mm = 10.0, .step_mm = 20.0, .exit_rad = kPi},
               {.move = 2, .ap_mm = 10.0, .ae_mm = 10.0, .step_mm = 20.0, .exit_rad = kPi},
               {.move = 3, .ap_mm = 10.0, .ae_mm = 9.0, .step_mm = 20.0, .exit_rad = 0.8 * kPi}};
  slow_in_deep_slots(q);
  EXPECT_NEAR(q.speed_factor[1], 0.75, 1e-9);
  EXPECT_NEAR(q.speed_factor[2], 0.75, 1e-9);
  EXPECT_EQ(q.speed_factor[3], 1.0);
}

TEST(DeepSlots, HaveTheSpeedOfAMoveThatWasSlowerAlready) {
  FeedQuestion q = rings();
  q.samples[1] = {.move = 2, .ap_mm = 10.0, .ae_mm = 10.0, .step_mm = 20.0, .exit_rad = kPi};
  q.speed_factor[2] = 0.5;
  slow_in_deep_slots(q);
  EXPECT_EQ(q.speed_factor[2], 0.5);
  EXPECT_NEAR(q.speed_factor[1], 0.5, 1e-9);
}

TEST(DeepSlots, AreNotCutMoreSlowlyWhereTheSpindleIsSlowerThanThatAlready) {
  FeedQuestion q = rings();
  q.cut.vc_table_m_min *= 2.0;
  slow_in_deep_slots(q);
  EXPECT_EQ(q.speed_factor, std::vector<double>(5, 1.0));
}

TEST(DeepSlots, ThatAreShorterThanADiameterInAllTheirMovesKeepTheSpeed) {
  FeedQuestion q = rings();
  q.samples[0].step_mm = 4.0;
  q.samples[1] = {.move = 2, .ap_mm = 10.0, .ae_mm = 10.0, .step_mm = 5.0, .exit_rad = kPi};
  slow_in_deep_slots(q);
  EXPECT_EQ(q.speed_factor, std::vector<double>(5, 1.0));
  q.samples[1].step_mm = 6.0;
  slow_in_deep_slots(q);
  EXPECT_NEAR(q.speed_factor[1], 0.75, 1e-9);
  EXPECT_NEAR(q.speed_factor[2], 0.75, 1e-9);
}

TEST(DeepSlots, AreCutNoMoreSlowlyThanTheSpindleTurns) {
  FeedQuestion q = rings();
  q.cut.machine.spindle.rpm_min = 0.9 * q.n_rpm;
  slow_in_deep_slots(q);
  EXPECT_NEAR(q.speed_factor[1], 0.9, 1e-9);
}

TEST(DeepSlots, OfAStepThatIsAllSlotHaveItsSpeedWhichHasTheirShare) {
  FeedQuestion q = rings();
  q.cut.slot = true;
  slow_in_deep_slots(q);
  EXPECT_EQ(q.speed_factor, std::vector<double>(5, 1.0));
}

}  // namespace
}  // namespace capstan::optimise
