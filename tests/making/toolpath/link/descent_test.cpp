#include "planner/making/toolpath/link/descent.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "planner/ground/base/number.h"
#include "planner/making/toolpath/link/path_writer.h"
#include "tests/making/toolpath/path_helpers.h"

namespace capstan::toolpath {
namespace {

using geometry::Vec2;
using geometry::Vec3;

constexpr double kSlope = 7.0 * std::numbers::pi / 180.0;
constexpr int kDecimals = 4;
constexpr double kDigit = 1e-4;

Vec3 written(Vec3 p) { return {rounded(p.x, kDecimals), rounded(p.y, kDecimals), rounded(p.z, kDecimals)}; }

/// The steepest of the ramping lines and arcs as a program of so many decimals writes them.
double steepest(const model::CutterPath& path) {
  double out = 0.0;
  for (std::size_t i = 1; i < path.size(); ++i) {
    if (path.role[i] != model::MoveRole::kRamp) continue;
    const Vec3 a = written(path.point(i - 1)), b = written(path.point(i));
    double along = norm(xy(b) - xy(a));
    if (path.kind[i] == model::MoveKind::kArcCcw) {
      const double r = norm(xy(b) - xy(written({path.cx[i], path.cy[i], 0.0})));
      along = 2.0 * r * std::asin(std::min(1.0, 0.5 * along / r));  // shorter arcs only
    }
    if (a.z > b.z) out = std::max(out, std::atan2(a.z - b.z, along));
  }
  return out;
}

/// A ring of 40 x 25 mm whose corners are rounded by arcs of 0.002 to 0.8 mm, at places of many digits.
Track ring() {
  Track t{.start = {1.0 / 3.0, std::sqrt(2.0)}, .segments = {}, .closed = true};
  Vec2 at = t.start;
  double bearing = 0.1;
  for (int side = 0; side < 4; ++side) {
    at = at + (side % 2 == 0 ? 40.0 : 25.0) * Vec2{std::cos(bearing), std::sin(bearing)};
    t.segments.push_back({.to = at, .centre = {}});
    for (const double piece : {0.002, 0.01, 0.03, 0.1, 0.3, 0.8}) {
      const double turn = std::numbers::pi / 12.0, radius = piece / turn;
      const Vec2 centre = at + radius * Vec2{-std::sin(bearing), std::cos(bearing)};
      bearing += turn;
      at = centre - radius * Vec2{-std::sin(bearing), std::cos(bearing)};
      t.segments.push_back({.to = at, .centre = centre, .bend = Bend::kCcw});
    }
  }
  t.segments.push_back({.to = t.start, .centre = {}});
  return t;
}

TEST(Descent, IsNoSteeperInTheDigitsOfTheProgram) {
  const Track t = ring();
  const Descent descent(kSlope, kDigit);
  const double length = length_of(t);
  PathJob job;
  job.security_z_mm = job.retract_z_mm = 50.0;
  PathWriter w(job);
  w.over(t.start);
  for (int i = 0; i < 40; ++i) {
    const Vec3 p = w.at();
    w.follow_down(t, p.z - descent.of(t), descent, model::MoveRole::kRamp);
  }
  EXPECT_LE(steepest(w.path()), kSlope);
  // And no flatter than a digit and the ends' rounding ask: 25 pieces of 10 digits of height each.
  EXPECT_GT(descent.of(t), std::tan(kSlope) * length - 25 * 10 * kDigit);
}

TEST(Descent, KeepsAPieceLevelThatIsTooShortForADigit) {
  const Descent descent(kSlope, kDigit);
  EXPECT_EQ(descent.of(kDigit / std::tan(kSlope)), 0.0);
  EXPECT_GT(descent.of(2.0 * kDigit / std::tan(kSlope)), 0.0);
}

TEST(Descent, GoesDownByADropOverTheLengthThatItNames) {
  const Track t = ring();
  const Descent descent(kSlope, kDigit);
  for (const double share : {0.05, 0.3, 0.5, 0.99}) {
    const double drop = share * descent.of(t);
    const Track part = part_of(t, 0.0, descent.length_for(t, drop));
    EXPECT_NEAR(descent.of(part), drop, 1e-9) << share;
  }
  EXPECT_EQ(descent.length_for(t, 2.0 * descent.of(t)), length_of(t));
}

}  // namespace
}  // namespace capstan::toolpath
