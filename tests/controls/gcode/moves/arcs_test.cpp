#include "planner/controls/gcode/moves/arcs.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "planner/ground/base/number.h"

namespace capstan::controls::gcode {
namespace {

using geometry::Vec3;
using model::CutterPath;
using model::MoveRole;

Vec3 on_circle(geometry::Vec2 centre, double radius, double angle) {
  return {centre.x + radius * std::cos(angle), centre.y + radius * std::sin(angle), 0.0};
}

Vec3 rounded_point(Vec3 p, int decimals) {
  return {rounded(p.x, decimals), rounded(p.y, decimals), rounded(p.z, decimals)};
}

TEST(GcodeArcsProperty, RadiiAgreeWithinTheLastDecimalAndNoPieceIsLongerThanHalfATurn) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> place(-100.0, 100.0), size(1.0, 80.0), angle(0.0, 6.28);
  for (int i = 0; i < 2000; ++i) {
    const int decimals = 2 + i % 4;
    const double unit = std::pow(10.0, -decimals);
    const geometry::Vec2 centre{place(random), place(random)};
    const double radius = size(random);
    CutterPath path;
    path.start(on_circle(centre, radius, angle(random)));
    path.arc(on_circle(centre, radius, angle(random)), centre, i % 2 == 0, MoveRole::kCut);
    Vec3 at = rounded_point(path.point(0), decimals);
    const auto pieces = arc_pieces(path, 1, at, {.decimals = decimals});
    ASSERT_TRUE(pieces) << to_text(pieces.error());
    for (const ArcPiece& p : *pieces) {
      const double first = std::hypot(p.i, p.j);
      const double last = std::hypot(at.x + p.i - p.to.x, at.y + p.j - p.to.y);
      EXPECT_TRUE(p.line || std::abs(first - last) <= unit) << i << ": " << first << ", " << last;
      at = p.to;
    }
    EXPECT_EQ(pieces->size(), model::arc_sweep(path, 1) > 3.1415936 ? 2U : 1U) << i;
    EXPECT_EQ(at, rounded_point(path.point(1), decimals)) << i;
  }
}

TEST(GcodeArcsProperty, CloseWithin2MicrometresAndStayThatNearToThePlansWhereCentresHaveTheDecimalsOfEnds) {
  constexpr double kClosureMm = 0.002;
  std::mt19937 random(11);
  std::uniform_real_distribution<double> place(-300.0, 300.0), size(0.5, 120.0), angle(0.0, 6.28);
  for (int i = 0; i < 20000; ++i) {
    const geometry::Vec2 centre{place(random), place(random)};
    const double radius = size(random);
    CutterPath path;
    path.start(on_circle(centre, radius, angle(random)));
    path.arc(on_circle(centre, radius, angle(random)), centre, i % 2 == 0, MoveRole::kCut);
    Vec3 at = rounded_point(path.point(0), 3);
    const ArcForm form{.decimals = 3,
                       .more_centre_decimals = 0,
                       .closure_mm = kClosureMm,
                       .quadrants = i % 4 < 2,
                       .largest_radius_mm = 0.0};
    const auto pieces = arc_pieces(path, 1, at, form);
    ASSERT_TRUE(pieces) << to_text(pieces.error());
    for (const ArcPiece& p : *pieces) {
      if (!p.line) {
        const geometry::Vec2 c = xy(at) + geometry::Vec2{p.i, p.j};
        EXPECT_LE(std::abs(norm(xy(at) - c) - norm(xy(p.to) - c)), kClosureMm);
        const geometry::Vec2 u = (1.0 / norm(xy(p.to) - xy(at))) * (xy(p.to) - xy(at));
        // The arc's middle, on the side that the centre is not, or that it is in more than half a turn.
        const geometry::Vec2 out{-u.y, u.x};
        const double r = 0.5 * (norm(xy(at) - c) + norm(xy(p.to) - c));
        const geometry::Vec2 a = c + r * out, b = c - r * out;
        EXPECT_LE(std::min(std::abs(norm(a - centre) - radius), std::abs(norm(b - centre) - radius)),
                  kClosureMm)
            << radius;
      }
      at = p.to;
    }
  }
}

TEST(GcodeArcs, OneFlatterThanTheLastDecimalIsALine) {
  CutterPath path;
  path.start({0, 0, 0});
  // Sagitta of a chord of 1 mm at a radius of 10 m: 1 / (8 * 10000) = 0.0000125 mm.
  const double y = std::sqrt(10000.0 * 10000.0 - 0.25);
  path.arc({1, 0, 0}, {0.5, y}, false, MoveRole::kCut);
  const auto pieces = arc_pieces(path, 1, {0, 0, 0}, {.decimals = 4});
  ASSERT_TRUE(pieces);
  ASSERT_EQ(pieces->size(), 1U);
  EXPECT_TRUE(pieces->front().line);
}

TEST(GcodeArcs, ThePlansOwnRadiiMustAgree) {
  CutterPath path;
  path.start({10, 0, 0});
  path.arc({0, 10.01, 0}, {0, 0}, false, MoveRole::kCut);
  const auto pieces = arc_pieces(path, 1, {10, 0, 0}, {.decimals = 4});
  ASSERT_FALSE(pieces);
  EXPECT_EQ(pieces.error().code, "OUT-ARC");
}

}  // namespace
}  // namespace capstan::controls::gcode
