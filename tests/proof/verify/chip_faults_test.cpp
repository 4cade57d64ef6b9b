#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>

#include "planner/model/plan/resources/specific_force.h"
#include "planner/physics/mechanics/constants.h"
#include "planner/proof/verify/verify.h"
#include "tests/proof/verify/checked.h"

// Feeds that are too high for what the cutter meets, and cuts that meet more than they were planned for.
//
//     cutter     10, four teeth, 3000 rpm: 12000 mm/min are 1 mm per tooth; its largest chip is 0.06 mm,
//                720 mm/min where its front meets material square on
//     raw piece  a pocket of 40 x 40 about (50, 50), roughed by square rings; a ring at h leaves walls at h +
//     5
namespace capstan::verify {
namespace {

using testing::MoveRole;
using testing::PlanMaker;
using testing::told;

/// Findings of the plan, or of the program that is written from it.
std::vector<model::Finding> check(const model::Plan& plan, bool as_program) {
  Job job;
  if (!as_program) return check_plan(plan, job);
  return check_program({"part.ngc", testing::program_of(plan), testing::tool_table_of(plan)}, &plan,
                       plan.machine, plan.cutters, job);
}

bool found(const std::vector<model::Finding>& findings, const std::string& code, const std::string& step) {
  return std::any_of(findings.begin(), findings.end(), [&](const auto& f) {
    return f.code == code && f.step == step && (f.severity == Severity::kError || code.ends_with("-LEFT"));
  });
}

constexpr double kSlow = 600.0;

model::CutterPath rings(const std::vector<double>& halves) {
  model::CutterPath p;
  p.start({50, 50, 10});
  p.rapid({50, 50, 2});
  p.line({50, 50, -5}, MoveRole::kPlunge);
  for (const double h : halves) {
    for (const auto& [x, y] : {std::pair{-1, -1}, {1, -1}, {1, 1}, {-1, 1}, {-1, -1}})
      p.line({50 + h * x, 50 + h * y, -5}, MoveRole::kCut);
  }
  p.rapid({p.x.back(), p.y.back(), 10}, MoveRole::kRetract);
  return p;
}

/// Roughed by these rings, then a second step along `path` whose move `fast` is fed at `feed`.
PlanMaker roughed(const std::vector<double>& halves, model::CutterPath path, std::size_t fast, double feed) {
  PlanMaker k = testing::empty_plan();
  k.plan.cutters[0].fz_max_mm = 0.06;
  const auto pocket = k.pocket("P", 50, 50, 40, 10);
  k.step<model::BottomAndSideRoughMilling>("rough", pocket, "em10", rings(halves), kSlow, 3000);
  k.step<model::BottomAndSideFinishMilling>("second", pocket, "em10", std::move(path), kSlow, 3000);
  if (fast > 0)
    testing::edit_schedule(k.plan, 1, [&](model::FeedSchedule& s) { s.feed_mm_min[fast] = feed; });
  return k;
}

/// From the middle into the wall at y = 50 - h, along it at move 4, and away.
model::CutterPath along_wall(double h, double from = 45) {
  model::CutterPath p;
  p.start({45, from, 10});
  p.rapid({45, from, 2});
  p.line({45, from, -5}, MoveRole::kPlunge);
  p.line({45, 50 - h, -5}, MoveRole::kCut);
  p.line({58, 50 - h, -5}, MoveRole::kCut);
  p.line({55, 45, -5}, MoveRole::kCut);
  p.rapid({55, 45, 10}, MoveRole::kRetract);
  return p;
}

/// From the middle to x = 64 along y = 50.
model::CutterPath into_wall() {
  model::CutterPath p;
  p.start({50, 50, 10});
  p.rapid({50, 50, 2});
  p.line({50, 50, -5}, MoveRole::kPlunge);
  p.line({64, 50, -5}, MoveRole::kCut);
  p.line({50, 50, -5}, MoveRole::kCut);
  p.rapid({50, 50, 10}, MoveRole::kRetract);
  return p;
}

/// Round the corner at (64, 36) on an arc of 2 mm, move 5.
model::CutterPath round_corner() {
  model::CutterPath p;
  p.start({50, 45, 10});
  p.rapid({50, 45, 2});
  p.line({50, 45, -5}, MoveRole::kPlunge);
  p.line({50, 36, -5}, MoveRole::kCut);
  p.line({62, 36, -5}, MoveRole::kCut);
  p.arc({64, 38, -5}, {62, 38}, true, MoveRole::kCut);
  p.line({60, 42, -5}, MoveRole::kCut);
  p.rapid({60, 42, 10}, MoveRole::kRetract);
  return p;
}

/// Two slots at y = 45 and 55 + rib with a rib of that width between them at y = 50; then along the rib,
/// move 3.
PlanMaker with_rib(double rib, double feed) {
  model::CutterPath second;
  second.start({42, 50, 10});
  second.rapid({42, 50, 2});
  second.line({42, 50, -5}, MoveRole::kPlunge);
  second.line({58, 50, -5}, MoveRole::kCut);
  second.rapid({58, 50, 10}, MoveRole::kRetract);
  PlanMaker k = roughed({}, second, 3, feed);
  model::CutterPath p;
  p.start({36, 45, 10});
  for (const double y : {45.0 - 0.5 * rib, 55.0 + 0.5 * rib}) {
    p.rapid({36, y, 10});
    p.rapid({36, y, 2});
    p.line({36, y, -5}, MoveRole::kPlunge);
    p.line({64, y, -5}, MoveRole::kCut);
    p.rapid({64, y, 10}, MoveRole::kRetract);
  }
  const std::size_t n = p.size();
  k.plan.steps[0].path = std::make_shared<model::CutterPath>(p);
  k.plan.steps[0].schedule = std::make_shared<model::FeedSchedule>(model::FeedSchedule{
      std::vector<double>(n, kSlow), std::vector<double>(n, 3000), std::vector<double>(n, 0.0)});
  return k;
}

void planned(PlanMaker& k, double depth, double width) {
  k.plan.steps[1].axial_depth_mm = depth;
  k.plan.steps[1].radial_depth_mm = width;
}

struct Case {
  const char* name;
  const char* code;  ///< empty: right
  std::function<PlanMaker()> make;
};
void PrintTo(const Case& c, std::ostream* out) { *out << c.name; }

// A width of 0.5 is met at a cosine of sqrt(1 - 0.9^2) = 0.436: 0.06 mm are 1651 mm/min there.
const Case kCases[] = {
    {"AThinCutAtItsOwnFeedIsRight", "",
     [] {
       return roughed({4, 8, 12, 14.5}, along_wall(15), 4, 1600);
     }},
    {"AThinCutAtTwiceIt", "CHK-FEED-TOOL",
     [] {
       return roughed({4, 8, 12, 14.5}, along_wall(15), 4, 3200);
     }},
    {"AThinCutAtATenthMore", "CHK-FEED-TOOL",
     [] {
       return roughed({4, 8, 12, 14.5}, along_wall(15), 4, 1820);
     }},
    {"AFullWidthCutAtItsFeedIsRight", "",
     [] {
       return roughed({4, 8, 12}, into_wall(), 3, 700);
     }},
    {"AFullWidthCutBegunAtTwiceIt", "CHK-FEED-TOOL",
     [] {
       return roughed({4, 8, 12}, into_wall(), 3, 1440);
     }},
    {"AnInsideCornersArcAtItsFeedIsRight", "",
     [] {
       return roughed({4, 8, 12}, round_corner(), 5, 600);
     }},
    {"AnInsideCornersArcAtTwiceIt", "CHK-FEED-TOOL",
     [] {
       return roughed({4, 8, 12}, round_corner(), 5, 1440);
     }},
    {"ASliverInTheMiddleAtTheChipsFeedIsRight", "", [] { return with_rib(0.3, 700); }},
    {"ASliverInTheMiddleAtTwiceIt", "CHK-FEED-TOOL", [] { return with_rib(0.3, 1440); }},
    {"ASliverBetweenTwoRowsOfCellsAtTheChipsFeedIsRight", "", [] { return with_rib(0.1, 700); }},
    {"ASliverBetweenTwoRowsOfCellsAtTwiceIt", "CHK-FEED-TOOL", [] { return with_rib(0.1, 1440); }},
    {"AFinishingPassThatFindsItsAllowanceIsRight", "",
     [] {
       PlanMaker k = roughed({4, 8, 12, 14.7}, along_wall(15), 0, 0);
       planned(k, 5, 0.3);
       return k;
     }},
    {"AFinishingPassThatFindsTenTimesItsWidth", "CHK-WIDTH-LEFT",
     [] {
       PlanMaker k = roughed({4, 8}, along_wall(15), 0, 0);
       planned(k, 5, 0.3);
       return k;
     }},
    {"AFinishingPassThatFindsTwiceItsDepth", "CHK-DEPTH-LEFT",
     [] {
       PlanMaker k = roughed({4, 8, 12}, along_wall(15), 0, 0);
       planned(k, 2.0, 5.0);
       return k;
     }},
    {"ACutThatBendsASlenderTool", "CHK-DEFLECTION",
     [] {
       PlanMaker k = roughed({4, 8, 12}, into_wall(), 0, 0);
       k.plan.cutters[0].stick_out_mm = 110;
       return k;
     }},
};

/// A finishing pass of 0.3 mm, 5 mm deep, for which the plan states this force, meets 7 mm: the rings at 8
/// leave walls at 13, the pass makes them 20.
std::vector<model::Finding> widely(double stated_n, bool as_program) {
  PlanMaker k = roughed({4, 8}, along_wall(15), 0, 0);
  planned(k, 5, 0.3);
  k.plan.steps[1].loads.peak_force_n = stated_n;
  auto out = check(k.plan, as_program);
  std::erase_if(out, [](const auto& f) { return f.code != "CHK-WIDTH-LEFT" || f.step != "second"; });
  return out;
}

TEST(WidthLeft, IsAnErrorWhereThePlanStatesLessForceThanIsMet) {
  // 35 mm2 fed at 600 mm/min are 21000 mm3/min; 10 mm at 3000 1/min run at 94248 mm/min. At kc of 1000 N/mm2
  // or more, which the chip of 0.05 mm asks for in the material of these plans with a worn edge, the mean
  // forces of the edges are 223 N or more, with their radial share 260 N, and together, on an arc of 114
  // degrees, 0.89 of that, 231 N.
  const model::WorkMaterial w = testing::empty_plan().plan.material;
  ASSERT_GT(w.kc11_n_mm2 * std::pow(0.05, -w.mc) * 1.3, 1000.0);
  for (const bool as_program : {false, true}) {
    const auto little = widely(200.0, as_program);
    ASSERT_EQ(little.size(), 1U) << told(little);
    EXPECT_EQ(little[0].severity, Severity::kError) << told(little);
    EXPECT_NE(little[0].message.find("200 N: its limits were not held there"), std::string::npos);
    const auto enough = widely(5000.0, as_program);
    ASSERT_EQ(enough.size(), 1U) << told(enough);
    EXPECT_EQ(enough[0].severity, Severity::kWarning) << told(enough);
  }
}

TEST(WidthLeft, IsAnErrorWhereThePlanStatesNoForce) {
  for (const bool as_program : {false, true}) {
    const auto untold = widely(0.0, as_program);
    ASSERT_EQ(untold.size(), 1U) << told(untold);
    EXPECT_EQ(untold[0].severity, Severity::kError) << told(untold);
    EXPECT_NE(untold[0].message.find("the plan states no force for the step"), std::string::npos);
  }
}

TEST(WidthLeft, OfAStripThinnerThanACellIsNoMoreThanTheStrip) {
  // Cells of 0.2 mm have their centres at odd tenths. Rings at 14.69 leave a wall at 30.31; a pass at 14.905
  // takes 0.215 mm off it, in which the centres at 30.3 and 30.1 lie: on cells 0.4 mm. Planned for 0.04 mm,
  // it meets a little over five times that, ten by the cells. The way there is longer than the cutter is
  // wide, and so told apart.
  PlanMaker k = roughed({4, 8, 12, 14.69}, along_wall(14.905, 46), 0, 0);
  planned(k, 5, 0.04);
  k.plan.steps[1].loads.peak_force_n = 1.0;
  for (const bool as_program : {false, true}) {
    const auto findings = check(k.plan, as_program);
    EXPECT_FALSE(found(findings, "CHK-WIDTH-LEFT", "second")) << told(findings);
  }
}

/// A slot in the solid, 10 mm wide and 5 deep where 2 were planned, for which the plan states this share of
/// the sum of its edges' mean forces.
std::vector<model::Finding> deeply(double share, bool as_program) {
  model::CutterPath slot;
  slot.start({42, 40, 10});
  slot.rapid({42, 40, 2});
  slot.line({42, 40, -5}, MoveRole::kPlunge);
  slot.line({58, 40, -5}, MoveRole::kCut);
  slot.rapid({58, 40, 10}, MoveRole::kRetract);
  PlanMaker k = roughed({}, slot, 0, 0);
  planned(k, 2.0, 10.0);
  const model::WorkMaterial& w = k.plan.material;
  const double mean_chip = 0.05 * 2.0 / std::numbers::pi;
  const double rake = 1.0 - model::kForcePerDegreeOfRake * model::kEndMillRakeDeg;
  const double kc = rake * w.kc11_n_mm2 * std::pow(mean_chip, -w.mc) * mechanics::kWearForceFactor;
  const double edges = kc * 50.0 * kSlow / (std::numbers::pi * 10.0 * 3000.0) *
                       std::hypot(1.0, mechanics::kRadialToTangentialRatio);
  k.plan.steps[1].loads.peak_force_n = share * edges;
  auto out = check(k.plan, as_program);
  std::erase_if(out, [](const auto& f) { return f.code != "CHK-DEPTH-LEFT" || f.step != "second"; });
  return out;
}

// Opposite edges of a slot push apart: the force of all of them is pi / 4 of the sum of theirs, 0.785. That
// is within a tenth of 0.8, and more than a tenth above 0.65.
TEST(DepthLeft, OfASlotIsHeldAgainstTheForceOfAllItsEdgesTogether) {
  for (const bool as_program : {false, true}) {
    const auto held = deeply(0.8, as_program);
    ASSERT_EQ(held.size(), 1U) << told(held);
    EXPECT_EQ(held[0].severity, Severity::kWarning) << told(held);
    const auto unheld = deeply(0.65, as_program);
    ASSERT_EQ(unheld.size(), 1U) << told(unheld);
    EXPECT_EQ(unheld[0].severity, Severity::kError) << told(unheld);
  }
}

class Chips : public ::testing::TestWithParam<std::tuple<Case, bool>> {};

TEST_P(Chips, AreFoundWhereTheyAreTooMuchAndOnlyThere) {
  const auto& [c, as_program] = GetParam();
  const std::string code = c.code;
  auto findings = check(c.make().plan, as_program);
  // The second path stops where its chip is measured: it leaves the rest of the pocket, 5 of its 10 mm at the
  // least, and that is said once.
  EXPECT_EQ(std::erase_if(findings,
                          [](const auto& f) {
                            return f.code == "CHK-LEFT" && f.step == "second" && f.property == 36 &&
                                   f.message.find(" of P still stand") != std::string::npos;
                          }),
            1U)
      << told(findings);
  if (code.empty()) {
    EXPECT_TRUE(findings.empty()) << told(findings);
  } else {
    EXPECT_TRUE(found(findings, code, "second")) << told(findings);
  }
}

INSTANTIATE_TEST_SUITE_P(Faults, Chips, ::testing::Combine(::testing::ValuesIn(kCases), ::testing::Bool()),
                         [](const auto& i) {
                           return std::string(std::get<0>(i.param).name) +
                                  (std::get<1>(i.param) ? "Written" : "Planned");
                         });

}  // namespace
}  // namespace capstan::verify
