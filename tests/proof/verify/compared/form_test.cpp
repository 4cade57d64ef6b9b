#include "planner/proof/verify/volumes/form/form.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

#include "planner/model/features/resolve.h"
#include "planner/proof/verify/verify.h"
#include "tests/proof/verify/plans.h"
#include "tests/proof/verify/volumes/bench.h"

// The heights, walls and tolerances that the check judges by are its own: they say the same as the planner's
// where both read a file rightly, and a plan made from a wrong reading is found.

namespace capstan::verify::volumes {
namespace {

struct FormBench : Bench {
  std::vector<Form> forms(AnyRef f) {
    const Source source = source_of(m, raw);
    return forms_of(source, f, read(source, f));
  }
  /// Whether the own height at a place is one that the planner's reading has within 0.03 mm beside it: it
  /// cuts arcs to chords of hundredths, and beside a steep wall that is more in height. To 0.02 mm.
  static bool alike(std::optional<double> own, const model::FeatureShape& theirs, Vec2 p) {
    constexpr double kBeside = 0.03, kHigh = 0.02;
    bool some = false, none = false;
    double low = 0.0, high = 0.0;
    for (const Vec2 d :
         {Vec2{0, 0}, Vec2{kBeside, 0}, Vec2{-kBeside, 0}, Vec2{0, kBeside}, Vec2{0, -kBeside}}) {
      const auto t = model::floor_at(theirs, p + d);
      none = none || !t;
      if (!t) continue;
      low = some ? std::min(low, *t) : *t;
      high = some ? std::max(high, *t) : *t;
      some = true;
    }
    if (some && none) return true;  // at the border
    return own ? some && *own > low - kHigh && *own < high + kHigh : none;
  }
  /// Where the own height is not like the planner's; empty: nowhere.
  std::string differing(AnyRef f) {
    const auto theirs = planner(f);
    const auto own = forms(f);
    if (own.size() != theirs.size())
      return std::to_string(own.size()) + " forms, " + std::to_string(theirs.size()) + " shapes";
    for (std::size_t i = 0; i < own.size(); ++i) {
      if (own[i].kind != theirs[i].kind) return "another kind";
      if (std::abs(own[i].depth_mm() - theirs[i].depth_mm) > 1e-9) return "another depth";
      const auto b = geometry::bounds(theirs[i].area);
      constexpr int kGrid = 61;
      for (int k = 0; k < kGrid * kGrid; ++k) {
        const Vec2 p{b.lo.x - 3 + (b.hi.x - b.lo.x + 6) * (k % kGrid + 0.41) / kGrid,
                     b.lo.y - 3 + (b.hi.y - b.lo.y + 6) * (k / kGrid + 0.43) / kGrid};
        const auto a = floor_at(own[i], p), t = model::floor_at(theirs[i], p);
        if (alike(a, theirs[i], p)) continue;
        return "at " + std::to_string(p.x) + " " + std::to_string(p.y) + ": " +
               (a ? std::to_string(*a) : "-") + ", planner's " + (t ? std::to_string(*t) : "-");
      }
    }
    return "";
  }
  AnyRef slot(Ref<model::OpenProfile> section, double depth_mm) {
    model::Slot s;
    s.feature_placement = at(60, 60, 0);
    s.depth = depth(-depth_mm);
    model::GeneralPath course;
    course.swept_path = line({{0, 0}, {50, 0}, {80, 20}});
    s.course_of_travel = m.add(course);
    s.swept_shape = section;
    s.end_conditions.push_back(m.add(model::RadiusedSlotEndType{}));
    s.end_conditions.push_back(m.add(model::OpenSlotEndType{}));
    return m.add(s);
  }
};

TEST(OwnForms, OfHolesWithEveryBottomAreAsHighAsThePlannersReading) {
  FormBench k;
  EXPECT_EQ(k.differing(k.hole(50, 50, 10, 20)), "");
  model::ConicalHoleBottom cone;
  cone.tip_angle = 118 * kDeg;
  model::SphericalHoleBottom ball;
  ball.radius = k.length(5);
  model::FlatWithRadiusHoleBottom corner;
  corner.corner_radius = k.length(2);
  for (const AnyRef bottom : {AnyRef(k.m.add(cone)), AnyRef(k.m.add(ball)), AnyRef(k.m.add(corner)),
                              AnyRef(k.m.add(model::ThroughBottomCondition{}))}) {
    const auto h = k.hole(50, 50, 10, 20);
    k.m.at<model::RoundHole>(h).bottom_condition = Ref<model::HoleBottomCondition>(bottom);
    EXPECT_EQ(k.differing(h), "");
  }
  const auto taper = k.hole(50, 50, 10, 20);
  model::DiameterTaper t;
  t.final_diameter = k.length(4);
  k.m.at<model::RoundHole>(taper).change_in_diameter = k.m.add(t);
  EXPECT_EQ(k.differing(taper), "");
}

TEST(OwnForms, OfPocketsWithRadiiSlopesAndBossesAreAsHighAsThePlannersReading) {
  FormBench k;
  const auto p = k.pocket(100, 70, 80, 50, 20);
  auto& pocket = k.m.at<model::ClosedPocket>(p);
  pocket.orthogonal_radius = k.length(6);
  EXPECT_EQ(k.differing(p), "");
  pocket.planar_radius = k.length(3);
  EXPECT_EQ(k.differing(p), "");
  pocket.planar_radius = {};
  pocket.slope = 5 * kDeg;
  EXPECT_EQ(k.differing(p), "");
  pocket.slope = {};
  pocket.its_boss.push_back(k.boss(105, 70, 20, 10, 20));
  EXPECT_EQ(k.differing(p), "");
}

TEST(OwnForms, OfSlotsOfEverySectionAreAsHighAsThePlannersReading) {
  FormBench k;
  model::SquareUProfile square;
  square.width = k.length(12);
  model::RoundedUProfile round;
  round.width = k.length(12);
  model::VeeProfile vee;
  vee.profile_angle = 90 * kDeg;
  vee.profile_radius = k.length(1);
  model::TeeProfile tee;
  tee.width = k.length(10);
  tee.cross_bar_width = k.length(18);
  tee.cross_bar_depth = k.length(6);
  EXPECT_EQ(k.differing(k.slot(k.m.add(square), 8)), "");
  EXPECT_EQ(k.differing(k.slot(k.m.add(round), 8)), "");
  EXPECT_EQ(k.differing(k.slot(k.m.add(vee), 5)), "");
  EXPECT_EQ(k.differing(k.slot(k.m.add(tee), 15)), "");
  square.first_angle = square.second_angle = 60 * kDeg;  // a dovetail
  square.width = k.length(20);
  EXPECT_EQ(k.differing(k.slot(k.m.add(square), 8)), "");
}

TEST(OwnForms, OfEdgesFollowTheOutlineOfWhatTheyBreak) {
  FormBench k;
  model::Chamfer c;
  c.first_feature = k.pocket(100, 70, 80, 50, 20);
  c.first_offset_amount = k.length(2);
  c.angle_to_plane = 45 * kDeg;
  const AnyRef on_pocket = k.m.add(c);
  EXPECT_EQ(k.differing(on_pocket), "");
  model::CircularClosedShapeProfile o;
  model::CircularClosedProfile circle;
  circle.diameter = k.length(60);
  o.feature_placement = k.at(100, 75, 0);
  o.depth = k.depth(-10);
  o.closed_boundary = k.m.add(circle);
  o.floor_condition = k.m.add(model::ThroughProfileFloor{});
  const AnyRef outside = k.m.add(o);
  const auto round = k.forms(outside);
  ASSERT_EQ(round.size(), 1u);
  EXPECT_FALSE(floor_at(round[0], {29.9, 0}));
  EXPECT_EQ(floor_at(round[0], {30.1, 0}), -10.0);
  EXPECT_EQ(floor_at(round[0], {60.0, 0}), -10.0);
  c.first_feature = Ref<model::MachiningFeature>(outside);
  const auto own = k.forms(k.m.add(c));
  ASSERT_EQ(own.size(), 1u);
  // The material lies within the circle of 30: from 28 mm on it falls to 2 mm at 30.
  EXPECT_FALSE(floor_at(own[0], {27.9, 0}));
  EXPECT_NEAR(floor_at(own[0], {29.0, 0}).value_or(0), -1.0, 1e-9);
  EXPECT_FALSE(floor_at(own[0], {30.1, 0}));
}

TEST(OwnLimits, AreThoseOfThePlannersReadingForEveryClassByLetterAndByNumbers) {
  FormBench k;
  int given = 0;
  const auto same = [&](const model::LimitsAndFits& fit, double nominal) {
    model::TolerancedLengthMeasure t;
    t.theoretical_size = nominal;
    t.implicit_tolerance = k.m.add(fit);
    const auto r = k.m.add(t);
    const auto theirs = model::length(k.m, r);
    const Limits own = limits_of(k.m, r);
    const bool stated = theirs && theirs->given;
    EXPECT_EQ(own.given, stated) << fit.form_variance.value_or("") << nominal;
    if (!own.given || !stated) return;
    ++given;
    EXPECT_NEAR(own.lower_mm, theirs->lower_mm, 1e-9) << fit.form_variance.value_or("") << nominal;
    EXPECT_NEAR(own.upper_mm, theirs->upper_mm, 1e-9) << fit.form_variance.value_or("") << nominal;
  };
  for (const double nominal : {2.5, 8.0, 20.0, 45.0, 120.0}) {
    for (const char* name : {"H7", "H8", "g6", "f7", "N9", "P9", "JS9", "k6", "h11", "M6"}) {
      model::LimitsAndFits fit;
      fit.form_variance = name;
      same(fit, nominal);
    }
    for (const double grade : {0.013, 0.021, 7.0, 9.0}) {
      for (const double next : {0.0, -0.02, 0.007, -0.5}) {
        for (const auto type : {model::FittingType::kHole, model::FittingType::kShaft}) {
          model::LimitsAndFits fit;
          fit.grade = grade;
          fit.deviation = next;
          fit.its_fitting_type = type;
          same(fit, nominal);
        }
      }
    }
  }
  EXPECT_GT(given, 80);
}

TEST(OwnLimits, OfALowerLimitWithItsSignAreTheDeviationItself) {
  FormBench k;
  model::PlusMinusValue t;
  t.upper_limit = -0.02;
  t.lower_limit = -0.041;
  const Limits l = deviations_of(k.m, 20.0, k.m.add(t));
  EXPECT_TRUE(l.given);
  EXPECT_NEAR(l.lower_mm, -0.041, 1e-12);
  EXPECT_NEAR(l.upper_mm, -0.02, 1e-12);
}

// --- a fault in the planner's reading ---

bool finds(const model::Plan& plan, const char* code) {
  Job job;
  for (const model::Finding& f : check_plan(plan, job)) {
    if (f.code == code && f.severity == Severity::kError) return true;
  }
  return false;
}

// A compound's hole, read by the planner as if it stood in the workpiece: the path goes to X15 Y15, the
// file's text puts the hole to X25 Y65.
TEST(OwnTarget, APathToACompoundsHoleReadInOtherCoordinatesIsAGougeAndLeavesTheHole) {
  using capstan::verify::testing::PlanMaker;
  PlanMaker k = capstan::verify::testing::good_plan();
  EXPECT_FALSE(finds(k.plan, "CHK-GOUGE"));
  EXPECT_FALSE(finds(k.plan, "CHK-LEFT"));
  auto& ws = k.plan.model.at<model::MachiningWorkingstep>(k.plan.steps[1].step);
  model::CompoundFeature c;
  c.feature_placement = k.at(10, 50, 0);
  c.elements.items.push_back(ws.its_feature);
  ws.its_feature = k.plan.model.add(c);
  EXPECT_TRUE(finds(k.plan, "CHK-GOUGE"));
  EXPECT_TRUE(finds(k.plan, "CHK-LEFT"));
}

TEST(OwnTarget, APathToADepthThatTheFileDoesNotStateIsAGouge) {
  using capstan::verify::testing::PlanMaker;
  PlanMaker k = capstan::verify::testing::good_plan();
  const auto& ws = k.plan.model.at<model::MachiningWorkingstep>(k.plan.steps[0].step);
  k.plan.model.at<model::ClosedPocket>(ws.its_feature).depth = k.depth(8);
  EXPECT_TRUE(finds(k.plan, "CHK-GOUGE"));
  EXPECT_FALSE(finds(k.plan, "CHK-LEFT"));
  k.plan.model.at<model::ClosedPocket>(ws.its_feature).depth = k.depth(12);
  EXPECT_FALSE(finds(k.plan, "CHK-GOUGE"));
  EXPECT_TRUE(finds(k.plan, "CHK-LEFT"));
}

}  // namespace
}  // namespace capstan::verify::volumes
