#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "planner/proof/verify/verify.h"
#include "tests/proof/verify/plans.h"

// How steep planning may go down by itself: the material's table bounds it, not the cutter alone.

namespace capstan::verify {
namespace {

using testing::MoveRole;
using testing::PlanMaker;

/// A carbide mill of 10 mm that may ramp at 45 degrees goes down into hardened steel, where 3 are usual. It
/// bears 0.2 mm per tooth.
struct Ramping {
  double degrees = 3.0;
  double fz_mm = 0.15;
  bool stated = true;
  model::Binder made_by = model::Binder::kRule;
  double asked_degrees = 0.0;  ///< by the file; 0: it asks for none
};

bool told(const Ramping& r) {
  constexpr double kDegree = std::numbers::pi / 180.0;
  PlanMaker k = testing::empty_plan();
  model::Cutter& c = k.plan.cutters[0];
  c.substrate = model::Substrate::kCarbide;
  c.maximum_ramp_angle_rad = 45.0 * kDegree;
  c.sources = {{"maximum_ramp_angle_rad", r.stated ? "stated in the list" : "default"}};
  k.plan.material.iso_group = "H";
  model::CutterPath p;
  p.start({45, 50, 10});
  p.rapid({45, 50, 0.2});
  p.line({55, 50, 0.2 - 10.0 * std::tan(r.degrees * kDegree)}, MoveRole::kRamp);
  p.rapid({55, 50, 10}, MoveRole::kRetract);
  auto& s = k.step<model::BottomAndSideRoughMilling>("pocket", k.pocket("P", 50, 50, 40, 20), "em10", p,
                                                     r.fz_mm * 4 * 3000, 3000);
  s.fz_mm = r.fz_mm;
  const auto op = k.plan.model.get<model::MachiningWorkingstep>(s.step)->its_operation;
  k.plan.ledger.bind(op, "its_toolpath", r.made_by, {"path.generated", "computed", "here"});
  if (r.asked_degrees > 0.0) {
    model::PlungeRamp asked;
    asked.angle = r.asked_degrees * kDegree;
    k.plan.model.get<model::Two5dMillingOperation>(op)->approach = k.plan.model.add(asked);
  }
  Job job;
  const auto found = check_plan(k.plan, job);
  return std::any_of(found.begin(), found.end(), [](const auto& f) { return f.code == "CHK-RAMP"; });
}

TEST(ChosenRamp, AsSteepAsTheTableSaysIsRight) { EXPECT_FALSE(told({})); }

TEST(ChosenRamp, SteeperAtTheFeedOfSlotsIsFoundWhateverTheCutterStates) {
  EXPECT_TRUE(told({.degrees = 30.0}));
  EXPECT_TRUE(told({.degrees = 3.5}));
}

TEST(ChosenRamp, SteeperAtHalfTheFeedIsRightWhereTheCutterStatesIt) {
  EXPECT_FALSE(told({.degrees = 30.0, .fz_mm = 0.1}));
  EXPECT_TRUE(told({.degrees = 30.0, .fz_mm = 0.1, .stated = false}));
}

TEST(ChosenRamp, OfTheFileIsBoundByItsCutterAlone) {
  EXPECT_FALSE(told({.degrees = 30.0, .made_by = model::Binder::kGiven}));
  EXPECT_FALSE(told({.degrees = 30.0, .asked_degrees = 30.0}));
  EXPECT_TRUE(told({.degrees = 50.0, .made_by = model::Binder::kGiven}));
}

}  // namespace
}  // namespace capstan::verify
