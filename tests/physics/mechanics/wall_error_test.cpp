#include "planner/physics/mechanics/bending/wall_error.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "planner/physics/mechanics/constants.h"
#include "tests/support/mechanics/section_loads.h"
#include "tests/support/mechanics/wall_error.h"

namespace capstan::mechanics {
namespace {

constexpr double kPi = std::numbers::pi;

model::Cutter end_mill() {
  model::Cutter c;
  c.cutting_diameter_mm = 12.0;
  c.shank_diameter_mm = 12.0;
  c.maximum_depth_of_cut_mm = 26.0;
  c.stick_out_mm = 40.0;
  c.teeth = 4;
  return c;
}

double moment_mm4(double d) { return kPi * d * d * d * d / 64.0; }

const ForceLaw kLaw{.mechanistic = CuttingCoefficients{700.0, 20.0, 200.0, 15.0, 0.0, 0.0}};
const ForceLaw kSteel{.kienzle = {2298.0, 0.20}};

Tooth teeth(int n, double helix) { return {.cutting_diameter_mm = 12.0, .helix_rad = helix, .teeth = n}; }
Section side(double ap, double ae, CutDirection direction) {
  return {.ap_mm = ap, .arc = immersion_arc(ae, 12.0, direction)};
}

/// A rigid axis on a spring: every height moves alike, and the error is force over stiffness. The spring is a
/// piece of 1 mm that bends, so far above that 10 mm of height change 2e-8 of its give:
///
///     c = far^2 1 mm / (E I)
ToolBeam spring(double mm_n) {
  constexpr double kFar = 1e9, kThick = 1e6, kRigid = 1e25;
  return {.segments = {{kFar, kThick, kRigid}, {1.0, kThick, kFar * kFar / (mm_n * moment_mm4(kThick))}}};
}

TEST(WallError, OfStraightTeethByHand) {
  const ToolBeam beam = spring(1e-4);
  // Four straight teeth, slot, wall on the left. At the instant a tooth stands at 0: the one at pi / 2 has
  // the whole chip, those at 0 and pi only their edge. Fy = Ktc fz + Kte - Kre + Kre per depth, towards the
  // wall: up milling cuts into the part.
  const double fz = 0.1;
  const double ap = 3.0;
  const Section slot = side(ap, 12.0, CutDirection::kUp);
  const double force = (700.0 * fz + 20.0) * ap;
  const WallError up = *wall_error(slot, teeth(4, 0.0), kLaw, fz, WallSide::kLeft, beam);
  for (const double e : up.error_mm) EXPECT_NEAR(e, -1e-4 * force, 1e-9);
  EXPECT_NEAR(up.largest_mm(), -1e-4 * force, 1e-9);
  EXPECT_EQ(up.most_left_mm, 0.0);
  // The same teeth against the wall on the right: the same force now pulls away from it; material is left.
  const WallError down = *wall_error(slot, teeth(4, 0.0), kLaw, fz, WallSide::kRight, beam);
  for (const double e : down.error_mm) EXPECT_NEAR(e, 1e-4 * force, 1e-9);
  // Down milling with one tooth in the cut: the edge's radial force alone, Kre ap, away from the wall.
  const WallError alone =
      *wall_error(side(ap, 2.0, CutDirection::kDown), teeth(2, 0.0), kLaw, fz, WallSide::kRight, beam);
  EXPECT_NEAR(alone.largest_mm(), 1e-4 * 15.0 * ap, 1e-9);
}

TEST(WallError, OfOneHelicalToothByHand) {
  // One tooth, down milling, the edge at height z leaves at pi: what is above lags and still cuts. With the
  // spring, error(z) = c int_0^{s} Fy(pi - k u) du, s = min(ap - z, phi / k), k the lag per height;
  // Fy(pi - b) = (Ktc fz sin b + Kte) sin b + (Krc fz sin b + Kre) cos b.
  const double helix = 0.6;
  const double ap = 6.0;
  const double fz = 0.08;
  const Section s = side(ap, 2.0, CutDirection::kDown);
  const double phi = s.arc.exit_rad - s.arc.entry_rad;
  const double k = std::tan(helix) / 6.0;
  const auto integral = [&](double b) {
    return (700.0 * fz * (0.5 * b - 0.25 * std::sin(2.0 * b)) + 20.0 * (1.0 - std::cos(b)) +
            200.0 * fz * 0.5 * std::sin(b) * std::sin(b) + 15.0 * std::sin(b)) /
           k;
  };
  const WallError e = *wall_error(s, teeth(1, helix), kLaw, fz, WallSide::kRight, spring(1e-4));
  const double largest = 1e-4 * integral(std::min(phi, k * ap));
  for (std::size_t i = 0; i < WallError::kHeights; ++i) {
    const double b = std::min(phi, k * (ap - e.height_mm[i]));
    EXPECT_NEAR(e.error_mm[i], 1e-4 * integral(b), 0.005 * largest) << e.height_mm[i];
  }
  // The top of the contact is generated last, by an edge that cuts nothing any more.
  EXPECT_NEAR(e.error_mm.back(), 0.0, 1e-3 * largest);
}

/// The same by thin slices of the edge, Kienzle's law, any beam.
double sliced(const Section& s, const Tooth& t, double fz, bool right, const ToolBeam& beam, double above) {
  constexpr int kSlices = 4000;
  double bend = 0.0;
  for (int i = 0; i < kSlices; ++i) {
    const double at = s.ap_mm * (i + 0.5) / kSlices;
    for (int j = 0; j < t.teeth; ++j) {
      double a = (right ? kPi : 0.0) + 2.0 * kPi * j / t.teeth +
                 2.0 * (above - at) * std::tan(t.helix_rad) / t.cutting_diameter_mm;
      a -= 2.0 * kPi * std::floor(a / (2.0 * kPi));
      if (a < s.arc.entry_rad || a > s.arc.exit_rad || !(std::sin(a) > 0.0)) continue;
      const double h = fz * std::sin(a);
      const double ft = specific_force_n_mm2(kSteel.kienzle, h) * h * s.ap_mm / kSlices;
      bend += (ft * std::sin(a) - kRadialToTangentialRatio * ft * std::cos(a)) *
              bending_mm_n(beam, s.from_tip_mm + at, s.from_tip_mm + above);
    }
  }
  return right ? bend : -bend;
}

TEST(WallError, AgreesWithThinSlicesOfALongHelix) {
  const ToolBeam beam = beam_of(end_mill()).value();
  for (const double helix : {0.3, 0.7, 1.1}) {
    for (const double ae : {0.4, 3.0, 12.0}) {
      const Section s = side(14.0, ae, CutDirection::kDown);
      const WallError e = *wall_error(s, teeth(3, helix), kSteel, 0.05, WallSide::kRight, beam);
      const double largest = std::max(e.most_left_mm, -e.most_over_mm);
      for (std::size_t i = 0; i < WallError::kHeights; ++i) {
        const double exact = sliced(s, teeth(3, helix), 0.05, true, beam, e.height_mm[i]);
        EXPECT_NEAR(e.error_mm[i], exact, 0.01 * largest) << helix << " " << ae << " " << e.height_mm[i];
      }
    }
  }
}

TEST(WallError, LeavesMaterialInDownMillingAndOvercutsInUpMilling) {
  // The usual finding for a quarter immersion and a helix that keeps more than one height in the cut.
  const ToolBeam beam = beam_of(end_mill()).value();
  for (const ForceLaw* law : {&kLaw, &kSteel}) {
    const WallError down =
        *wall_error(side(10.0, 3.0, CutDirection::kDown), teeth(4, 0.5), *law, 0.06, WallSide::kRight, beam);
    EXPECT_GT(down.most_left_mm, 0.0);
    EXPECT_EQ(down.most_over_mm, 0.0);
    const WallError up =
        *wall_error(side(10.0, 6.0, CutDirection::kUp), teeth(4, 0.5), *law, 0.06, WallSide::kLeft, beam);
    EXPECT_LT(up.most_over_mm, 0.0);
  }
}

TEST(WallError, IsBoundedByThePeakForceAtTheTip) {
  const ToolBeam beam = beam_of(end_mill()).value();
  for (const double ap : {1.0, 5.0, 15.0}) {
    for (const double helix : {0.0, 0.4, 0.8}) {
      const Section s = side(ap, 2.5, CutDirection::kDown);
      const double peak = section_loads(s, teeth(3, helix), kSteel, 0.05, 5000.0)->peak_force_n;
      const WallError e = *wall_error(s, teeth(3, helix), kSteel, 0.05, WallSide::kRight, beam);
      EXPECT_LE(std::abs(e.largest_mm()), 1.02 * peak * bending_mm_n(beam, 0.0, 0.0));
    }
  }
}

TEST(WallError, NeedsAnArcThatReachesTheWall) {
  const ToolBeam beam = beam_of(end_mill()).value();
  const auto e =
      wall_error(side(3.0, 3.0, CutDirection::kUp), teeth(4, 0.5), kLaw, 0.06, WallSide::kRight, beam);
  EXPECT_EQ(e.error().path, "arc");
  const auto nan = wall_error(side(std::numeric_limits<double>::quiet_NaN(), 3.0, CutDirection::kUp),
                              teeth(4, 0.5), kLaw, 0.06, WallSide::kLeft, beam);
  EXPECT_EQ(nan.error().code, "MECH-DOMAIN");
  EXPECT_EQ(wall_error({}, teeth(4, 0.5), kLaw, 0.06, WallSide::kLeft, beam)->largest_mm(), 0.0);
}

// The feed stands outside of the integrals: by Kienzle's law every height's error is that of fz = 1 mm times
// fz^(1 - mc), by measured coefficients a straight line in fz.
TEST(WallAtFeeds, GrowsWithTheFeedAsTheForceLawDoes) {
  const ToolBeam beam = beam_of(end_mill()).value();
  const Section s = side(10.0, 3.0, CutDirection::kDown);
  const auto at = [&](const ForceLaw& law, double fz) {
    return WallAtFeeds::of(s, teeth(4, 0.5), law, WallSide::kRight, beam).value().at(fz).value();
  };
  for (std::size_t i = 0; i < WallError::kHeights; ++i) {
    const double by_kienzle = at(kSteel, 0.02).error_mm[i];
    EXPECT_NEAR(at(kSteel, 0.08).error_mm[i], by_kienzle * std::pow(4.0, 0.8), 1e-12);
    const double middle = 0.5 * (at(kLaw, 0.02).error_mm[i] + at(kLaw, 0.08).error_mm[i]);
    EXPECT_NEAR(at(kLaw, 0.05).error_mm[i], middle, 1e-12);
    EXPECT_EQ(at(kLaw, 0.05).height_mm[i], 10.0 * static_cast<double>(i) / (WallError::kHeights - 1));
  }
}

TEST(WallAtFeeds, NeedsAFeed) {
  const auto wall = WallAtFeeds::of(side(3.0, 3.0, CutDirection::kDown), teeth(4, 0.5), kLaw, WallSide::kRight,
                                    beam_of(end_mill()).value());
  ASSERT_TRUE(wall);
  EXPECT_EQ(wall->at(0.0).error().path, "fz_mm");
}

}  // namespace
}  // namespace capstan::mechanics
