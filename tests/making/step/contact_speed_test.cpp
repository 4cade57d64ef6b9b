#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "planner/making/step/path/surface.h"

// The speed of a cutter that touches with less than its full diameter.

namespace capstan::step {
namespace {

/// A bull nose of 16 mm with a corner of 4 mm whose path touches up to `top_mm` above its tip.
optimise::CutQuestion asked(double top_mm, double corner_mm) {
  optimise::CutQuestion q;
  q.cutter.cutter_class = model::CutterClass::kBullnoseEndmill;
  q.cutter.cutting_diameter_mm = 16.0;
  q.cutter.corner_radius_mm = corner_mm;
  q.cutter.teeth = 4;
  q.vc_start_m_min = 100.0;  // what the spindle gives the full diameter
  q.vc_table_m_min = 150.0;
  optimise::CutSample s;
  s.ap_mm = s.top_mm = top_mm;
  s.ae_mm = s.csa_mm2 = s.step_mm = 0.5;
  ask_as_measured(std::vector<optimise::CutSample>(4, s), q);
  return q;
}

// By hand: the corner's circle, 4 mm about a point 4 mm above the tip and 4 mm off the axis: 1 mm up it is
// sqrt(16 - 9) wide, 13.2915 mm across; 4 mm up and above the cutter has its full width.
TEST(ContactSpeed, OfABullNoseIsThatOfTheCircleItTouchesWith) {
  const auto low = asked(1.0, 4.0);
  EXPECT_NEAR(low.speed_diameter_mm, 8.0 + 2.0 * std::sqrt(7.0), 1e-9);
  EXPECT_EQ(low.vc_start_m_min, 150.0) << "the table's speed is asked for there";
  EXPECT_NEAR(asked(4.0, 4.0).speed_diameter_mm, 16.0, 1e-9);
  EXPECT_NEAR(asked(1.0, 0.0).speed_diameter_mm, 16.0, 1e-9) << "a flat end";
  EXPECT_EQ(asked(1.0, 0.0).vc_start_m_min, 100.0);
}

}  // namespace
}  // namespace capstan::step
