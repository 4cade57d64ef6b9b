#include "planner/door/report/picture/views.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <memory>

namespace capstan::report::picture {
namespace {

using geometry::Vec2;
using model::MoveRole;

/// A block of 100 x 50 x 20 mm, zero at the lower left corner of its top, and a step that goes down from
/// 5 mm above it and 50 mm to the right at 5 mm below it.
model::Plan block() {
  model::Plan plan;
  plan.stock.box = {{0.0, 0.0, -20.0}, {100.0, 50.0, 0.0}};
  plan.setups.emplace_back();
  model::CutterPath path;
  path.start({10.0, 10.0, 5.0});
  path.line({10.0, 10.0, -5.0}, MoveRole::kPlunge);
  path.line({60.0, 10.0, -5.0}, MoveRole::kCut);
  path.rapid({60.0, 10.0, 5.0});
  model::StepResult step;
  step.path = std::make_shared<model::CutterPath>(path);
  plan.steps.push_back(step);
  return plan;
}
// 520 units for the 100 mm of its length: 5.2 units per mm.
constexpr double kScale = 5.2;

const Lines& lines_of(const Group& g, std::size_t n) { return std::get<Lines>(g.shapes.at(n)); }
void expect_line(const Polyline& line, std::initializer_list<Vec2> points) {
  ASSERT_EQ(line.size(), points.size());
  for (std::size_t i = 0; i < line.size(); ++i) {
    EXPECT_NEAR(line[i].x, std::data(points)[i].x, 1e-9) << i;
    EXPECT_NEAR(line[i].y, std::data(points)[i].y, 1e-9) << i;
  }
}

TEST(Views, PutXToTheRightYUpAndTheFrontBelowInLine) {
  const Views v = views_of(block(), 0, {0}, {100.0, 200.0});
  EXPECT_NEAR(v.scale, kScale, 1e-12);
  EXPECT_NEAR(v.above({0.0, 50.0, 0.0}).x, 100.0, 1e-9);
  EXPECT_NEAR(v.above({0.0, 50.0, 0.0}).y, 200.0, 1e-9);
  EXPECT_NEAR(v.above({60.0, 10.0, 0.0}).x, 100.0 + 60.0 * kScale, 1e-9);
  EXPECT_NEAR(v.above({60.0, 10.0, 0.0}).y, 200.0 + 40.0 * kScale, 1e-9);
  // The path's 5 mm above the piece are the upper edge of the view from the front.
  const double front = 200.0 + 50.0 * kScale + kViewsApart;
  EXPECT_NEAR(v.front({60.0, 10.0, 5.0}).x, 100.0 + 60.0 * kScale, 1e-9);
  EXPECT_NEAR(v.front({60.0, 10.0, 5.0}).y, front, 1e-9);
  EXPECT_NEAR(v.front({60.0, 10.0, -5.0}).y, front + 10.0 * kScale, 1e-9);
}

TEST(Views, AreAsLargeAsTheirRoomWhateverThePieceIs) {
  model::Plan tall = block();
  tall.stock.box = {{0.0, 0.0, -400.0}, {100.0, 100.0, 0.0}};
  const Views v = views_of(tall, 0, {}, {});
  EXPECT_NEAR(v.scale, kViewsHigh / 500.0, 1e-12);
  EXPECT_NEAR(v.size.y, kViewsHigh + kViewsApart, 1e-9);
}

TEST(Views, HoldTheZeroThatIsNearAndNotOneThatIsFar) {
  model::Plan plan = block();
  plan.steps.clear();
  plan.stock.box = {{30.0, 0.0, -20.0}, {130.0, 50.0, 0.0}};
  EXPECT_EQ(views_of(plan, 0, {}, {}).box.lo.x, 0.0);
  plan.stock.box = {{3000.0, 0.0, -20.0}, {3100.0, 50.0, 0.0}};
  const Views far = views_of(plan, 0, {}, {});
  EXPECT_EQ(far.box.lo.x, 3000.0);
  const auto marks = marks_in(far);
  EXPECT_TRUE(std::none_of(marks.begin(), marks.end(), [](const Group& g) { return g.title == "zero"; }));
}

TEST(Views, LeaveThePieceItsRoomBesideALargeTable) {
  model::Plan plan = block();
  plan.setups[0].holding.solids.push_back({.id = "table",
                                           .kind = "plate",
                                           .outline = {{-900, -900}, {900, -900}, {900, 900}, {-900, 900}},
                                           .bottom_mm = -60.0,
                                           .top_mm = -20.0});
  const Views v = views_of(plan, 0, {0}, {});
  // The piece and 0.3 of its longest side on each side of it.
  EXPECT_NEAR(v.box.lo.x, -30.0, 1e-9);
  EXPECT_NEAR(v.box.hi.x, 130.0, 1e-9);
  const PieceDrawn drawn = piece_in(plan, 0, v);
  EXPECT_TRUE(drawn.fixtures);
  const Polyline& table = lines_of(drawn.groups.front(), 0).lines.front();
  for (const Vec2 p : table) {
    EXPECT_GE(p.x, -1e-6);
    EXPECT_LE(p.x, v.size.x + 1e-6);
  }
}

TEST(Views, ShowARoundPieceRoundFromAboveAndSquareFromTheFront) {
  model::Plan plan = block();
  plan.stock.box = {{-25.0, -25.0, -40.0}, {25.0, 25.0, 0.0}};
  plan.stock.cylinder_radius_mm = 25.0;
  const Views v = views_of(plan, 0, {}, {});
  const Group raw = piece_in(plan, 0, v).groups.front();
  EXPECT_EQ(raw.title, "raw piece");
  for (const Vec2 p : lines_of(raw, 0).lines.front())
    EXPECT_NEAR(geometry::norm(p - v.above({})), 25.0 * v.scale, 1e-6);
  EXPECT_EQ(lines_of(raw, 1).lines.front().size(), 4U);
}

TEST(Path, IsDrawnWhereItGoesInBothViews) {
  const model::Plan plan = block();
  const Views v = views_of(plan, 0, {0}, {});
  const Group g = path_in(plan.steps[0], kInk, v, 1000);
  ASSERT_EQ(g.shapes.size(), 5U);  // rapids, feeds from above and from the front, dots
  const double front = 50.0 * kScale + kViewsApart;
  EXPECT_TRUE(lines_of(g, 0).lines.empty());  // the rapid goes straight up
  ASSERT_EQ(lines_of(g, 1).lines.size(), 1U);
  EXPECT_TRUE(lines_of(g, 1).dashed);
  expect_line(lines_of(g, 1).lines[0], {{60.0 * kScale, front + 10.0 * kScale}, {60.0 * kScale, front}});
  ASSERT_EQ(lines_of(g, 2).lines.size(), 1U);
  EXPECT_FALSE(lines_of(g, 2).dashed);
  EXPECT_EQ(lines_of(g, 2).stroke, kInk);
  // From above the plunge has no length: its point begins the cut.
  const Polyline& cut = lines_of(g, 2).lines[0];
  EXPECT_NEAR(cut.front().x, 10.0 * kScale, 1e-9);
  EXPECT_NEAR(cut.back().x, 60.0 * kScale, 1e-9);
  EXPECT_NEAR(cut.back().y, 40.0 * kScale, 1e-9);
  expect_line(lines_of(g, 3).lines[0], {{10.0 * kScale, front},
                                        {10.0 * kScale, front + 10.0 * kScale},
                                        {60.0 * kScale, front + 10.0 * kScale}});
  const Dots& entries = std::get<Dots>(g.shapes[4]);
  ASSERT_EQ(entries.at.size(), 2U);  // one in each view
  EXPECT_NEAR(entries.at[0].x, 10.0 * kScale, 1e-9);
  EXPECT_NEAR(entries.at[0].y, 40.0 * kScale, 1e-9);
}

TEST(Path, KeepsItsArcsRound) {
  model::Plan plan = block();
  model::CutterPath path;
  path.start({70.0, 25.0, -5.0});
  path.arc({70.0, 25.0, -5.0}, {50.0, 25.0}, true, MoveRole::kCut);
  plan.steps[0].path = std::make_shared<model::CutterPath>(path);
  const Views v = views_of(plan, 0, {0}, {});
  const Group g = path_in(plan.steps[0], kInk, v, 1000);
  const Polyline& circle = lines_of(g, 2).lines.at(0);
  EXPECT_GT(circle.size(), 20U);
  for (const Vec2 p : circle)
    EXPECT_NEAR(geometry::norm(p - v.above({50.0, 25.0, 0.0})), 20.0 * v.scale, 1e-6);
}

TEST(Path, OfAStepWithoutOneIsEmpty) {
  EXPECT_TRUE(path_in({}, kInk, views_of(block(), 0, {}, {}), 1000).shapes.empty());
}

TEST(Bar, IsOfARoundLengthInTheScaleOfTheViews) {
  const Views v = views_of(block(), 0, {0}, {});
  const Group bar = marks_in(v).back();
  EXPECT_EQ(bar.title, "scale");
  // A quarter of 520 units at 5.2 units per mm is 25 mm; 20 mm is the round length below it.
  EXPECT_EQ(std::get<Words>(bar.shapes[1]).text, "20 mm");
  const Polyline& line = lines_of(bar, 0).lines[1];
  EXPECT_NEAR(line[1].x - line[0].x, 20.0 * kScale, 1e-9);
}

}  // namespace
}  // namespace capstan::report::picture
