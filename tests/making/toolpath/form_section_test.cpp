#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>
#include <random>

#include "planner/making/toolpath/path_job.h"
#include "planner/making/toolpath/section/section.h"
#include "tests/making/toolpath/path_helpers.h"

namespace capstan::toolpath {
namespace {

using geometry::Vec2;
using geometry::Vec3;
using model::MoveKind;
using model::MoveRole;
using model::TypeId;

constexpr double kPi = std::numbers::pi;

/// Height of a surface above its bottom by distance from its middle, in closed form.
using Wall = std::function<double(double)>;

Wall rounded_u(double r, double depth) {
  return [=](double d) { return d >= r ? depth : r - std::sqrt(r * r - d * d); };
}
Wall rounded_vee(double r, double full_angle, double depth) {
  const double half = 0.5 * full_angle;
  const double touch = r * std::cos(half);
  const double up = r * (1.0 - std::sin(half));
  return [=](double d) {
    const double h = d <= touch ? r - std::sqrt(r * r - d * d) : up + (d - touch) / std::tan(half);
    return std::min(h, depth);
  };
}

/// As a file's reader makes it: 16 chords of the arc, then the flank.
std::vector<Vec2> profile_of_wall(double r, double full_angle, double depth) {
  std::vector<Vec2> out;
  const double half = 0.5 * full_angle;
  for (int i = 0; i <= 16; ++i) {
    const double a = (0.5 * kPi - half) * i / 16;
    out.push_back({r * (1.0 - std::cos(a)), r * std::sin(a)});
  }
  out.push_back({depth, out.back().y + (depth - out.back().x) * std::tan(half)});
  return out;
}

model::Cutter cutter(model::CutterClass c, double diameter, double corner) {
  model::Cutter out = endmill(diameter);
  out.cutter_class = c;
  out.corner_radius_mm = corner;
  out.centre_cutting = true;
  return out;
}
model::Cutter ball(double d) { return cutter(model::CutterClass::kBallEndmill, d, 0.5 * d); }

PathJob form_slot(double r, double full_angle, double depth, bool open) {
  PathJob t = area_job({}, depth, 10.0);
  auto& s = t.shape;
  s.kind = model::ShapeKind::kSlot;
  s.name = "SLOT";
  s.spine = {{0, 0}, {40, 0}};
  s.slot_profile = profile_of_wall(r, full_angle, depth);
  s.slot_bottom_radius_mm = r;
  s.slot_angle_rad = full_angle;
  const double half = s.slot_profile.back().y;
  s.width.nominal_mm = 2.0 * half;
  s.area = s.reach = geometry::stroke(s.spine, half, !open);
  s.open = open;
  if (open) s.reach = geometry::stroke({{-100, 0}, {160, 0}}, half, false);
  t.stock = geometry::rectangle({open ? 0.0 : -40.0, -60}, {open ? 40.0 : 80.0, 60});
  return t;
}

double from_spine(const PathJob& t, Vec2 p) {
  const double over = t.shape.open ? 0.0 : std::max({0.0, -p.x, p.x - 40.0});
  return std::hypot(over, p.y);
}

/// Every place of the cutter on every move below the top, closely.
void each_place(const GeneratedPath& g, double below_z, double step, const std::function<void(Vec3)>& f) {
  for (std::size_t i = 1; i < g.path.size(); ++i) {
    if (g.path.kind[i] == MoveKind::kRapid || g.path.kind[i] == MoveKind::kDwell) continue;
    const int n = std::max(1, static_cast<int>(std::ceil(model::move_length(g.path, i) / step)));
    for (int k = 0; k <= n; ++k) {
      const Vec3 p = model::point_on_move(g.path, i, static_cast<double>(k) / n);
      if (p.z < below_z) f(p);
    }
  }
}

/// The deepest that the cutter goes into the part, by its own outline against the closed form.
double gouge(const PathJob& t, const GeneratedPath& g, const Wall& wall) {
  const auto outline = model::profile_of(t.cutter);
  const double r = 0.5 * t.cutter.cutting_diameter_mm;
  const double depth = t.shape.depth_mm;
  double worst = -1e300;
  each_place(g, -1e-6, 0.7, [&](Vec3 p) {
    for (int a = 0; a < 16; ++a) {
      for (int k = 0; k <= 24; ++k) {
        const double rho = (r - 1e-6) * k / 24;
        const Vec2 q{p.x + rho * std::cos(a * kPi / 8.0), p.y + rho * std::sin(a * kPi / 8.0)};
        const double d = t.shape.kind == model::ShapeKind::kHole ? norm(q) : from_spine(t, q);
        worst = std::max(worst, wall(d) - depth - (p.z + outline.height(rho)));
      }
    }
  });
  return worst;
}

/// What stays above the wall along a line across it, measured upright and laid against the wall's slope.
double rest_across(const PathJob& t, const GeneratedPath& g, const Wall& wall, double half, double at_x) {
  const auto outline = model::profile_of(t.cutter);
  const double r = 0.5 * t.cutter.cutting_diameter_mm;
  std::vector<double> ds, left;
  for (double d = -half + 0.01; d < half; d += 0.02) ds.push_back(d);
  left.assign(ds.size(), 0.0);  // the raw piece's top
  each_place(g, -1e-6, 0.02, [&](Vec3 p) {
    if (std::abs(p.x - at_x) > 0.05) return;
    for (std::size_t i = 0; i < ds.size(); ++i) {
      const double rho = std::hypot(ds[i] - p.y, at_x - p.x);
      if (rho <= r) left[i] = std::min(left[i], p.z + outline.height(rho));
    }
  });
  double worst = 0.0;
  for (std::size_t i = 0; i < ds.size(); ++i) {
    const double d = std::abs(ds[i]);
    const double slope = (wall(d + 1e-4) - wall(std::max(0.0, d - 1e-4))) / 2e-4;
    worst = std::max(worst, (left[i] - (wall(d) - t.shape.depth_mm)) / std::hypot(1.0, slope));
  }
  return worst;
}

TEST(Section, IsTheClosedFormOfItsArcFromInside) {
  for (const double r : {0.5, 3.0, 5.5, 20.0}) {
    PathJob t = form_slot(r, 0.0, 2.0 * r, true);
    const auto s = slot_section(t.shape);
    ASSERT_TRUE(s) << s.error().message;
    for (std::size_t i = 0; i + 1 < s->wall.size(); ++i) {
      const Vec2 m = 0.5 * (s->wall[i] + s->wall[i + 1]);
      if (m.y > r) continue;
      const double inside = r - std::hypot(m.x, r - m.y);
      EXPECT_GE(inside, -1e-12);
      EXPECT_LE(inside, 0.001 + 1e-9) << r;
    }
  }
}

TEST(Section, LetsNoCutterInDeeperThanItsOutlineAllows) {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> part(0.0, 1.0);
  for (int n = 0; n < 200; ++n) {
    const double r = 0.5 + 6.0 * part(random);
    const double angle = (30.0 + 100.0 * part(random)) * kPi / 180.0;
    const double depth = r + 10.0 * part(random);
    const auto s = slot_section(form_slot(r, angle, depth, true).shape);
    ASSERT_TRUE(s);
    Tip tip{0.5 + 4.0 * part(random), 0.0};
    tip.corner_mm = tip.radius_mm * (n % 3 == 0 ? 0.0 : n % 3 == 1 ? 1.0 : part(random));
    const auto outline = geometry::bull_profile(2.0 * tip.radius_mm, tip.corner_mm, 50.0);
    const Wall wall = rounded_vee(r, angle, depth);
    const double u = s->half_width_mm() * part(random);
    const double h = drop(*s, tip, u);
    double touch = 1e300;
    for (int k = 0; k <= 4000; ++k) {
      const double rho = (tip.radius_mm - 1e-9) * k / 4000;
      touch = std::min(touch, h + outline.height(rho) - wall(u + rho));
    }
    EXPECT_GE(touch, -1e-9);
    EXPECT_LE(touch, 0.01) << "it hangs in the air";
    if (h > depth - 1e-3) continue;  // it rests on the top
    const double wide = widest_at(*s, tip, h);
    EXPECT_GE(wide, u - 1e-6);
  }
}

TEST(FormSlot, IsRoughedInLevelsWithoutGouging) {
  for (const bool open : {true, false}) {
    for (const double corner : {0.0, 1.0}) {
      PathJob t = form_slot(3.0, 0.5 * kPi, 13.0, open);
      t.operation = TypeId::kBottomAndSideRoughMilling;
      t.cutter = cutter(corner > 0.0 ? model::CutterClass::kBullnoseEndmill : model::CutterClass::kFacemill,
                        10.0, corner);
      t.axial_depth_mm = 2.0;
      t.allowance_side_mm = 0.25;
      t.allowance_bottom_mm = 0.25;
      Job job;
      const auto g = generate(t, job);
      ASSERT_TRUE(g) << g.error().message;
      EXPECT_THAT(rule_breaks(t, *g), testing::IsEmpty()) << open << corner;
      EXPECT_LE(gouge(t, *g, rounded_vee(3.0, 0.5 * kPi, 13.0)), -0.15) << "the allowance is kept";
      const double rest = rest_across(t, *g, rounded_vee(3.0, 0.5 * kPi, 13.0), 14.2, 20.0);
      EXPECT_LE(rest, 2.0 * std::sqrt(0.5) + 3.0) << "no core: a level's step, and the bottom out of reach";
      for (std::size_t i = 1; i < g->levels_z_mm.size(); ++i)
        EXPECT_LE(g->levels_z_mm[i - 1] - g->levels_z_mm[i], 2.0 + 1e-9);
    }
  }
}

TEST(FormSlot, IsRoughedToTerracesThatARoundCutterTakesWhateverTheDepthOfCut) {
  // A wall at 45 degrees: a level of height h leaves a terrace of h sin(45) square to the wall.
  PathJob t = form_slot(3.0, 0.5 * kPi, 13.0, true);
  t.operation = TypeId::kBottomAndSideRoughMilling;
  t.cutter = cutter(model::CutterClass::kEndmill, 10.0, 0.0);
  t.axial_depth_mm = 12.0;
  t.allowance_side_mm = t.allowance_bottom_mm = 0.3;
  Job job;
  const auto g = generate(t, job);
  ASSERT_TRUE(g) << g.error().message;
  ASSERT_GT(g->levels_z_mm.size(), 2U);
  for (std::size_t i = 1; i < g->levels_z_mm.size(); ++i)
    EXPECT_LE((g->levels_z_mm[i - 1] - g->levels_z_mm[i]) * std::sin(0.25 * kPi), 0.18 * 10.0 + 1e-6);
  // Upright walls leave none: the rounded U is as deep as it may be down to where its bottom begins.
  PathJob u = form_slot(5.5, 0.0, 13.0, true);
  u.operation = t.operation;
  u.cutter = cutter(model::CutterClass::kEndmill, 6.0, 0.0);
  u.axial_depth_mm = 6.0;
  u.allowance_side_mm = u.allowance_bottom_mm = 0.3;
  const auto round = generate(u, job);
  ASSERT_TRUE(round) << round.error().message;
  EXPECT_NEAR(round->levels_z_mm.front(), u.start_z_mm - 6.0, 1e-9);
}

TEST(FormSlot, IsFinishedByABallToTheScallopWithoutGouging) {
  struct Case {
    double r, angle, depth, diameter;
  };
  for (const bool open : {true, false}) {
    for (const Case c :
         {Case{5.5, 0.0, 13.0, 10.0}, Case{3.0, 0.5 * kPi, 13.0, 6.0}, Case{5.5, 0.0, 13.0, 6.0}}) {
      PathJob t = form_slot(c.r, c.angle, c.depth, open);
      t.operation = TypeId::kBottomAndSideFinishMilling;
      t.cutter = ball(c.diameter);
      t.left_on_side_mm = t.left_on_bottom_mm = 0.3;
      Job job;
      const auto g = generate(t, job);
      ASSERT_TRUE(g) << g.error().message;
      const Wall wall = c.angle > 0.0 ? rounded_vee(c.r, c.angle, c.depth) : rounded_u(c.r, c.depth);
      EXPECT_THAT(rule_breaks(t, *g), testing::IsEmpty()) << open << c.diameter;
      EXPECT_LE(gouge(t, *g, wall), 0.002) << open << c.diameter;
      const double half = c.angle > 0.0 ? t.shape.slot_profile.back().y : c.r - 0.02;
      EXPECT_LE(rest_across(t, *g, wall, half, 20.0), 0.0125) << open << c.diameter;
    }
  }
}

TEST(FormSlot, OfASharpVeeIsRoughedDownToItsAllowance) {
  PathJob t = form_slot(1.0, 0.5 * kPi, 10.0, true);
  t.shape.slot_bottom_radius_mm = 0.0;
  t.shape.slot_profile = {{0, 0}, {10, 10}};
  t.shape.area = geometry::stroke(t.shape.spine, 10.0, false);
  t.shape.reach = geometry::stroke({{-100, 0}, {160, 0}}, 10.0, false);
  t.operation = TypeId::kBottomAndSideRoughMilling;
  t.cutter = cutter(model::CutterClass::kEndmill, 5.0, 0.0);
  t.axial_depth_mm = 2.0;
  t.allowance_bottom_mm = 5.0;
  Job job;
  const auto g = generate(t, job);
  ASSERT_TRUE(g) << g.error().message;
  EXPECT_NEAR(g->levels_z_mm.back(), -5.0, 1e-9);
  EXPECT_LE(gouge(t, *g, [](double d) { return std::min(d, 10.0); }), 1e-6);
  t.allowance_side_mm = 0.2;
  const auto thinner = generate(t, job);
  ASSERT_TRUE(thinner) << thinner.error().message;
  EXPECT_LE(gouge(t, *thinner, [](double d) { return std::min(d, 10.0); }), -0.2);
}

// 2 mm deeper at 1.5 degrees take 76 mm of a way; the slot's middle is 40 mm long.
TEST(FormSlot, TooShortForOneWayDownIsGoneToAndFroAlong) {
  PathJob t = form_slot(3.0, 0.5 * kPi, 8.0, false);
  t.operation = TypeId::kBottomAndSideRoughMilling;
  t.cutter = cutter(model::CutterClass::kEndmill, 5.0, 0.0);
  t.axial_depth_mm = 2.0;
  t.allowance_side_mm = 0.2;
  const double most = 1.5 * kPi / 180.0;
  t.ramp_angle_rad = t.cutter.maximum_ramp_angle_rad = most;
  Job job;
  const auto g = generate(t, job);
  ASSERT_TRUE(g) << g.error().message;
  int down = 0, turns = 0;
  double before = 0.0;
  for (std::size_t i = 1; i < g->path.size(); ++i) {
    const double fall = g->path.z[i - 1] - g->path.z[i];
    if (g->path.kind[i] == MoveKind::kRapid || !(g->path.z[i] < -1e-6) || !(fall > 1e-9)) continue;
    if (g->path.role[i] != MoveRole::kRamp) continue;  // else through air
    const double dx = g->path.x[i] - g->path.x[i - 1];
    EXPECT_LE(std::asin(fall / model::move_length(g->path, i)), most + 1e-6) << i;
    ++down;
    turns += dx * before < 0.0 ? 1 : 0;
    before = dx;
  }
  EXPECT_GT(down, 0);
  EXPECT_GT(turns, 0);
  EXPECT_LE(gouge(t, *g, rounded_vee(3.0, 0.5 * kPi, 8.0)), 1e-6);
}

TEST(FormSlot, IsSteppedFinelyByAFlatEndThatFinishes) {
  PathJob t = form_slot(3.0, 0.5 * kPi, 13.0, true);
  t.operation = TypeId::kBottomAndSideFinishMilling;
  t.cutter = cutter(model::CutterClass::kEndmill, 6.0, 0.0);
  t.axial_depth_mm = 4.0;
  t.left_on_side_mm = 0.3;
  Job job;
  const auto g = generate(t, job);
  ASSERT_TRUE(g) << g.error().message;
  const Wall wall = rounded_vee(3.0, 0.5 * kPi, 13.0);
  EXPECT_LE(gouge(t, *g, wall), 0.002);
  // Flanks at 45 degrees: steps of 0.35 sqrt 2; the lowest is 3 wide on each side, 1.757 above the bottom.
  const auto& z = g->levels_z_mm;
  for (std::size_t i = 1; i + 1 < z.size(); ++i)
    EXPECT_NEAR(z[i - 1] - z[i], 0.35 * std::sqrt(2.0), 1e-3) << i;
  EXPECT_NEAR(z.back(), -13.0 + 3.0 * (1.0 - std::sqrt(0.5)) + (3.0 - 3.0 * std::sqrt(0.5)), 0.002);
}

TEST(FormSlot, OnABentCourseIsNotGougedAtTheBend) {
  for (const bool finish : {false, true}) {
    PathJob t = form_slot(3.0, 0.5 * kPi, 9.0, true);
    t.shape.spine = {{0, 0}, {30, 0}, {45, 30}};
    const double half = t.shape.slot_profile.back().y;
    const Vec2 way = (1.0 / std::hypot(15.0, 30.0)) * Vec2{15, 30};
    const std::vector<Vec2> longer = {{-100, 0}, {30, 0}, Vec2{45, 30} + 100.0 * way};
    t.shape.area = geometry::stroke(t.shape.spine, half, false);
    t.shape.reach = geometry::stroke(longer, half, false);
    t.stock = geometry::rectangle({0, -40}, {80, 30});
    t.operation = finish ? TypeId::kBottomAndSideFinishMilling : TypeId::kBottomAndSideRoughMilling;
    t.cutter = finish ? ball(6.0) : cutter(model::CutterClass::kEndmill, 8.0, 0.0);
    t.axial_depth_mm = 2.0;
    if (finish) t.left_on_side_mm = 0.3;
    Job job;
    const auto g = generate(t, job);
    ASSERT_TRUE(g) << g.error().message;
    EXPECT_THAT(rule_breaks(t, *g), testing::IsEmpty());
    const Wall wall = rounded_vee(3.0, 0.5 * kPi, 9.0);
    const auto outline = model::profile_of(t.cutter);
    const double r = 0.5 * t.cutter.cutting_diameter_mm;
    const auto distance = [&](Vec2 q) {
      double best = 1e300;
      for (std::size_t i = 0; i + 1 < longer.size(); ++i) {
        const Vec2 d = longer[i + 1] - longer[i];
        const double f = std::clamp(dot(q - longer[i], d) / dot(d, d), 0.0, 1.0);
        best = std::min(best, norm(q - longer[i] - f * d));
      }
      return best;
    };
    double worst = -1e300;
    each_place(*g, -1e-6, 0.5, [&](Vec3 p) {
      for (int a = 0; a < 16; ++a) {
        for (int k = 0; k <= 12; ++k) {
          const double rho = (r - 1e-6) * k / 12;
          const Vec2 q{p.x + rho * std::cos(a * kPi / 8.0), p.y + rho * std::sin(a * kPi / 8.0)};
          worst = std::max(worst, wall(distance(q)) - 9.0 - (p.z + outline.height(rho)));
        }
      }
    });
    EXPECT_LE(worst, 0.003) << finish;
    EXPECT_GE(worst, -0.01) << finish << ": it comes to the wall";
  }
}

TEST(FormSlot, SaysWhatABallTooLargeLeaves) {
  PathJob t = form_slot(3.0, 0.5 * kPi, 13.0, true);
  t.operation = TypeId::kBottomAndSideFinishMilling;
  t.cutter = ball(12.0);
  t.left_on_side_mm = 0.3;
  Job job;
  const auto g = generate(t, job);
  ASSERT_TRUE(g) << g.error().message;
  // A ball of 6 in a right-angled vee: its centre 6 sqrt 2 above the sharp tip, the arc's 3 sqrt 2; between
  // the two lowest points lie (6 - 3) (sqrt 2 - 1).
  const double expected = 3.0 * (std::sqrt(2.0) - 1.0);
  EXPECT_NEAR(13.0 + *std::min_element(g->levels_z_mm.begin(), g->levels_z_mm.end()), expected, 0.002);
  bool said = false;
  for (const auto& d : job.take_diagnostics()) said = said || d.code == "TPA-REST";
  EXPECT_TRUE(said);
}

TEST(FormSlot, ClearsItselfFirstWhereNothingHasRoughedIt) {
  PathJob t = form_slot(5.5, 0.0, 13.0, true);
  t.operation = TypeId::kBottomAndSideFinishMilling;
  t.cutter = ball(8.0);
  Job job;
  const auto g = generate(t, job);
  ASSERT_TRUE(g) << g.error().message;
  EXPECT_GT(g->levels_z_mm.front(), -3.0);
  EXPECT_LE(gouge(t, *g, rounded_u(5.5, 13.0)), 0.002);
}

TEST(FormSlot, RefusesASectionThatBulgesBelowItsMouthAndBallsInATee) {
  PathJob t = form_slot(5.5, 0.0, 13.0, true);
  t.shape.slot_bottom_radius_mm = 0.0;
  t.shape.slot_profile = {{0, 5}, {4, 9}, {8, 5}, {13, 5}};
  t.operation = TypeId::kBottomAndSideRoughMilling;
  t.cutter = cutter(model::CutterClass::kEndmill, 6.0, 0.0);
  Job job;
  EXPECT_EQ(generate(t, job).error().code, "TPA-UNSUPPORTED");
  t.shape.slot_profile = {{0, 9}, {4, 9}, {4, 5}, {13, 5}};
  t.cutter = cutter(model::CutterClass::kBallEndmill, 6.0, 3.0);
  EXPECT_EQ(generate(t, job).error().code, "TPA-UNSUPPORTED");
}

PathJob taper(bool through) {
  PathJob t = area_job({}, 20.0, 8.0);
  t.shape.kind = model::ShapeKind::kHole;
  t.shape.name = "HOLE";
  t.shape.diameter.nominal_mm = 18.0;
  t.shape.bottom_diameter_mm = 12.0;
  t.shape.bottom = through ? model::HoleBottom::kThrough : model::HoleBottom::kFlat;
  t.shape.through = through;
  t.break_through_mm = through ? 1.0 : 0.0;
  t.stock = geometry::rectangle({-40, -40}, {40, 40});
  return t;
}

TEST(TaperedHole, IsRoughedAndFinishedOnCirclesWithoutGouging) {
  for (const bool through : {false, true}) {
    const Wall wall = [&](double d) {
      return d <= 6.0 ? (through ? -1e300 : 0.0) : std::min(20.0, 20.0 * (d - 6.0) / 3.0);
    };
    PathJob t = taper(through);
    t.operation = TypeId::kBottomAndSideRoughMilling;
    t.axial_depth_mm = 1.0;
    t.allowance_side_mm = 0.2;
    t.allowance_bottom_mm = through ? 0.0 : 0.2;
    Job job;
    auto g = generate(t, job);
    ASSERT_TRUE(g) << g.error().message;
    EXPECT_THAT(rule_breaks(t, *g), testing::IsEmpty()) << through;
    EXPECT_LE(gouge(t, *g, wall), -0.15);
    t.operation = TypeId::kBottomAndSideFinishMilling;
    t.cutter = ball(6.0);
    t.axial_depth_mm = t.allowance_side_mm = t.allowance_bottom_mm = 0.0;
    t.left_on_side_mm = t.left_on_bottom_mm = 0.2;
    g = generate(t, job);
    ASSERT_TRUE(g) << g.error().message;
    EXPECT_THAT(rule_breaks(t, *g), testing::IsEmpty()) << through;
    EXPECT_LE(gouge(t, *g, wall), 0.002);
    EXPECT_LE(*std::min_element(g->levels_z_mm.begin(), g->levels_z_mm.end()), through ? -20.5 : -19.999);
    bool rest = false;
    for (const auto& d : job.take_diagnostics()) rest = rest || d.code == "TPA-REST";
    EXPECT_EQ(rest, !through) << "a ball leaves the corner of a flat bottom";
  }
}

TEST(TaperedHole, HasItsCornerCutByTheFlatEndThatStepsDownTheWall) {
  PathJob t = taper(false);
  t.operation = TypeId::kBottomAndSideFinishMilling;
  t.axial_depth_mm = 6.0;
  t.cutter = cutter(model::CutterClass::kEndmill, 6.0, 0.0);
  t.left_on_side_mm = t.left_on_bottom_mm = 0.3;
  Job job;
  const auto g = generate(t, job);
  ASSERT_TRUE(g) << g.error().message;
  EXPECT_THAT(rule_breaks(t, *g), testing::IsEmpty());
  const Wall wall = [](double d) { return d <= 6.0 ? 0.0 : std::min(20.0, 20.0 * (d - 6.0) / 3.0); };
  EXPECT_LE(gouge(t, *g, wall), 0.002);
  EXPECT_LE(g->levels_z_mm.size(), 10U) << "0.35 square to a wall that leans 8.5 degrees: 2.4 apart";
  double floor = 0.0;
  each_place(*g, -19.999, 0.1, [&](Vec3 p) { floor = std::max(floor, std::hypot(p.x, p.y)); });
  EXPECT_NEAR(floor + 3.0, 6.0, 1e-3) << "out to the corner";
}

TEST(HoleOfTheCuttersOwnSize, IsSunkNotLed) {
  PathJob t = taper(false);
  t.shape.diameter.nominal_mm = t.shape.bottom_diameter_mm = 10.0;
  t.shape.depth_mm = 12.0;
  t.shape.bottom = model::HoleBottom::kSpherical;
  t.shape.bottom_hole_radius_mm = 5.0;
  t.operation = TypeId::kBottomAndSideFinishMilling;
  t.cutter = ball(10.0);
  Job job;
  const auto g = generate(t, job);
  ASSERT_TRUE(g) << g.error().message;
  EXPECT_THAT(rule_breaks(t, *g), testing::IsEmpty());
  EXPECT_EQ(g->levels_z_mm, std::vector<double>{-12.0});
  for (std::size_t i = 0; i < g->path.size(); ++i) EXPECT_EQ(g->path.x[i], 0.0);
  t.cutter.centre_cutting = false;
  EXPECT_EQ(generate(t, job).error().code, "TPA-ENTRY");
  t.cutter = ball(10.2);
  EXPECT_EQ(generate(t, job).error().code, "TPA-NO-FIT");
}

}  // namespace
}  // namespace capstan::toolpath
