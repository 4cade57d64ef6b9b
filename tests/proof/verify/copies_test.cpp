#include "planner/proof/verify/copies/copies.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "planner/ground/vocabulary/control_options.h"
#include "planner/ground/vocabulary/operation.h"
#include "planner/ground/vocabulary/thread_mill.h"
#include "planner/model/plan/cutter/ramp.h"
#include "planner/physics/mechanics/life/arc_speed.h"
#include "planner/proof/verify/program/readers.h"
#include "planner/proof/verify/reader_options.h"
#include "planner/proof/verify/sweep/step_checks.h"

namespace capstan::verify {
namespace {

using model::CutterClass;
using model::CutterTrait;
using Classes = std::set<CutterClass>;

/// Classes for which the check says something else than the trait does.
template <class Says>
Classes differing(Says says, CutterTrait t) {
  Classes out;
  for (const model::CutterClassRow& r : model::cutter_classes()) {
    if (says(r.value) != model::has(r.value, t)) out.insert(r.value);
  }
  return out;
}

TEST(Copies, WorkAlongTheAxisAsTheTableSays) {
  const auto says = [](CutterClass c) { return works_along_axis(c); };
  EXPECT_EQ(differing(says, CutterTrait::kAlongAxis), Classes{});
}

TEST(Copies, SweepTheOutlineThatThePlanHasOfEveryClass) {
  for (const model::CutterClassRow& r : model::cutter_classes()) {
    model::Cutter c;
    c.cutter_class = r.value;
    c.cutting_diameter_mm = 12.0;
    c.maximum_depth_of_cut_mm = 8.0;
    EXPECT_EQ(outline_of(c), model::profile_of(c)) << r.name;
    c.corner_radius_mm = 1.5;
    c.tip_diameter_mm = 2.0;
    c.point_angle_rad = 2.0;
    c.taper_angle_rad = 0.1;
    c.lead_angle_rad = 0.4;
    EXPECT_EQ(outline_of(c), model::profile_of(c)) << r.name;
  }
}

TEST(Copies, TurnFasterInNarrowCutsAsPlanningDoes) {
  for (const char* group : {"P", "M", "K", "N", "S", "H", ""}) {
    for (int i = 0; i <= 120; ++i) {
      const double width = 0.01 * i;
      EXPECT_NEAR(speed_by_arc(width, group),
                  mechanics::speed_by_arc(width, 1.0, model::Substrate::kCarbide, group), 1e-12)
          << group << " " << width;
    }
  }
}

// The cutter's angle is stated by nobody: planning never takes it for a steeper ramp at a lower feed.
TEST(Copies, RampAsFlatAsPlanningDoes) {
  for (const char* group : {"P", "M", "K", "N", "S", "H", ""}) {
    for (const auto substrate : {model::Substrate::kCarbide, model::Substrate::kHss}) {
      for (const double own_rad : {0.0, 0.02, 0.06, 0.1, 0.2, 0.78}) {
        model::Cutter c;
        c.substrate = substrate;
        c.maximum_ramp_angle_rad = own_rad;
        model::WorkMaterial m;
        m.iso_group = group;
        EXPECT_NEAR(usual_ramp(c, m.iso_group), model::ramp_of(c, m).angle_rad, 1e-12) << group << own_rad;
      }
    }
  }
}

TEST(Copies, SizeHolesAsTheTableSays) {
  EXPECT_EQ(differing(sizes_hole, CutterTrait::kSizesHole), Classes{});
}

TEST(Copies, CutToTheCentreAsTheTableSays) {
  EXPECT_EQ(differing(cuts_to_centre, CutterTrait::kToCentre), Classes{});
}

TEST(Copies, AreBallsAsTheTableSays) { EXPECT_EQ(differing(is_ball, CutterTrait::kBall), Classes{}); }

TEST(Copies, RakeEndMillsAndBallsAsTheForceLawDoes) {
  EXPECT_EQ(differing([](CutterClass c) { return is_raked(c) && !is_ball(c); }, CutterTrait::kEndMill),
            Classes{});
  EXPECT_TRUE(is_raked(CutterClass::kBallEndmill));
}

TEST(Copies, BreakEdgesWithTheConesThatSink) {
  EXPECT_EQ(differing(breaks_edges, CutterTrait::kSinks), Classes{});
}

// Twist and gun drills cut with all of their cone.
TEST(Copies, CutByThePointWhatHasOneAndIsNoDrill) {
  EXPECT_EQ(differing(cuts_by_point, CutterTrait::kPointAngle),
            (Classes{CutterClass::kTwistDrill, CutterClass::kGunDrill}));
}

// A side mill's body is thinner above its disc. The planner measures what its head cuts by the height of the
// disc; the check has heights alone, which do not tell what lies under them.
TEST(Copies, UndercutAsTheTableSaysAndSideMillsToo) {
  EXPECT_EQ(differing(undercuts, CutterTrait::kUndercuts), Classes{CutterClass::kSideMill});
}

// A back counterbore swings out below the part and cuts upwards along its axis: no wall of its feature is
// beside it.
TEST(Copies, WorkUnderOverhangsAsTheTableSaysButBackCounterbores) {
  EXPECT_EQ(differing(under_overhangs, CutterTrait::kUndercuts), Classes{CutterClass::kBackCounterbore});
}

// Counterbores and back tools are axial, and what they leave at the foot of a wall is their corner, as a
// mill's is. A probe takes nothing away.
TEST(Copies, MillWhatTheTableSaysIsNotAxialAndCounterboresToo) {
  const auto says = [](CutterClass c) { return !mills(c); };
  EXPECT_EQ(differing(says, CutterTrait::kAlongAxis),
            (Classes{CutterClass::kCounterbore, CutterClass::kBackCounterbore, CutterClass::kBackCountersink,
                     CutterClass::kTouchProbe}));
}

TEST(Copies, MillThreadsAsTheTableSays) {
  for (const model::CutterClassRow& r : model::cutter_classes())
    EXPECT_EQ(verify::mills_threads(r.value), model::mills_threads(r.value)) << r.name;
}

TEST(Copies, RankOperationsAsTheTableSays) {
  for (std::size_t i = 0; i < model::kTypeCount; ++i) {
    const auto op = static_cast<model::TypeId>(i);
    EXPECT_EQ(order_rank(op), model::craft_rank(op)) << i;
  }
}

TEST(Copies, FinishWhatTheTableSays) {
  for (std::size_t i = 0; i < model::kTypeCount; ++i) {
    const auto op = static_cast<model::TypeId>(i);
    EXPECT_EQ(finishes(op), model::has(op, model::OperationTrait::kFinishes)) << i;
  }
}

TEST(Copies, TakeTheDefaultsOfControlOptionsAsTheTableSays) {
  ASSERT_EQ(readers().size(), model::kControlRows.size());
  for (const DialectReader& d : readers()) {
    std::size_t found = 0;
    for (const model::ControlOptionRow& row : model::kControlOptions) {
      const std::string_view mine = reader_default(d.dialect, row.name);
      if (mine == "-") continue;
      ++found;
      EXPECT_EQ(mine, model::default_of(row, d.dialect)) << d.dialect << " " << row.name;
    }
    // Each of the list is a row of the table.
    EXPECT_EQ(found, static_cast<std::size_t>(std::count(d.options.begin(), d.options.end(), '=')))
        << d.dialect;
  }
}

}  // namespace
}  // namespace capstan::verify
