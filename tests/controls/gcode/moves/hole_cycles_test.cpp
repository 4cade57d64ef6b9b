#include "planner/controls/gcode/moves/hole_cycles.h"

#include <gtest/gtest.h>

#include <memory>
#include <vector>

namespace capstan::controls::gcode {
namespace {

using geometry::Vec3;
using model::CutterPath;
using model::MoveRole;

constexpr Vec3 kStart{5, 6, 10};

model::StepResult step_of(CutterPath path) {
  model::StepResult s;
  s.feed_mm_min = 100.0;
  s.spindle_rpm = 1000.0;
  const std::size_t n = path.size();
  model::FeedSchedule f{std::vector<double>(n, 100.0), std::vector<double>(n, 1000.0),
                        std::vector<double>(n, 0.0)};
  s.path = std::make_shared<const CutterPath>(std::move(path));
  s.schedule = std::make_shared<const model::FeedSchedule>(std::move(f));
  return s;
}

/// From 10 by rapid to 6 and at feed through air to 2; pecks to `bottoms`, after each but the last by rapid
/// to 6 and down to 0.5 above it.
CutterPath cleared(const std::vector<double>& bottoms) {
  CutterPath p;
  p.start(kStart);
  p.rapid({5, 6, 6}, MoveRole::kApproach);
  p.line({5, 6, 2}, MoveRole::kApproach);
  for (std::size_t i = 0; i < bottoms.size(); ++i) {
    p.line({5, 6, bottoms[i]}, MoveRole::kDrill);
    p.rapid({5, 6, 6}, MoveRole::kRetract);
    if (i + 1 < bottoms.size()) p.line({5, 6, bottoms[i] + 0.5}, MoveRole::kLink);
  }
  p.rapid(kStart, MoveRole::kRetract);
  return p;
}

/// The same, 0.5 mm up after each peck.
CutterPath broken(const std::vector<double>& bottoms) {
  CutterPath p;
  p.start(kStart);
  p.rapid({5, 6, 2}, MoveRole::kApproach);
  for (std::size_t i = 0; i < bottoms.size(); ++i) {
    p.line({5, 6, bottoms[i]}, MoveRole::kDrill);
    if (i + 1 < bottoms.size()) p.line({5, 6, bottoms[i] + 0.5}, MoveRole::kLink);
  }
  p.rapid(kStart, MoveRole::kRetract);
  return p;
}

std::optional<HoleInPath> read(const model::StepResult& step) {
  model::Control control;
  control.decimals = 3;
  return hole_at(step, 1, kStart, control);
}

TEST(PeckedHoles, AClearedHoleIsFedFromWhereTheToolComesBackTo) {
  const auto hole = read(step_of(cleared({-10, -14, -17})));
  ASSERT_TRUE(hole);
  EXPECT_EQ(hole->last_move, 11U);
  ASSERT_TRUE(hole->cycle.pecks);
  EXPECT_EQ(*hole->cycle.pecks, (Pecks{{-10, -14}, true, 0.5, 0.0}));
  EXPECT_EQ(hole->cycle.r_z, 6.0);
  EXPECT_EQ(hole->cycle.bottom_z, -17.0);
}

TEST(PeckedHoles, AHoleWhoseChipIsBrokenIsFedFromWhereThePathIs) {
  const auto hole = read(step_of(broken({-10, -14, -17})));
  ASSERT_TRUE(hole && hole->cycle.pecks);
  EXPECT_EQ(*hole->cycle.pecks, (Pecks{{-10, -14}, false, 0.5, 0.0}));
  EXPECT_EQ(hole->cycle.r_z, 2.0);
}

TEST(PeckedHoles, PecksOfBothKindsOrWithOtherWaysBackAreNoCycle) {
  CutterPath other = cleared({-10, -14, -17});
  other.z[9] = -13.2;  // back to 0.8 above the second bottom
  EXPECT_FALSE(read(step_of(other)));
  CutterPath higher = cleared({-10, -14, -17});
  higher.z[7] = 7.0;  // and up to another height
  EXPECT_FALSE(read(step_of(higher)));
  CutterPath both = broken({-10, -14});
  const auto at = both;
  both = CutterPath();
  for (std::size_t i = 0; i < 5; ++i) {
    if (i == 0)
      both.start(at.point(0));
    else if (at.kind[i] == model::MoveKind::kRapid)
      both.rapid(at.point(i), at.role[i]);
    else
      both.line(at.point(i), at.role[i]);
  }
  both.rapid({5, 6, 2}, MoveRole::kRetract);
  both.line({5, 6, -13.5}, MoveRole::kLink);
  both.line({5, 6, -17}, MoveRole::kDrill);
  both.rapid(kStart, MoveRole::kRetract);
  EXPECT_FALSE(read(step_of(both)));
}

TEST(PeckedHoles, APeckThatIsFedOtherwiseIsNoCycle) {
  model::StepResult step = step_of(cleared({-10, -14, -17}));
  auto f = *step.schedule;
  f.feed_mm_min[6] = 80.0;  // the second peck
  step.schedule = std::make_shared<const model::FeedSchedule>(f);
  EXPECT_FALSE(read(step));
}

TEST(PeckedHoles, SizesAreThoseThatSayEveryPeck) {
  const auto sizes = [](const std::vector<double>& bottoms) {
    const auto hole = read(step_of(cleared(bottoms)));
    return hole ? peck_sizes(hole->cycle) : std::nullopt;
  };
  // From 6: the first is 16, then 4, and 3 are left.
  const auto all = sizes({-10, -14, -17});
  ASSERT_TRUE(all);
  EXPECT_EQ(all->first_mm, 16.0);
  EXPECT_EQ(all->step_mm, 4.0);
  EXPECT_FALSE(sizes({-10, -14, -19}));         // 5 at the end, where 4 were to come
  EXPECT_FALSE(sizes({-10, -14, -17, -20.5}));  // 4, 3, 3.5
  EXPECT_FALSE(sizes({-17}));                   // none
}

TEST(StoppedSpindle, ABarThatComesOutWithItIsToldFromOneThatTurns) {
  CutterPath p;
  p.start(kStart);
  p.rapid({5, 6, 2}, MoveRole::kApproach);
  p.line({5, 6, -8}, MoveRole::kDrill);
  p.rapid(kStart, MoveRole::kRetract);
  model::StepResult step = step_of(p);
  ASSERT_TRUE(read(step));
  EXPECT_FALSE(read(step)->cycle.stops);
  auto f = *step.schedule;
  f.spindle_rpm[3] = 0.0;
  step.schedule = std::make_shared<const model::FeedSchedule>(f);
  ASSERT_TRUE(read(step));
  EXPECT_TRUE(read(step)->cycle.stops);
  f.spindle_rpm[3] = 500.0;
  step.schedule = std::make_shared<const model::FeedSchedule>(f);
  EXPECT_FALSE(read(step));
}

}  // namespace
}  // namespace capstan::controls::gcode
