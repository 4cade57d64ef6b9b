// Cutters whose edges lean, from the choice to the check: face mills of 45 degrees, high-feed mills, drills
// with inserts.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>

#include "planner/model/nouns/all.h"
#include "planner/proof/verify/verify.h"
#include "tests/support/corpus.h"
#include "tests/support/shop.h"

namespace capstan::pipeline {
namespace {

std::string replaced(std::string text, const std::string& from, const std::string& to) {
  const auto at = text.find(from);
  EXPECT_NE(at, std::string::npos) << from;
  return at == std::string::npos ? text : text.replace(at, from.size(), to);
}

/// The bracket with 3.1 mm on its top face, which are roughed and finished, and mounting holes of 15 mm.
std::string bracket() {
  std::string text = testing::slurp(capstan::testing::source_dir() + "/examples/bracket.p21");
  text = replaced(text, "('TOP FACE',(0.,0.,1.))", "('TOP FACE',(0.,0.,3.1))");
  text = replaced(text, "('TOP FACE: DEPTH',(0.,0.,-1.))", "('TOP FACE: DEPTH',(0.,0.,-3.1))");
  text = replaced(text, "#25,120.,80.,31.)", "#25,120.,80.,33.1)");
  return replaced(text, "TOLERANCED_LENGTH_MEASURE(6.6,#55)", "TOLERANCED_LENGTH_MEASURE(15.,#55)");
}

bool with_inserts(const model::Cutter& c) {
  return c.cutter_class == model::CutterClass::kTwistDrill && c.teeth == 1;
}

/// A shop without upright face mills and without solid drills above 14 mm, on a machine with coolant through
/// its spindle.
Inputs shop() {
  Job job;
  Inputs in = load_shop({}, job).value();
  std::erase_if(in.library, [](const model::Cutter& c) {
    if (c.cutter_class == model::CutterClass::kFacemill) return c.lead_angle_rad == 0.0;
    return c.cutter_class == model::CutterClass::kTwistDrill && c.cutting_diameter_mm >= 14.0 &&
           !with_inserts(c);
  });
  in.machine.has_through = true;
  in.material_name = "C45";
  return in;
}

const model::Plan& planned() {
  static const model::Plan kPlan = [] {
    Job job;
    auto plan = read_plan(bracket(), "bracket.p21", job);
    return bind(plan.value(), shop(), {}, job).value();
  }();
  return kPlan;
}

const model::StepResult& step_of(const model::Plan& plan, const std::string& id) {
  const auto at = std::find_if(plan.steps.begin(), plan.steps.end(),
                               [&](const auto& s) { return model::step_id(plan, s) == id; });
  EXPECT_NE(at, plan.steps.end()) << id;
  return at == plan.steps.end() ? plan.steps.front() : *at;
}

TEST(LeaningEdges, ArePlannedAndPassTheCheckOfTheirOwnOutlines) {
  const model::Plan& plan = planned();
  EXPECT_TRUE(plan.unplanned.empty());
  const model::Cutter* face = model::find_cutter(plan, step_of(plan, "TOP FACE plane_finish").cutter_id);
  ASSERT_NE(face, nullptr);
  EXPECT_NEAR(face->lead_angle_rad, 0.25 * std::numbers::pi, 1e-9) << face->id;
  const model::StepResult& hole = step_of(plan, "MOUNTING HOLES[1] drill");
  const model::Cutter* drill = model::find_cutter(plan, hole.cutter_id);
  ASSERT_NE(drill, nullptr);
  EXPECT_TRUE(with_inserts(*drill)) << drill->id;
  EXPECT_TRUE(std::none_of(plan.steps.begin(), plan.steps.end(), [&](const auto& s) {
    return model::step_id(plan, s).starts_with("MOUNTING HOLES") &&
           model::step_id(plan, s).ends_with("centre");
  })) << "it starts by itself";
  // At one go: one way down for each of the four holes.
  const auto drills = std::count(hole.path->role.begin(), hole.path->role.end(), model::MoveRole::kDrill);
  EXPECT_EQ(drills, 4);
  Job job;
  for (const auto& f : verify::check_plan(plan, job)) EXPECT_EQ(f.severity, Severity::kNote) << f.message;
}

TEST(LeaningEdges, TurnAtTheSpeedOfTheCircleWhereTheyLeaveTheMaterial) {
  const model::StepResult& s = step_of(planned(), "TOP FACE plane_finish");
  const model::Cutter* face = model::find_cutter(planned(), s.cutter_id);
  const double widest = face->cutting_diameter_mm + 2.0 * s.axial_depth_mm;  // tan 45 degrees
  const double vc = std::numbers::pi * widest * std::abs(s.spindle_rpm) / 1000.0;
  EXPECT_NEAR(vc, 2.2 * 78.0, 0.01 * 2.2 * 78.0) << "of the card, coated inserts";
}

TEST(LeaningEdges, ComeBackFromEveryFormOfThePlan) {
  for (const auto& [format, name] :
       {std::pair(Format::kIso14649, "p.p21"), std::pair(Format::kAp238, "p.stpnc"),
        std::pair(Format::kJson, "p.json")}) {
    Job job;
    const auto text = write_plan(planned(), format, job);
    ASSERT_TRUE(text) << name << ": " << text.error().message;
    const auto read = read_plan(*text, name, job);
    ASSERT_TRUE(read) << name << ": " << read.error().message;
    for (const char* step : {"TOP FACE plane_finish", "MOUNTING HOLES[1] drill"}) {
      const model::Cutter* was = model::find_cutter(planned(), step_of(planned(), step).cutter_id);
      const model::Cutter* is = model::find_cutter(*read, was->id);
      ASSERT_NE(is, nullptr) << name << " " << was->id;
      EXPECT_EQ(is->cutter_class, was->cutter_class) << name;
      EXPECT_NEAR(is->lead_angle_rad, was->lead_angle_rad, 1e-9) << name;
      EXPECT_NEAR(is->point_angle_rad, was->point_angle_rad, 1e-9) << name;
      EXPECT_EQ(is->teeth, was->teeth) << name;
    }
  }
}

// Its edges lean by 78 degrees over a millimetre and a half: a level of the whole layer would be deeper than
// they are, and the speed is that of a circle that is half as wide again as its tip's.
TEST(LeaningEdges, OfAHighFeedMillRoughAFaceInLevelsNoDeeperThanTheyAre) {
  Inputs in = shop();
  std::erase_if(in.library, [](const model::Cutter& c) {
    return c.cutter_class == model::CutterClass::kFacemill && c.lead_angle_rad < 1.0 &&
           c.cutting_diameter_mm < 90.0;
  });
  std::erase_if(in.library, [](const model::Cutter& c) {  // what else could rough it
    return c.cutter_class == model::CutterClass::kEndmill && c.cutting_diameter_mm > 12.0;
  });
  for (auto& at : in.machine.spindle.curve) {
    at.power_w *= 4.0;
    at.torque_nm *= 4.0;
  }
  Job job;
  auto given = read_plan(bracket(), "bracket.p21", job);
  const model::Plan plan = bind(given.value(), in, {}, job).value();
  const model::StepResult& s = step_of(plan, "TOP FACE plane_rough");
  const model::Cutter* c = model::find_cutter(plan, s.cutter_id);
  ASSERT_NE(c, nullptr);
  EXPECT_NEAR(c->lead_angle_rad, 78.0 * std::numbers::pi / 180.0, 1e-9) << c->id;
  EXPECT_LE(s.axial_depth_mm, c->maximum_depth_of_cut_mm + 1e-9);
  EXPECT_GT(s.fz_mm, 0.4);
  EXPECT_LT(s.loads.chip_thickness_mm, 0.13) << "fz sin 12 degrees";
  for (const auto& f : verify::check_plan(plan, job)) EXPECT_EQ(f.severity, Severity::kNote) << f.message;
}

}  // namespace
}  // namespace capstan::pipeline
