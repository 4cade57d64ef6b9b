#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>

#include "planner/door/pipeline/checked.h"
#include "planner/ground/base/number.h"
#include "planner/model/features/setup_place.h"
#include "planner/model/plan/resources/setup_position.h"
#include "planner/proof/verify/verify.h"
#include "tests/door/pipeline/block.h"

// A block whose set-up, or whose workpiece in the set-up, is shifted, turned, tilted or turned over.

namespace capstan::pipeline {
namespace {

using geometry::Placement;
using geometry::Vec3;

/// A pocket in the middle, a blind hole and a through hole.
const std::string kFeatures =
    "#61=TOLERANCED_LENGTH_MEASURE(8.,$);\n#60=FLAT_HOLE_BOTTOM();\n"
    "#64=CARTESIAN_POINT('',(20.,25.,0.));\n#65=AXIS2_PLACEMENT_3D('',#64,#21,#22);\n"
    "#66=ROUND_HOLE('BLIND',#4,(),#65,#56,#61,$,#60);\n"
    "#70=CARTESIAN_POINT('',(0.,0.,-20.));\n#71=AXIS2_PLACEMENT_3D('',#70,#21,#22);\n#72=PLANE('',#71);\n"
    "#73=CARTESIAN_POINT('',(80.,30.,0.));\n#74=AXIS2_PLACEMENT_3D('',#73,#21,#22);\n"
    "#75=ROUND_HOLE('THROUGH',#4,(),#74,#72,#61,$,#58);\n"
    "#76=TOLERANCED_LENGTH_MEASURE(5.,$);\n#77=TOLERANCED_LENGTH_MEASURE(30.,$);\n"
    "#78=TOLERANCED_LENGTH_MEASURE(20.,$);\n#79=RECTANGULAR_CLOSED_PROFILE($,#78,#77);\n"
    "#80=CLOSED_POCKET('POCKET',#4,(),#50,#53,(),$,#57,$,#76,#79);\n";

std::string vector_text(Vec3 v) {
  const auto number = [](double x) {
    const std::string text = trimmed(x, 12);
    return text.find('.') == std::string::npos ? text + "." : text;
  };
  return "(" + number(v.x) + "," + number(v.y) + "," + number(v.z) + ")";
}

enum class Of { kSetup, kWorkpiece };

/// The block with that placement.
std::string part(Of of, const Placement& at) {
  const std::string text =
      block::part_text(kFeatures + "#90=CARTESIAN_POINT(''," + vector_text(at.origin) +
                       ");\n#91=DIRECTION(''," + vector_text(at.z) + ");\n#92=DIRECTION(''," +
                       vector_text(at.x) + ");\n#93=AXIS2_PLACEMENT_3D('',#90,#91,#92);\n");
  const std::string from = of == Of::kSetup ? "SETUP('SETUP1',#28," : "WORKPIECE_SETUP(#4,#28,";
  const std::string to = of == Of::kSetup ? "SETUP('SETUP1',#93," : "WORKPIECE_SETUP(#4,#93,";
  std::string out = text;
  const auto where = out.find(from);
  EXPECT_NE(where, std::string::npos);
  return out.replace(where, from.size(), to);
}

block::Planned planned(Of of, const Placement& at) {
  Job job;
  auto plan = read_plan(part(of, at), "part.p21", job);
  EXPECT_TRUE(plan) << (plan ? "" : to_text(plan.error()));
  return block::bound(*std::move(plan));
}

std::string errors_of(const model::Plan& plan) {
  Job job;
  std::string out;
  for (const auto& f : verify::check_plan(plan, job)) {
    if (f.severity == Severity::kError) out += f.code + " " + f.step + ": " + f.message + "\n";
  }
  return out;
}

Placement turned(double degrees, Vec3 origin = {}) {
  const double a = degrees / 180.0 * std::numbers::pi;
  return *geometry::make_placement(origin, {0, 0, 1}, {std::cos(a), std::sin(a), 0});
}
Placement tilted(double degrees) {
  const double a = degrees / 180.0 * std::numbers::pi;
  return *geometry::make_placement({}, {0, -std::sin(a), std::cos(a)}, {1, 0, 0});
}
const Placement kOver = *geometry::make_placement({0, 100, -20}, {0, 0, -1}, {1, 0, 0});

/// Whether a step drills at that place of the program, within 0.01 mm.
bool drills_at(const model::Plan& plan, Vec3 at) {
  for (const auto& s : plan.steps) {
    for (std::size_t i = 0; s.path && i < s.path->size(); ++i) {
      if (s.path->role[i] == model::MoveRole::kDrill && norm(xy(s.path->point(i)) - xy(at)) < 0.01)
        return true;
    }
  }
  return false;
}

bool told(const std::string& text, const std::string& what) { return text.find(what) != std::string::npos; }

TEST(PlacedSetups, AShiftedWorkpieceShiftsEveryPointOfTheProgram) {
  const auto straight = planned(Of::kWorkpiece, {});
  const Placement by{.origin = {20, 30, 5}};
  const auto shifted = planned(Of::kWorkpiece, by);
  ASSERT_EQ(straight.plan.steps.size(), shifted.plan.steps.size()) << shifted.said;
  EXPECT_TRUE(shifted.plan.unplanned.empty()) << shifted.said;
  EXPECT_EQ(errors_of(shifted.plan), "");
  for (const Vec3 hole : {Vec3{20, 25, 0}, Vec3{80, 30, 0}}) {
    EXPECT_TRUE(drills_at(straight.plan, hole));
    EXPECT_TRUE(drills_at(shifted.plan, hole + by.origin));
    EXPECT_FALSE(drills_at(shifted.plan, hole));
  }
}

TEST(PlacedSetups, AShiftedSetUpHasItsZeroElsewhereAndTheSameProgram) {
  const auto straight = planned(Of::kSetup, {});
  const auto shifted = planned(Of::kSetup, {.origin = {123, 45, 6}});
  ASSERT_EQ(straight.plan.steps.size(), shifted.plan.steps.size());
  for (std::size_t i = 0; i < straight.plan.steps.size(); ++i)
    EXPECT_EQ(*straight.plan.steps[i].path, *shifted.plan.steps[i].path) << i;
}

TEST(PlacedSetups, ATurnAboutZIsTurnedInTheProgramWhicheverPlacementStatesIt) {
  for (const double degrees : {90.0, 30.0}) {
    const Placement turn = turned(degrees);
    for (const Of of : {Of::kSetup, Of::kWorkpiece}) {
      const auto made = planned(of, turn);
      EXPECT_TRUE(made.plan.unplanned.empty()) << made.said;
      EXPECT_EQ(made.plan.setups.size(), 1U);
      EXPECT_EQ(errors_of(made.plan), "") << degrees;
      EXPECT_TRUE(drills_at(made.plan, turn.to_parent({20, 25, 0}))) << degrees;
      EXPECT_TRUE(drills_at(made.plan, turn.to_parent({80, 30, 0}))) << degrees;
      EXPECT_EQ(told(made.said, "[PIP-SETUP-TURNED]"), of == Of::kSetup) << made.said;
    }
    const auto a = planned(Of::kSetup, turn), b = planned(Of::kWorkpiece, turn);
    ASSERT_EQ(a.plan.steps.size(), b.plan.steps.size());
    for (std::size_t i = 0; i < a.plan.steps.size(); ++i)
      EXPECT_EQ(*a.plan.steps[i].path, *b.plan.steps[i].path) << i;
  }
}

TEST(PlacedSetups, ATurnThatPlanningGetsWrongIsFoundByTheCheck) {
  for (const double degrees : {90.0, 30.0}) {
    for (const Of of : {Of::kSetup, Of::kWorkpiece}) {
      auto made = planned(of, turned(degrees));
      const auto straight = planned(of, {});
      // The paths of the straight piece, in the plan of the turned one.
      made.plan.steps = straight.plan.steps;
      EXPECT_NE(errors_of(made.plan), "") << degrees;
    }
  }
}

TEST(PlacedSetups, ATurnedSetUpComesBackFromEveryFormWithTheSamePaths) {
  const auto made = planned(Of::kSetup, turned(30.0, {7, 8, 9}));
  for (const Format format : {Format::kIso14649, Format::kAp238, Format::kJson}) {
    Job job;
    auto text = write_plan(made.plan, format, job);
    ASSERT_TRUE(text);
    auto again = read_plan(*std::move(text), "again", job);
    ASSERT_TRUE(again) << to_text(again.error());
    auto bound = block::bound(*std::move(again));
    ASSERT_EQ(bound.plan.steps.size(), made.plan.steps.size()) << bound.said;
    EXPECT_EQ(errors_of(bound.plan), "");
    EXPECT_TRUE(drills_at(bound.plan, turned(30.0).to_parent({20, 25, 0})));
  }
}

TEST(PlacedSetups, ATiltedWorkpieceIsClampedAnewAndTheFileIsToldOfByPlacementAndAngle) {
  for (const Of of : {Of::kSetup, Of::kWorkpiece}) {
    const auto made = planned(of, tilted(10.0));
    const std::string by = of == Of::kSetup ? "SETUP.its_origin" : "WORKPIECE_SETUP.its_origin";
    EXPECT_TRUE(told(made.said, "[PIP-SETUP-LEANS]")) << made.said;
    EXPECT_TRUE(told(made.said, "SETUP 'SETUP1': " + by +
                                    " has the workpiece turned 10 deg about its X axis, "
                                    "10 degrees off the tool axis"))
        << made.said;
    EXPECT_TRUE(told(made.said, "it is not used")) << made.said;
    ASSERT_EQ(made.plan.setups.size(), 1U);
    EXPECT_NE(made.plan.model.at<model::Setup>(made.plan.setups[0].setup).its_id, "SETUP1");
    EXPECT_LE(model::lean_rad(model::placed_in(made.plan, 0)), model::kUprightRad);
    EXPECT_EQ(errors_of(made.plan), "");
  }
}

TEST(PlacedSetups, OfAWorkpieceThatIsTurnedOverOnlyWhatGoesThroughIsCutSo) {
  for (const Of of : {Of::kSetup, Of::kWorkpiece}) {
    const auto made = planned(of, kOver);
    EXPECT_TRUE(told(made.said, "[PIP-SETUP-LEANS]")) << made.said;
    EXPECT_TRUE(told(made.said, "turned over, 180 deg about its X axis")) << made.said;
    EXPECT_EQ(errors_of(made.plan), "");
    EXPECT_TRUE(made.plan.unplanned.empty()) << made.said;
    for (const auto& s : made.plan.steps) {
      const auto* ws = made.plan.model.get<model::MachiningWorkingstep>(s.step);
      const auto* f = made.plan.model.get<model::ManufacturingFeature>(ws->its_feature);
      const bool over = model::placed_in(made.plan, s.setup).z.z < 0.0;
      EXPECT_TRUE(!over || f->its_id == "THROUGH");
    }
  }
}

/// The straight block's plan, as a file with operations and paths, its placement changed since.
model::Plan with_operations(Of of, const Placement& at) {
  auto made = planned(of, {});
  model::Model& m = made.plan.model;
  for (const auto r : m.all(model::TypeId::kSetup)) {
    auto& s = m.at<model::Setup>(r);
    auto& w = m.at<model::WorkpieceSetup>(s.its_workpiece_setup[0]);
    const auto frame = of == Of::kSetup ? s.its_origin : w.its_origin;
    auto& noun = m.at<model::Axis2Placement3d>(frame);
    const auto direction = [&](Vec3 v) {
      model::Direction d;
      d.direction_ratios = {{v.x, v.y, v.z}, true};
      return m.add(d);
    };
    // The two placements are one instance in the file.
    model::Axis2Placement3d own = noun;
    own.axis = direction(at.z);
    own.ref_direction = direction(at.x);
    const auto made_frame = m.add(own);
    (of == Of::kSetup ? s.its_origin : w.its_origin) = made_frame;
  }
  return std::move(made.plan);
}

TEST(PlacedSetups, StepsOfAFileInATiltedSetUpAreNotMadeAndSayWhy) {
  for (const Of of : {Of::kSetup, Of::kWorkpiece}) {
    for (const Placement& at : {tilted(10.0), kOver}) {
      const bool over = at.z.z < 0.0;
      const model::Plan brought = with_operations(of, at);
      EXPECT_TRUE(told(errors_of(brought), "CHK-SETUP-LEANS")) << errors_of(brought);
      const auto made = block::bound(brought);
      const auto made_of = [&](const std::string& id) {
        return std::any_of(made.plan.steps.begin(), made.plan.steps.end(), [&](const auto& s) {
          const auto* ws = made.plan.model.template get<model::MachiningWorkingstep>(s.step);
          return made.plan.model.template get<model::ManufacturingFeature>(ws->its_feature)->its_id == id;
        });
      };
      for (const char* id : {"BLIND", "POCKET"}) {
        EXPECT_FALSE(made_of(id)) << id;
        EXPECT_TRUE(told(made.said, std::string("the axis of feature '") + id + "' leans " +
                                        (over ? "180" : "10") + " degrees from the tool's in SETUP 'SETUP1'"))
            << made.said;
      }
      EXPECT_TRUE(
          told(made.said, (of == Of::kSetup ? "correct SETUP.its_origin" : "correct WORKPIECE_SETUP")))
          << made.said;
      EXPECT_FALSE(made.plan.unplanned.empty());
    }
  }
}

TEST(PlacedSetups, ASecurityPlaneThatIsNotSquareToTheToolIsNotReliedOn) {
  std::string text = part(Of::kSetup, {});
  const std::string plane = "#30=AXIS2_PLACEMENT_3D('',#29,#21,#22);";
  ASSERT_NE(text.find(plane), std::string::npos);
  text.replace(text.find(plane), plane.size(),
               "#30=AXIS2_PLACEMENT_3D('',#29,#95,#22);\n#95=DIRECTION('',(0.,0.5,1.));");
  Job job;
  auto plan = read_plan(text, "part.p21", job);
  ASSERT_TRUE(plan) << to_text(plan.error());
  const auto made = block::bound(*std::move(plan));
  EXPECT_TRUE(told(made.said, "its_secplane is not square to the tool axis")) << made.said;
  EXPECT_EQ(errors_of(made.plan), "");
}

TEST(PlacedSetups, CoordinatesThatNoMachineHasAreOneErrorWithNameAndLimit) {
  for (const char* far : {"1.E6", "-1.E6", "1.E300"}) {
    std::string text = part(Of::kSetup, {});
    const std::string point = "#64=CARTESIAN_POINT('',(20.,";
    text.replace(text.find(point), point.size(), std::string("#64=CARTESIAN_POINT('',(") + far + ",");
    Job job;
    auto plan = read_plan(text, "part.p21", job);
    ASSERT_TRUE(plan) << to_text(plan.error());
    Tries tries;
    const auto made = bind_within(*plan, block::shop(), {}, tries, job);
    ASSERT_FALSE(made) << far;
    EXPECT_EQ(made.error().code, "PIP-RANGE");
    EXPECT_TRUE(told(made.error().message, "#64 CARTESIAN_POINT.coordinates is")) << made.error().message;
    EXPECT_TRUE(told(made.error().message, "100000")) << made.error().message;
  }
}

/// The block beside a second workpiece, which its set-up names first.
model::Plan beside_another() {
  std::string text = block::part_text(kFeatures +
                                      "#94=WORKPIECE_SETUP(#95,#28,$,$,());\n"
                                      "#95=WORKPIECE('SECOND',#6,0.1,#5,$,$,());\n");
  const std::string from = "#31,(#9))";
  const auto where = text.find(from);
  EXPECT_NE(where, std::string::npos);
  Job job;
  auto plan = read_plan(text.replace(where, from.size(), "#31,(#94,#9))"), "part.p21", job);
  EXPECT_TRUE(plan) << (plan ? "" : to_text(plan.error()));
  return plan ? *std::move(plan) : model::Plan{};
}

TEST(PlacedSetups, ASecondWorkpieceInASetUpIsTold) {
  const auto made = block::bound(beside_another());
  EXPECT_TRUE(told(made.said, "PIP-WORKPIECES")) << made.said;
  EXPECT_TRUE(told(made.said, "holds 2 workpieces; only 'PART' is planned")) << made.said;
  EXPECT_TRUE(told(made.said, "'SECOND'")) << made.said;
  EXPECT_FALSE(told(block::bound(block::read(kFeatures)).said, "PIP-WORKPIECES"));
}

TEST(PlacedSetups, WhatHoldsThePieceIsSaidOfItAndNotOfTheFirst) {
  Inputs in = block::shop();
  in.workholding = "auto";
  const auto made = block::bound(beside_another(), in);
  const model::Model& m = made.plan.model;
  std::size_t said = 0;
  for (const auto r : m.all(model::TypeId::kWorkpieceSetup)) {
    const auto* piece = m.get<model::WorkpieceSetup>(r);
    const auto* of = m.get<model::Workpiece>(piece->its_workpiece);
    ASSERT_NE(of, nullptr);
    const bool instructed = !piece->its_instructions.items.empty();
    EXPECT_EQ(instructed, of->its_id == "PART") << of->its_id.value_or("");
    said += instructed ? 1 : 0;
  }
  EXPECT_EQ(said, 1U);
}

}  // namespace
}  // namespace capstan::pipeline
