#include "planner/controls/gcode/moves/helices.h"

#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <numbers>
#include <optional>
#include <vector>

#include "planner/ground/base/number.h"

namespace capstan::controls::gcode {
namespace {

constexpr double kPi = std::numbers::pi;
constexpr ArcForm kForm{.decimals = 3};

/// Arcs counter-clockwise about (1, 2) from its right, of these angles, 0.4 mm down for each half turn.
model::StepResult step_of(const std::vector<double>& angles, double radius = 4.0) {
  model::CutterPath p;
  double turned = 0.0;
  const auto at = [&] {
    return geometry::Vec3{1 + radius * std::cos(turned), 2 + radius * std::sin(turned), -0.4 * turned / kPi};
  };
  p.start(at());
  for (const double a : angles) {
    turned += a;
    p.arc(at(), {1, 2}, false, model::MoveRole::kRamp);
  }
  model::StepResult s;
  s.feed_mm_min = 500.0;
  s.spindle_rpm = 3000.0;
  s.path = std::make_shared<const model::CutterPath>(std::move(p));
  return s;
}

geometry::Vec2 rounded_start(const model::StepResult& step) {
  return {rounded(step.path->x[0], kForm.decimals), rounded(step.path->y[0], kForm.decimals)};
}

std::optional<Helix> helix_of(const model::StepResult& step) {
  const geometry::Vec2 start = rounded_start(step);
  return helix_at(step, 1, {start.x, start.y, 0.0}, kForm);
}

TEST(Helices, CountTheTurnsBeyondTheArcThatEndsThem) {
  struct Case {
    std::vector<double> angles;
    int further;
  };
  for (const Case& c : {Case{{kPi, kPi, kPi}, 1}, Case{{kPi, kPi, kPi, kPi}, 1},
                        Case{{kPi, kPi, kPi, kPi, 0.5 * kPi}, 2}, Case{{2.0 * kPi, 2.0 * kPi, kPi}, 2}}) {
    const auto h = helix_of(step_of(c.angles));
    ASSERT_TRUE(h);
    EXPECT_EQ(h->further_turns, c.further);
    EXPECT_EQ(h->last_move, c.angles.size());
  }
}

TEST(Helices, OfOneTurnOrLevelOrOfArcsThatEndElsewhereAreNone) {
  EXPECT_FALSE(helix_of(step_of({kPi, kPi})));
  // Its second arc ends at a third of a turn: what follows cannot be held against half turns.
  EXPECT_FALSE(helix_of(step_of({kPi, 0.7 * kPi, kPi, kPi})));
  auto level = step_of({kPi, kPi, kPi});
  model::CutterPath p = *level.path;
  for (double& z : p.z) z = 0.0;
  level.path = std::make_shared<const model::CutterPath>(std::move(p));
  EXPECT_FALSE(helix_of(level));
}

TEST(Helices, EndWhereTheFeedChanges) {
  auto step = step_of({kPi, kPi, kPi, kPi, kPi});
  model::FeedSchedule s{std::vector<double>(6, 500.0), std::vector<double>(6, 3000.0),
                        std::vector<double>(6, 0.0)};
  s.feed_mm_min[4] = s.feed_mm_min[5] = 400.0;
  step.schedule = std::make_shared<const model::FeedSchedule>(s);
  const auto h = helix_of(step);
  ASSERT_TRUE(h);
  EXPECT_EQ(h->last_move, 3U);
}

// Both radii of the block agree within what I and J are rounded by, and stay within a unit of the path's.
TEST(Helices, HaveACentreThatIsAsFarFromBothRoundedEnds) {
  int found = 0;
  for (double radius = 0.7; radius < 40.0; radius *= 1.37) {
    const auto step = step_of({kPi, kPi, kPi, 0.37 * kPi}, radius);
    const auto h = helix_of(step);
    if (!h) continue;  // its centre would move too far
    ++found;
    const geometry::Vec2 start = rounded_start(step), centre = start + geometry::Vec2{h->i, h->j};
    const double first = norm(start - centre), last = norm(geometry::Vec2{h->to.x, h->to.y} - centre);
    EXPECT_NEAR(first, last, 2e-5) << radius;
    EXPECT_NEAR(first, radius, 1e-3) << radius;
    EXPECT_NEAR(norm(centre - geometry::Vec2{1, 2}), 0.0, 0.5e-3 + 1e-5) << radius;
  }
  EXPECT_GT(found, 5);
}

}  // namespace
}  // namespace capstan::controls::gcode
