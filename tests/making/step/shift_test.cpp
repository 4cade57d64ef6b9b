#include "planner/making/step/cut/shift.h"

#include <gtest/gtest.h>

#include "planner/ground/vocabulary/noun_kind.h"

namespace capstan::step {
namespace {

/// A pocket of 60 x 40 mm, 8 mm deep, in a block of 80 x 60 x 20 whose top is at z = 0.
struct Pocket {
  toolpath::PathJob job;
  optimise::CutQuestion question;
  optimise::CutAnswer cut;
  stock::HeightMap map = stock::from_box({{0.0, 0.0, -20.0}, {80.0, 60.0, 0.0}}, 1.0);
  draft::StepDraft step;

  explicit Pocket(double feed_mm_min) {
    job.shape.kind = model::ShapeKind::kPocket;
    job.shape.depth_mm = 8.0;
    job.shape.area = geometry::rectangle({-30.0, -20.0}, {30.0, 20.0});
    job.feature_in_setup.origin = {40.0, 30.0, 0.0};
    question.cutter.cutting_diameter_mm = 2.0;
    question.cutter.teeth = 2;
    question.fz_start_mm = 0.01;
    cut.ap_mm = 0.5;
    cut.ae_mm = 0.2;
    cut.n_rpm = 6000.0;
    cut.feed_mm_min = feed_mm_min;
    step.proposed = true;
    step.operation.type = model::TypeId::kBottomAndSideRoughMilling;
  }
  [[nodiscard]] double seconds() const { return least_clearing_s(job, question, cut, map); }
};

// By hand: 2400 mm2 of area and 200 mm of outline 2 mm wide leave 2000 mm2, 16000 mm3. At 5 mm/min passes
// take 0.5 * 0.2 * 5 = 0.5 mm3/min, at most twice that: 16000 min.
TEST(LeastClearing, IsTheVolumeAwayFromTheWallsOverTwiceTheRate) {
  EXPECT_NEAR(Pocket(5.0).seconds(), 16000.0 * 60.0, 1e-3);
}

// 3 * 2 * 6000 * 0.01 = 360 mm/min; 16000 / (0.5 * 0.2 * 360) = 444.4 min.
TEST(LeastClearing, CountsNoFeedAboveThatOfTheThinnestChips) {
  EXPECT_NEAR(Pocket(300.0).seconds(), 60.0 * 16000.0 / 36.0, 1e-3);
}

TEST(LeastClearing, CountsOnlyMaterialThatIsThere) {
  Pocket half(5.0);
  // Half of the pocket was taken away before: 9600 of 19200 mm3 stand above its floor.
  for (int iy = 0; iy < half.map.ny; ++iy) {
    for (int ix = 0; ix < 40; ++ix) half.map.set(ix, iy, {12.0F, 12.0F, 0.0F});
  }
  EXPECT_NEAR(half.seconds(), (0.5 * 19200.0 - 3200.0) * 60.0, 1e-3);
}

TEST(LeastClearing, KnowsNothingOfARestOrAPocketAsNarrowAsItsSlots) {
  Pocket rest(5.0);
  rest.job.cleared_by = toolpath::Cleared{10.0, 0.0, 0.0};
  EXPECT_EQ(rest.seconds(), 0.0);
  Pocket narrow(5.0);
  narrow.job.shape.area = geometry::rectangle({-30.0, -1.0}, {30.0, 1.0});
  EXPECT_EQ(narrow.seconds(), 0.0);
}

// By hand: of 2400 mm2 an island of 20 x 10 mm stays; outlines of 200 + 60 mm, 2 mm wide, leave 1680 mm2,
// 13440 mm3.
TEST(LeastClearing, CountsNoIsland) {
  Pocket with(5.0);
  with.job.shape.islands.push_back({.area = geometry::rectangle({-10.0, -5.0}, {10.0, 5.0})});
  EXPECT_NEAR(with.seconds(), 13440.0 * 60.0, 1e-3);
  // Of a contour the island is the part: here nothing surely lasts.
  with.job.shape.islands.front().area = geometry::rectangle({-25.0, -15.0}, {25.0, 15.0});
  EXPECT_LT(with.seconds(), (2400.0 - 1500.0) * 8.0 * 60.0);
}

TEST(LongerThanAShift, IsSaidWithBothTimesAndWhatWouldHelp) {
  const Pocket slow(5.0);
  const auto why = [](const Pocket& p) {
    return surely_longer_than_a_shift(p.step, p.job, p.question, p.cut, p.map);
  };
  ASSERT_TRUE(why(slow));
  EXPECT_TRUE(why(slow)->starts_with("it cuts at least 266.7 h, longer than a shift of 8 h; ")) << *why(slow);
  EXPECT_TRUE(why(Pocket(30.0)) && !why(Pocket(170.0)));
  Pocket of_the_file(5.0);
  of_the_file.step.proposed = false;
  EXPECT_FALSE(why(of_the_file)) << "a step of the file is cut however long it takes";
}

}  // namespace
}  // namespace capstan::step
