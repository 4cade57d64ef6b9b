#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <set>

#include "planner/making/toolpath/hole/hole_paths.h"
#include "planner/making/toolpath/path_job.h"
#include "tests/making/toolpath/path_helpers.h"

namespace capstan::toolpath {
namespace {

using geometry::Region;
using geometry::Vec2;
using model::CutterClass;
using model::MoveKind;
using model::MoveRole;

constexpr double kPi = std::numbers::pi;

/// A slot along x from 0 to 60, open at x = 60 and, with `both`, at 0; the raw piece ends there.
PathJob slot(double mouth, std::vector<Vec2> section, bool both) {
  PathJob t = area_job(geometry::stroke({{0, 0}, {60, 0}}, 0.5 * mouth, false), section.back().x, 10.0);
  t.shape.kind = model::ShapeKind::kSlot;
  t.shape.width.nominal_mm = mouth;
  t.shape.spine = {{0, 0}, {60, 0}};
  t.shape.slot_profile = std::move(section);
  t.shape.open = true;
  t.shape.reach = geometry::stroke({{both ? -100.0 : 0.0, 0}, {160, 0}}, 0.5 * mouth, false);
  t.stock = geometry::rectangle({0, -40}, {60, 40});
  t.operation = model::TypeId::kBottomAndSideFinishMilling;
  t.axial_depth_mm = 0.0;
  return t;
}

/// A T-slot as DIN 650 has it for 14 mm: mouth 14, below 23 wide and 9 high.
PathJob tee(bool both) { return slot(14.0, {{0, 11.5}, {9, 11.5}, {9, 7}, {23, 7}}, both); }

void t_cutter(PathJob& t, double d, double head, double neck) {
  t.cutter = endmill(d);
  t.cutter.cutter_class = CutterClass::kTSlotMill;
  t.cutter.cutting_width_mm = head;
  t.cutter.neck_diameter_mm = neck;
  t.cutter.centre_cutting = false;
}

/// Area that the head's disc passes at one height.
Region passed(const GeneratedPath& g, double z, double radius) {
  Region out;
  for (std::size_t i = 1; i < g.path.size(); ++i) {
    if (std::abs(g.path.z[i] - z) > 1e-9 || std::abs(g.path.z[i - 1] - z) > 1e-9) continue;
    const Vec2 a = xy(g.path.point(i - 1));
    const Vec2 b = xy(g.path.point(i));
    if (norm(b - a) < 1e-9) continue;
    std::vector<Vec2> line = {a};
    const MoveKind kind = g.path.kind[i];
    if (kind == MoveKind::kArcCw || kind == MoveKind::kArcCcw) {
      const Vec2 c{g.path.cx[i], g.path.cy[i]};
      double sweep = std::atan2(cross(a - c, b - c), dot(a - c, b - c));
      if (kind == MoveKind::kArcCcw && sweep <= 0.0) sweep += 2.0 * kPi;
      if (kind == MoveKind::kArcCw && sweep >= 0.0) sweep -= 2.0 * kPi;
      geometry::append_arc(line, c, a, sweep, 0.001);
    } else {
      line.push_back(b);
    }
    out = geometry::unite(out, geometry::stroke(line, radius, true));
  }
  return out;
}

void expect_clean(const PathJob& t, const GeneratedPath& g, double widest, double neck) {
  EXPECT_THAT(rule_breaks(t, g), testing::IsEmpty());
  const double radius = 0.5 * t.cutter.cutting_diameter_mm;
  const double mouth = 0.5 * t.shape.width.nominal_mm;
  const Region wide = geometry::stroke({{-100, 0}, {200, 0}}, widest, false);
  const Region narrow = geometry::stroke({{-100, 0}, {200, 0}}, mouth, false);
  EXPECT_LE(gouge_mm(g, wide, radius, -1e-6), 0.003) << "the head stays under the overhang";
  EXPECT_LE(gouge_mm(g, narrow, 0.5 * neck, -1e-6), 0.0) << "the neck stays in the mouth";
  for (const double z : g.levels_z_mm) {
    const Region floor = geometry::rectangle({radius, -widest}, {60, widest});
    EXPECT_LT(geometry::area(geometry::subtract(floor, passed(g, z, radius + 0.002))), 0.01) << z;
  }
  // Up and down only where the whole head is out of the piece.
  for (std::size_t i = 1; i < g.path.size(); ++i) {
    if (std::abs(g.path.z[i] - g.path.z[i - 1]) < 1e-9) continue;
    if (std::min(g.path.z[i], g.path.z[i - 1]) > -1e-6) continue;
    const bool right = g.path.x[i] >= 60.0 + radius;
    const bool left = g.path.x[i] <= -radius;
    EXPECT_TRUE(right || left) << "at x = " << g.path.x[i];
  }
}

TEST(UndercutPath, CutsATeeSlotAtOnceWithAHeadOfItsSize) {
  PathJob t = tee(true);
  t_cutter(t, 23.0, 9.0, 12.0);
  Job job;
  const auto g = generate(t, job);
  ASSERT_TRUE(g) << g.error().message;
  EXPECT_EQ(g->levels_z_mm.size(), 1U);
  EXPECT_THAT(job.diagnostics(), testing::IsEmpty());
  expect_clean(t, *g, 11.5, 12.0);
}

TEST(UndercutPath, GoesAsideAndDownWithASmallerHead) {
  PathJob t = tee(true);
  t_cutter(t, 18.0, 8.0, 8.0);  // 2.5 mm aside, a neck that leaves 3 mm
  Job job;
  const auto g = generate(t, job);
  ASSERT_TRUE(g) << g.error().message;
  ASSERT_EQ(g->levels_z_mm.size(), 2U);
  EXPECT_NEAR(g->levels_z_mm.front(), -22.0, 1e-9) << "the head's top under the overhang";
  EXPECT_NEAR(g->levels_z_mm.back(), -23.0, 1e-9);
  expect_clean(t, *g, 11.5, 8.0);
}

TEST(UndercutPath, LeavesAClosedEndTheWayItCame) {
  PathJob t = tee(false);
  t_cutter(t, 23.0, 9.0, 12.0);
  Job job;
  const auto g = generate(t, job);
  ASSERT_TRUE(g) << g.error().message;
  expect_clean(t, *g, 11.5, 12.0);
  bool back = false;
  for (const auto role : g->path.role) back = back || role == MoveRole::kRetract;
  EXPECT_TRUE(back);
}

TEST(UndercutPath, GoesRoundAClosedEndWithASmallerHead) {
  PathJob t = tee(false);
  t_cutter(t, 18.0, 8.0, 8.0);
  t.shape.spine = {{60, 0}, {20, 0}};
  t.shape.area = geometry::unite(geometry::stroke(t.shape.spine, 7.0, false), geometry::disc({20, 0}, 7.0));
  t.shape.reach = geometry::unite(t.shape.area, geometry::stroke({{60, 0}, {160, 0}}, 7.0, false));
  Job job;
  const auto g = generate(t, job);
  ASSERT_TRUE(g) << g.error().message;
  EXPECT_THAT(job.diagnostics(), testing::IsEmpty()) << "nothing stays at the end";
  // The wide part: 23 mm and round at the end, to 11.5 mm beyond it.
  const Region wide =
      geometry::unite(geometry::stroke({{20, 0}, {200, 0}}, 11.5, false), geometry::disc({20, 0}, 11.5));
  EXPECT_LE(gouge_mm(*g, wide, 9.0, -1e-6), 0.003);
  EXPECT_LE(gouge_mm(*g, t.shape.reach, 4.0, -1e-6), 0.0) << "the neck stays in the mouth";
  const Region floor = geometry::intersect(wide, geometry::rectangle({-50, -20}, {60, 20}));
  for (const double z : g->levels_z_mm)
    EXPECT_LT(geometry::area(geometry::subtract(floor, passed(*g, z, 9.002))), 0.05) << z;
}

TEST(UndercutPath, TakesTheWallsInAThinLastPassWhereTheHeadMovesAside) {
  PathJob t = tee(true);
  t_cutter(t, 18.0, 8.0, 8.0);
  Job job;
  const auto g = generate(t, job);
  ASSERT_TRUE(g) << g.error().message;
  std::vector<double> aside;
  for (std::size_t i = 0; i < g->path.size(); ++i) {
    const double y = std::abs(g->path.y[i]);
    if (std::none_of(aside.begin(), aside.end(), [y](double v) { return std::abs(v - y) < 1e-9; }))
      aside.push_back(y);
  }
  std::sort(aside.begin(), aside.end());
  ASSERT_GE(aside.size(), 3U);
  EXPECT_NEAR(aside.back(), 2.5, 1e-9) << "(23 - 18) / 2";
  EXPECT_NEAR(aside[aside.size() - 2], 2.5 - kLastSide, 1e-9);
}

TEST(UndercutPath, FeedsTheLastPassAsItIsAskedFor) {
  PathJob t = tee(true);
  t_cutter(t, 18.0, 8.0, 8.0);
  t.left_on_side_mm = 0.0;
  t.last_share = 0.4;
  Job job;
  const auto g = generate(t, job);
  ASSERT_TRUE(g) << g.error().message;
  int last = 0;
  for (std::size_t i = 1; i < g->path.size(); ++i) {
    const bool along = std::abs(g->path.x[i] - g->path.x[i - 1]) > 5.0 && g->path.role[i] == MoveRole::kCut;
    if (!along) continue;
    const bool wall = std::abs(std::abs(g->path.y[i]) - 2.5) < 1e-9;
    if (wall) {
      EXPECT_NEAR(g->feed_factor[i], 0.4, 1e-9);
    } else {
      EXPECT_GT(g->feed_factor[i], 0.45) << "the middle by half, for both edges cut; aside by 1 at least";
    }
    last += wall ? 1 : 0;
  }
  EXPECT_EQ(last, 4) << "two walls on two heights";
}

TEST(UndercutPath, GivesThinPassesTheChipOfAWholeOneAndTheWayBackAQuickerFeed) {
  PathJob t = tee(false);
  t_cutter(t, 18.0, 8.0, 8.0);
  t.left_on_side_mm = 0.0;  // the mouth of 14 mm is milled: 2 mm beside it, 1.8 at a tenth of the head
  Job job;
  const auto g = generate(t, job);
  ASSERT_TRUE(g) << g.error().message;
  std::map<double, double> aside;  // feed along the walls, by how far aside
  double back = 0.0;
  for (std::size_t i = 1; i < g->path.size(); ++i) {
    const bool along = std::abs(g->path.y[i] - g->path.y[i - 1]) < 1e-9 &&
                       std::abs(g->path.x[i] - g->path.x[i - 1]) > 5.0 && g->path.z[i] < 0.0;
    if (along && g->path.role[i] == MoveRole::kRetract) back = g->feed_factor[i];
    if (along && g->path.role[i] == MoveRole::kCut) aside[std::abs(g->path.y[i])] = g->feed_factor[i];
  }
  EXPECT_GT(back, 1.0);
  // Two passes of half of 2.5 mm but the last, asked for 2 mm: a chip is 2 sqrt(a (18 - a)) / 18 of the feed.
  const double whole = 0.5 * (2.5 - kLastSide);
  ASSERT_EQ(aside.size(), 4U);
  EXPECT_NEAR((++aside.begin())->second, std::sqrt(32.0 / (whole * (18.0 - whole))), 1e-3)
      << "the thickest chip, and with it the force of one tooth, is the same";
  EXPECT_NEAR(aside.rbegin()->second, std::sqrt(32.0 / (kLastSide * (18.0 - kLastSide))), 1e-3);
}

TEST(UndercutPath, RoundAClosedEndIsSlowerByTheTeethThatCutAtOnce) {
  for (const int teeth : {1, 6}) {
    PathJob t = tee(false);
    t_cutter(t, 18.0, 8.0, 8.0);
    t.cutter.teeth = teeth;
    t.left_on_side_mm = 0.0;  // one edge was asked for 2 mm, as above
    Job job;
    const auto g = generate(t, job);
    ASSERT_TRUE(g) << g.error().message;
    // Thickest chip of the question: 2 sqrt(2 (18 - 2)) / 18 = 0.6285 of the feed. It has less than one of
    // six teeth in its arc of acos(1 - 4 / 18) = 39 degrees; the front half has three.
    const double expected = 2.0 * std::sqrt(32.0) / 18.0 / (teeth == 6 ? 3.0 : 1.0);
    int ends = 0;
    for (std::size_t i = 1; i < g->path.size(); ++i) {
      const bool across = g->path.y[i] * g->path.y[i - 1] < 0.0 && g->path.z[i] < 0.0;
      if (!across || g->path.role[i] != MoveRole::kCut) continue;
      EXPECT_NEAR(g->feed_factor[i], expected, 1e-6);
      ++ends;
    }
    EXPECT_GT(ends, 0);
  }
}

TEST(UndercutPath, RefusesWhatWouldTouchAndSaysWhy) {
  Job job;
  PathJob t = tee(true);
  t_cutter(t, 25.0, 9.0, 12.0);
  EXPECT_EQ(generate(t, job).error().code, "TPA-NO-FIT") << "head too wide";
  t_cutter(t, 23.0, 9.5, 12.0);
  EXPECT_EQ(generate(t, job).error().code, "TPA-NO-FIT") << "head too high";
  t_cutter(t, 23.0, 9.0, 14.0);
  EXPECT_EQ(generate(t, job).error().code, "TPA-NO-FIT") << "neck as wide as the mouth";
  t_cutter(t, 18.0, 8.0, 10.0);
  EXPECT_EQ(generate(t, job).error().code, "TPA-NO-FIT") << "the neck does not let the head to the sides";
  t_cutter(t, 23.0, 9.0, 0.0);
  t.cutter.shank_diameter_mm = 0.0;
  EXPECT_EQ(generate(t, job).error().code, "TPA-TOOL") << "neck unknown";
  t_cutter(t, 23.0, 9.0, 12.0);
  t.shape.reach = geometry::stroke(t.shape.spine, 7.0, false);
  EXPECT_EQ(generate(t, job).error().code, "TPA-ENTRY") << "no open end";
}

/// 26 mm wide and 10 deep below a hole of 20 mm, its top 30 mm down; through.
PathJob far_end(double head, double height, double neck) {
  PathJob t = area_job(geometry::disc({0, 0}, 13.0, 0.01), 10.0, head);
  t.shape.kind = model::ShapeKind::kHole;
  t.shape.diameter.nominal_mm = t.shape.bottom_diameter_mm = 26.0;
  t.shape.through = true;
  t.shape.bottom = model::HoleBottom::kThrough;
  t.operation = model::TypeId::kBottomAndSideFinishMilling;
  t.feature_in_setup.origin = {0, 0, -30};
  t.start_z_mm = 0.0;
  t.hole_above_mm = 20.0;
  t_cutter(t, head, height, neck);
  return t;
}

TEST(BackPath, MillsTheWholeRingBelowANarrowHoleAndNothingAbove) {
  const PathJob t = far_end(18.0, 6.0, 9.0);
  Job job;
  const auto g = generate(t, job);
  ASSERT_TRUE(g) << g.error().message;
  double reached = 0.0, up = -100.0;
  for (std::size_t i = 0; i < g->path.size(); ++i) {
    const auto p = g->path.point(i);
    const double aside = std::hypot(p.x, p.y);
    if (p.z > -36.0 + 1e-9) {
      EXPECT_LT(aside, 1e-9) << "sideways with the head above the shoulder";
    }
    if (aside > 1e-6) up = std::max(up, p.z);
    reached = std::max(reached, aside);
  }
  EXPECT_NEAR(reached, 4.0, 1e-9) << "(26 - 18) / 2";
  EXPECT_NEAR(up, -36.0, 1e-9) << "the head's top at the shoulder";
  // From below: every level cuts above the last, and none more than a quarter of the head's height.
  EXPECT_NEAR(g->levels_z_mm.front(), -40.0 + 1.5 - 6.0, 1e-9);
  for (std::size_t i = 1; i < g->levels_z_mm.size(); ++i) {
    EXPECT_GT(g->levels_z_mm[i], g->levels_z_mm[i - 1]);
    EXPECT_LE(g->levels_z_mm[i] - g->levels_z_mm[i - 1], 1.5 + 1e-9);
  }
}

// A straight cut of the width a and a circle of radius e inside a wall of radius w have the same contact
// angle where w^2 = e^2 + R^2 + 2 e (R - a).
TEST(BackPath, MakesTheWallInALastThinCircleThatTakesWhatTheNeckWasBentToo) {
  PathJob t = far_end(18.0, 6.0, 9.0);
  t.last_share = 2.5;
  Job job;
  const auto g = generate(t, job);
  ASSERT_TRUE(g) << g.error().message;
  std::set<double> aside;
  for (std::size_t i = 1; i < g->path.size(); ++i) {
    const auto p = g->path.point(i);
    const double e = std::hypot(p.x, p.y);
    if (e < 1e-6) continue;
    aside.insert(std::round(1e6 * e) / 1e6);
    const bool wall = std::abs(e - 4.0) < 1e-6;
    EXPECT_NEAR(g->feed_factor[i], wall ? 2.5 : 1.0, 1e-9) << e;
  }
  ASSERT_GE(aside.size(), 2U);
  EXPECT_NEAR(*aside.rbegin(), 4.0, 1e-6);
  EXPECT_NEAR(*++aside.rbegin(), 4.0 - kLastSide, 1e-6);
  const double taken = last_circle_mm(t, 0.1);
  const double before = 13.0 - kLastSide - 0.1;  // radius of the wall, 0.1 of it by bending
  EXPECT_NEAR(before * before, 16.0 + 81.0 + 8.0 * (9.0 - taken), 1e-9);
  EXPECT_GT(taken, kLastSide + 0.1) << "inside a circle the cutter is in the cut for longer";
}

TEST(BackPath, RefusesAHeadOrANeckThatDoesNotPassAndSaysWhatWould) {
  Job job;
  const auto wide = generate(far_end(19.8, 6.0, 9.0), job);
  ASSERT_FALSE(wide);
  EXPECT_EQ(wide.error().code, "TPA-NO-FIT");
  // The head of 19.6 is 6.4 narrower than 26: its neck may be 20 - 0.2 - 6.4.
  EXPECT_NE(wide.error().hint.find("19.6 mm on a neck of at most 13.4 mm"), std::string::npos)
      << wide.error().hint;
  EXPECT_EQ(generate(far_end(12.0, 4.0, 6.0), job).error().code, "TPA-NO-FIT")
      << "7 aside, the neck leaves 6.9";
  EXPECT_EQ(generate(far_end(18.0, 6.0, 0.0), job).error().code, "TPA-TOOL") << "neck unknown";
  PathJob none = far_end(18.0, 6.0, 9.0);
  none.hole_above_mm = 0.0;
  EXPECT_EQ(generate(none, job).error().code, "TPA-ENTRY");
}

TEST(UndercutPath, AnEndMillClearsTheSlotThroughTheMouthFirst) {
  PathJob t = tee(true);
  t.cutter = endmill(12.0);
  t.operation = model::TypeId::kBottomAndSideRoughMilling;
  t.axial_depth_mm = 8.0;
  Job job;
  const auto g = generate(t, job);
  ASSERT_TRUE(g) << g.error().message;
  EXPECT_LE(gouge_mm(*g, t.shape.reach, 6.0, -1e-6), 0.003);
  HeightMap map({-20, -12}, {80, 12}, 0.25, 0.0);
  map.only(geometry::rectangle({0, -12}, {60, 12}));
  EXPECT_THAT(map.run(*g, t.cutter).faults, testing::IsEmpty());
  EXPECT_NEAR(map.highest(geometry::offset(t.shape.area, -0.3)), -23.0, 1e-4);
}

TEST(UndercutPath, CutsBothFlanksOfADovetail) {
  // 60 degrees against the floor, as guides have it: 30 from the axis; 30 wide on the floor, 8 deep.
  const double lean = kPi / 6.0;
  const double mouth = 15.0 - 8.0 * std::tan(lean);
  PathJob t = slot(2.0 * mouth, {{0, 15}, {8, mouth}, {8.0, mouth}}, true);
  t.cutter = endmill(20.0);
  t.cutter.cutter_class = CutterClass::kDovetailMill;
  t.cutter.lead_angle_rad = lean;
  t.cutter.maximum_depth_of_cut_mm = 9.0;
  t.cutter.neck_diameter_mm = 9.0;
  t.cutter.centre_cutting = false;
  Job job;
  const auto g = generate(t, job);
  ASSERT_TRUE(g) << g.error().message;
  expect_clean(t, *g, 15.0, 9.0);
  double most = 0.0;
  for (std::size_t i = 0; i < g->path.size(); ++i) most = std::max(most, std::abs(g->path.y[i]));
  EXPECT_NEAR(most, 5.0, 1e-9) << "(30 - 20) / 2: the flank of the cutter lies on that of the slot";
  t.cutter.lead_angle_rad = kPi / 4.0;
  EXPECT_EQ(generate(t, job).error().code, "TPA-TOOL");
  t.cutter.lead_angle_rad = lean;
  t.cutter.maximum_depth_of_cut_mm = 7.0;
  EXPECT_EQ(generate(t, job).error().code, "TPA-NO-FIT");
}

/// Distance of the lowest points of a path from the boundary of a region, least and most.
std::pair<double, double> distances(const GeneratedPath& g, const Region& r) {
  double lo = 1e300;
  double hi = 0.0;
  const double z = g.levels_z_mm.back();
  for (std::size_t i = 0; i < g.path.size(); ++i) {
    if (std::abs(g.path.z[i] - z) > 1e-9 || g.path.role[i] != MoveRole::kCut) continue;
    const double d = geometry::distance_to_boundary(r, xy(g.path.point(i)));
    lo = std::min(lo, d);
    hi = std::max(hi, d);
  }
  return {lo, hi};
}

TEST(EdgePath, RunsTheTipOfACornerRoundingMillAlongTheWall) {
  PathJob t = area_job(geometry::rounded_rectangle({0, 0}, {50, 30}, 6.0), 2.0, 9.0);
  t.shape.kind = model::ShapeKind::kEdgeRound;
  t.shape.round_radius_mm = 2.0;
  t.operation = model::TypeId::kSideFinishMilling;
  t.cutter.cutter_class = CutterClass::kCornerRoundingMill;
  t.cutter.corner_radius_mm = 2.0;
  t.cutter.tip_diameter_mm = 5.0;
  Job job;
  const auto g = generate(t, job);
  ASSERT_TRUE(g) << g.error().message;
  EXPECT_NEAR(g->levels_z_mm.front(), -2.0, 1e-12) << "the round ends where the wall begins";
  EXPECT_NEAR(distances(*g, t.shape.area).first, 2.5, 0.002);
  t.cutter.corner_radius_mm = 2.5;
  EXPECT_EQ(generate(t, job).error().code, "TPA-TOOL");
}

TEST(EdgePath, BreaksTheEdgesOfPocketsHolesAndOutsideContours) {
  const auto cone = [](PathJob& t) {
    t.operation = model::TypeId::kSideFinishMilling;
    t.cutter = endmill(8.0);
    t.cutter.cutter_class = CutterClass::kChamferMill;
    t.cutter.point_angle_rad = 0.5 * kPi;
    t.cutter.tip_diameter_mm = 1.0;
    t.axial_depth_mm = 0.3;
    t.left_on_side_mm = t.left_on_bottom_mm = 0.0;
  };
  Job job;
  // Half a millimetre below the bevel's foot, as wide as the cone there: 0.5 + 0.5 beside the wall.
  PathJob pocket = area_job(geometry::rounded_rectangle({0, 0}, {50, 30}, 6.0), 10.0, 8.0);
  cone(pocket);
  const auto in = generate(pocket, job);
  ASSERT_TRUE(in) << in.error().message;
  EXPECT_NEAR(in->levels_z_mm.front(), -0.8, 1e-12);
  EXPECT_NEAR(distances(*in, pocket.shape.area).first, 1.0, 0.002);
  PathJob hole = area_job(geometry::disc({0, 0}, 6.0), 10.0, 8.0);
  hole.shape.kind = model::ShapeKind::kHole;
  hole.shape.diameter.nominal_mm = hole.shape.bottom_diameter_mm = 12.0;
  cone(hole);
  const auto round = generate(hole, job);
  ASSERT_TRUE(round) << round.error().message;
  EXPECT_NEAR(distances(*round, geometry::disc({0, 0}, 6.0)).first, 1.0, 0.002);
  PathJob boss = area_job(geometry::rectangle({-30, -30}, {80, 60}), 10.0, 8.0);
  const Region kept = geometry::rounded_rectangle({0, 0}, {50, 30}, 5.0);
  boss.shape.kind = model::ShapeKind::kOutside;
  boss.shape.open = true;
  boss.shape.islands = {{kept, 0.0}};
  boss.shape.reach = geometry::subtract(boss.shape.area, kept);
  boss.stock = geometry::rectangle({-10, -10}, {60, 40});
  cone(boss);
  const auto out = generate(boss, job);
  ASSERT_TRUE(out) << out.error().message;
  EXPECT_NEAR(out->levels_z_mm.front(), -0.8, 1e-12);
  EXPECT_NEAR(distances(*out, kept).first, 1.0, 0.002);
  boss.axial_depth_mm = 0.0;
  EXPECT_EQ(generate(boss, job).error().code, "TPA-DEPTH");
}

TEST(ConeOfAHole, IsMilledAlongTheWallBelowItWithItsTipOnAShoulderWhereThereIsOne) {
  // 26 to 25 mm over 0.5 mm: 90 degrees.
  PathJob t = area_job(geometry::disc({0, 0}, 13.0), 0.5, 12.0);
  t.shape.kind = model::ShapeKind::kHole;
  t.shape.diameter.nominal_mm = 26.0;
  t.shape.bottom_diameter_mm = 25.0;
  t.shape.bottom = model::HoleBottom::kFlat;
  t.operation = model::TypeId::kSideFinishMilling;
  t.cutter = endmill(12.0);
  t.cutter.cutter_class = CutterClass::kChamferMill;
  t.cutter.point_angle_rad = 0.5 * kPi;
  t.cutter.tip_diameter_mm = 2.0;
  const auto widest = [](const GeneratedPath& g) {
    double out = 0.0;
    for (std::size_t i = 0; i < g.path.size(); ++i) out = std::max(out, std::hypot(g.path.x[i], g.path.y[i]));
    return out;
  };
  Job job;
  // Over a hole of 25 mm the tip goes 0.5 mm below the foot, where the cone is 1 + 0.5 mm wide.
  t.hole_below_mm = 25.0;
  const auto over_hole = generate(t, job);
  ASSERT_TRUE(over_hole) << over_hole.error().message;
  EXPECT_NEAR(over_hole->levels_z_mm.front(), -1.0, 1e-12);
  EXPECT_NEAR(widest(*over_hole), 12.5 - 1.5, 0.002);
  // 0.1 mm is left on the cone: all of it 0.1 mm higher.
  t.allowance_side_mm = 0.1;
  const auto rough = generate(t, job);
  ASSERT_TRUE(rough) << rough.error().message;
  EXPECT_NEAR(rough->levels_z_mm.front(), -0.9, 1e-12);
  EXPECT_NEAR(widest(*rough), 12.5 - 1.5, 0.002);
  // Around a hole of 20 mm a shoulder stays at the foot: the tip's edge runs on it.
  t.allowance_side_mm = 0.0;
  t.hole_below_mm = 20.0;
  const auto on_shoulder = generate(t, job);
  ASSERT_TRUE(on_shoulder) << on_shoulder.error().message;
  EXPECT_NEAR(on_shoulder->levels_z_mm.front(), -0.5, 1e-12);
  EXPECT_NEAR(widest(*on_shoulder), 12.5 - 1.0, 0.002);
  // The middle of a toleranced diameter: 26 +0.2 is cut 26.1 wide, 0.05 mm deeper.
  t.shape.diameter.upper_mm = 0.2;
  t.shape.diameter.given = true;
  const auto aimed = generate(t, job);
  ASSERT_TRUE(aimed) << aimed.error().message;
  EXPECT_NEAR(aimed->levels_z_mm.front(), -0.55, 1e-12);
}

}  // namespace
}  // namespace capstan::toolpath
