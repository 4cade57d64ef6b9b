#include "tooling/library/cutters/complete.h"

#include <gtest/gtest.h>

#include <string>

#include "tooling/library/cutters/generic.h"

namespace capstan::tooling {
namespace {

/// A thread mill of 6 mm with teeth over `rows_mm`, used to 20 mm.
model::Cutter thread_mill(double pitch_mm, double rows_mm) {
  model::Cutter c;
  c.id = "shop";
  c.cutter_class = model::CutterClass::kThreadMill;
  c.substrate = model::Substrate::kCarbide;
  c.cutting_diameter_mm = c.shank_diameter_mm = 6.0;
  c.thread_pitch_mm = pitch_mm;
  c.maximum_depth_of_cut_mm = rows_mm;
  c.usable_length_mm = 20.0;
  c.teeth = 3;
  return c;
}

model::Cutter completed(model::Cutter c) {
  complete(c, shared_generic_library().value());
  return c;
}

// Thinner by twice the profile's 0.65 pitch and by 0.1 mm on either side: 6 - 1.3 x 1.25 - 0.2 = 4.175.
TEST(Complete, AThreadMillOfOneProfileStandsOnANeckThatClearsItsThread) {
  const model::Cutter c = completed(thread_mill(1.25, 1.25));
  EXPECT_NEAR(c.neck_diameter_mm, 4.175, 1e-9);
  EXPECT_EQ(c.neck_length_mm, 20.0);
}

TEST(Complete, AThreadMillOfManyProfilesHasNoNeckThatNobodyStated) {
  EXPECT_EQ(completed(thread_mill(1.25, 10.0)).neck_diameter_mm, 0.0);
}

TEST(Complete, AStatedNeckStays) {
  model::Cutter c = thread_mill(1.25, 1.25);
  c.neck_diameter_mm = 3.5;
  c.neck_length_mm = 12.0;
  const model::Cutter out = completed(c);
  EXPECT_EQ(out.neck_diameter_mm, 3.5);
  EXPECT_EQ(out.neck_length_mm, 12.0);
}

// A pitch of 4.5 mm takes 6.05 mm: nothing is left for a neck, and none is invented.
TEST(Complete, AThreadMillWithoutRoomForANeckGetsNone) {
  EXPECT_EQ(completed(thread_mill(4.5, 4.5)).neck_diameter_mm, 0.0);
}

}  // namespace
}  // namespace capstan::tooling
