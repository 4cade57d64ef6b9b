#include "planner/proof/verify/plan/setups.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "planner/proof/verify/verify.h"
#include "tests/proof/verify/plans.h"

// A plan that is right as its workpiece lies straight, with placements planted that it was not planned for.
// The check reads them by itself.

namespace capstan::verify {
namespace {

using testing::PlanMaker;

model::Ref<model::Axis2Placement3d> placed(PlanMaker& k, geometry::Vec3 at, geometry::Vec3 z,
                                           geometry::Vec3 x) {
  const auto frame = k.at(at.x, at.y, at.z);
  model::Direction axis, ref;
  axis.direction_ratios = {{z.x, z.y, z.z}, true};
  ref.direction_ratios = {{x.x, x.y, x.z}, true};
  const auto axis_ref = k.plan.model.add(axis), ref_ref = k.plan.model.add(ref);
  auto& f = k.plan.model.at<model::Axis2Placement3d>(frame);
  f.axis = axis_ref;
  f.ref_direction = ref_ref;
  return frame;
}

model::Setup& setup(PlanMaker& k) { return k.plan.model.at<model::Setup>(k.plan.setups[0].setup); }
model::WorkpieceSetup& piece(PlanMaker& k) {
  return k.plan.model.at<model::WorkpieceSetup>(setup(k).its_workpiece_setup[0]);
}

std::vector<model::Finding> check(const model::Plan& plan) {
  Job job;
  return check_plan(plan, job);
}
std::string errors(const model::Plan& plan) {
  std::string out;
  for (const auto& f : check(plan)) {
    if (f.severity == Severity::kError) out += f.code + ": " + f.message + "\n";
  }
  return out;
}
bool told(const std::string& text, const std::string& what) { return text.find(what) != std::string::npos; }

/// Everything at the same place of the workpiece, whatever the program: what planning has to do.
void move_paths(PlanMaker& k, const geometry::Placement& by) {
  for (std::size_t i = 0; i < k.plan.steps.size(); ++i) {
    testing::edit_path(k.plan, i, [&](model::CutterPath& p) {
      for (std::size_t m = 0; m < p.size(); ++m) {
        const geometry::Vec3 at = by.to_parent(p.point(m));
        p.x[m] = at.x;
        p.y[m] = at.y;
        p.z[m] = at.z;
      }
    });
  }
}

geometry::Placement turned(double degrees) {
  const double a = degrees / 180.0 * std::numbers::pi;
  return *geometry::make_placement({}, {0, 0, 1}, {std::cos(a), std::sin(a), 0});
}

TEST(CheckSetups, ASetUpThatIsShiftedOnTheMachineIsTheSameProgram) {
  PlanMaker k = testing::good_plan();
  setup(k).its_origin = placed(k, {123, 45, 6}, {0, 0, 1}, {1, 0, 0});
  EXPECT_EQ(errors(k.plan), "");
}

TEST(CheckSetups, APlanThatTakesATurnAboutZForNoneIsFoundWhicheverPlacementStatesIt) {
  for (const double degrees : {90.0, 30.0, -45.0, 180.0}) {
    const geometry::Placement turn = turned(degrees);
    for (const bool of_setup : {true, false}) {
      PlanMaker k = testing::good_plan();
      const auto frame = placed(k, {}, {0, 0, 1}, turn.x);
      (of_setup ? setup(k).its_origin : piece(k).its_origin) = frame;
      EXPECT_NE(errors(k.plan), "") << degrees << (of_setup ? " set-up" : " workpiece");
      // The same with its paths turned is right.
      move_paths(k, turn);
      EXPECT_EQ(errors(k.plan), "") << degrees << (of_setup ? " set-up" : " workpiece");
    }
  }
}

TEST(CheckSetups, ALeanIsAnErrorOfEachStepWithPlacementAngleAndWhatToDo) {
  const double a = std::numbers::pi / 18.0;
  for (const bool of_setup : {true, false}) {
    PlanMaker k = testing::good_plan();
    const auto frame = placed(k, {}, {0, -std::sin(a), std::cos(a)}, {1, 0, 0});
    (of_setup ? setup(k).its_origin : piece(k).its_origin) = frame;
    const auto findings = check(k.plan);
    const auto leans = std::count_if(findings.begin(), findings.end(), [](const auto& f) {
      return f.code == "CHK-SETUP-LEANS" && f.severity == Severity::kError;
    });
    EXPECT_EQ(leans, 2) << errors(k.plan);
    const std::string text = errors(k.plan);
    EXPECT_TRUE(told(text, "feature 'P' leans 10 degrees from the tool's in SETUP 'setup'")) << text;
    EXPECT_TRUE(told(text, of_setup ? "(SETUP.its_origin leans by 10 degrees)"
                                    : "(WORKPIECE_SETUP.its_origin leans by 10 degrees)"))
        << text;
    EXPECT_TRUE(told(text, "correct the placement")) << text;
  }
}

TEST(CheckSetups, AWorkpieceThatIsTurnedOverIsAnError) {
  for (const bool of_setup : {true, false}) {
    PlanMaker k = testing::good_plan();
    const auto frame = placed(k, {0, 100, -50}, {0, 0, -1}, {1, 0, 0});
    (of_setup ? setup(k).its_origin : piece(k).its_origin) = frame;
    EXPECT_TRUE(told(errors(k.plan), "leans 180 degrees from the tool's")) << errors(k.plan);
  }
}

TEST(CheckSetups, ALeanOfTheSetUpThatTheWorkpieceTakesBackIsNone) {
  const double a = 0.2;
  PlanMaker k = testing::good_plan();
  const auto there = placed(k, {}, {0, -std::sin(a), std::cos(a)}, {1, 0, 0});
  const auto back = placed(k, {}, {0, std::sin(a), std::cos(a)}, {1, 0, 0});
  setup(k).its_origin = there;
  piece(k).its_origin = back;
  EXPECT_FALSE(told(errors(k.plan), "CHK-SETUP")) << errors(k.plan);
}

TEST(CheckSetups, APlacementThatIsNoneIsAnErrorAndNotTakenForStraightInSilence) {
  for (const bool of_setup : {true, false}) {
    PlanMaker k = testing::good_plan();
    const auto frame = placed(k, {}, {0, 0, 0}, {1, 0, 0});
    (of_setup ? setup(k).its_origin : piece(k).its_origin) = frame;
    EXPECT_TRUE(told(errors(k.plan), "its_origin is no placement")) << errors(k.plan);
  }
}

TEST(CheckSetups, AnOffsetThatTheControlIsToAddIsTold) {
  PlanMaker k = testing::good_plan();
  const auto offset = k.plan.model.add(model::OffsetVector{});
  piece(k).its_offset = offset;
  const auto findings = check(k.plan);
  EXPECT_TRUE(std::any_of(findings.begin(), findings.end(),
                          [](const auto& f) { return f.code == "CHK-SETUP-OFFSET"; }));
}

}  // namespace
}  // namespace capstan::verify
