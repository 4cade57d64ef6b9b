#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <memory>
#include <string>

#include "planner/model/nouns/all.h"
#include "rules/rules.h"
#include "tests/support/corpus.h"
#include "tests/support/scratch.h"
#include "tests/support/shop.h"

namespace capstan::pipeline {
namespace {

const std::string kSource = capstan::testing::source_dir();

Inputs shop() {
  Job job;
  auto in = load_shop({}, job);
  EXPECT_TRUE(in) << (in ? "" : in.error().message);
  return in ? *std::move(in) : Inputs{};
}

model::Plan planned(const std::string& file, const Inputs& in) {
  Job job;
  auto plan = read_plan(testing::slurp(kSource + file), file, job);
  EXPECT_TRUE(plan) << (plan ? "" : to_text(plan.error()));
  if (!plan) return {};
  auto out = bind(*std::move(plan), in, {}, job);
  EXPECT_TRUE(out) << (out ? "" : to_text(out.error()));
  return out ? *std::move(out) : model::Plan{};
}

const model::StepResult* step(const model::Plan& plan, const std::string& name) {
  for (const auto& s : plan.steps) {
    if (model::step_id(plan, s) == name) return &s;
  }
  return nullptr;
}

void expect_sound(const model::Plan& plan) {
  for (const auto& u : plan.unplanned) ADD_FAILURE() << u.reason;
  Job job;
  for (const auto& f : findings_of(plan, job))
    EXPECT_EQ(f.severity, Severity::kNote) << f.code << " " << f.message;
}

TEST(FormFeatures, KeepTheTorqueOfBothEdgesUnderAnOverhang) {
  const auto torque_on = [](const Inputs& in) {
    const model::Plan plan = planned("/tests/door/pipeline/parts/form_features.p21", in);
    const auto* form = step(plan, "T-SLOT t_slot_finish");
    EXPECT_NE(form, nullptr);
    return form != nullptr ? form->loads.torque_nm : 0.0;
  };
  Inputs in = shop();
  const double both = torque_on(in);
  ASSERT_GT(both, 0.0) << "the load of the heaviest pass is told";
  // One edge takes half of that: a spindle of 0.8 bears it, and not both at the same feed.
  double most = 0.0;
  for (const auto& p : in.machine.spindle.curve) most = std::max(most, p.torque_nm);
  const double scale = 0.8 * both / (most * in.machine.spindle.efficiency);
  for (auto& p : in.machine.spindle.curve) {
    p.power_w *= scale;
    p.torque_nm *= scale;
  }
  EXPECT_LE(torque_on(in), 0.8 * both * (1.0 + 1e-6));
}

TEST(FormFeatures, ArePlannedWholeAndCheckedWithoutFindings) {
  const model::Plan plan = planned("/tests/door/pipeline/parts/form_features.p21", shop());
  expect_sound(plan);
  for (const char* name : {"T-SLOT t_slot_rough", "T-SLOT t_slot_finish", "POCKET EDGE edge_round"}) {
    const auto* s = step(plan, name);
    ASSERT_NE(s, nullptr) << name;
    EXPECT_TRUE(s->path && s->schedule) << name;
    EXPECT_GT(s->feed_mm_min, 0.0) << name;
  }
  const auto* form = step(plan, "T-SLOT t_slot_finish");
  const model::Cutter* cutter = model::find_cutter(plan, form->cutter_id);
  ASSERT_NE(cutter, nullptr);
  EXPECT_EQ(cutter->cutter_class, model::CutterClass::kTSlotMill);
  EXPECT_FALSE(form->sections) << "what is cut under the overhang is not measured, and not made up";
  // 45 mm with 8 mm are pecked, and the operation says so.
  const auto* hole = step(plan, "DEEP HOLE drill");
  if (hole == nullptr) hole = step(plan, "DEEP HOLE peck_drill");
  ASSERT_NE(hole, nullptr);
  const auto* ws = plan.model.get<model::MachiningWorkingstep>(hole->step);
  EXPECT_TRUE(plan.model.holds<model::MultistepDrilling>(ws->its_operation));
}

TEST(FormFeatures, DovetailsDrawnOrByTheirAnglesAreCutByACutterOfTheirAngle) {
  const model::Plan plan = planned("/tests/door/pipeline/parts/dovetails.p21", shop());
  expect_sound(plan);
  for (const auto& [name, lean_deg] : {std::pair("DRAWN", 45.0), std::pair("ANGLED", 30.0)}) {
    const auto* form = step(plan, std::string(name) + " dovetail_finish");
    ASSERT_NE(form, nullptr) << name;
    ASSERT_TRUE(form->path) << name;
    const model::Cutter* cutter = model::find_cutter(plan, form->cutter_id);
    ASSERT_NE(cutter, nullptr);
    EXPECT_EQ(cutter->cutter_class, model::CutterClass::kDovetailMill);
    EXPECT_NEAR(cutter->lead_angle_rad * 180.0 / 3.14159265358979, lean_deg, 0.01);
  }
}

TEST(FormFeatures, FarEndsOfHolesAreMilledFromBelowThroughTheNarrowHole) {
  const model::Plan plan = planned("/tests/door/pipeline/parts/far_ends.p21", shop());
  expect_sound(plan);
  for (const char* name : {"COUNTERBORED[2] back_mill", "COUNTERSUNK[2] back_chamfer"}) {
    const auto* s = step(plan, name);
    ASSERT_NE(s, nullptr) << name;
    ASSERT_TRUE(s->path) << name;
    const model::Cutter* c = model::find_cutter(plan, s->cutter_id);
    ASSERT_NE(c, nullptr);
    const bool cone = c->cutter_class == model::CutterClass::kBackCountersink;
    const double x = cone ? 85.0 : 30.0, widest = cone ? 12.5 : 13.0;
    double reached = 0.0;
    for (std::size_t i = 0; i < s->path->size(); ++i) {
      const auto p = s->path->point(i);
      const double aside = std::hypot(p.x - x, p.y - 30.0);
      reached = std::max(reached, aside + 0.5 * c->cutting_diameter_mm);
      if (p.z > -25.0) {
        EXPECT_LT(aside, 1e-9) << "the head is in the narrow hole: in its middle only";
      }
      EXPECT_LE(0.5 * c->neck_diameter_mm + aside, 9.9 + 1e-9);
    }
    EXPECT_NEAR(reached, widest, 1e-6) << name;
  }
}

TEST(FormFeatures, UndercutsInSteelAreMadeWithinTheLifeOfAnEdge) {
  Inputs in = shop();
  in.material_name = "C45";
  for (const char* part : {"far_ends", "dovetails", "form_features"}) {
    const model::Plan plan = planned("/tests/door/pipeline/parts/" + std::string(part) + ".p21", in);
    expect_sound(plan);
    Job job;
    for (const auto& f : findings_of(plan, job))
      EXPECT_NE(f.code, "CHK-EDGES") << f.step << ": " << f.message;
  }
}

TEST(FormFeatures, ADovetailsCutterTakesWhatStandsBesideTheMouthNotASlotOfItsDiameter) {
  const model::Plan plan = planned("/tests/door/pipeline/parts/dovetails.p21", shop());
  for (const char* name : {"DRAWN dovetail_finish", "ANGLED dovetail_finish"}) {
    const auto* s = step(plan, name);
    ASSERT_NE(s, nullptr) << name;
    const model::Cutter* c = model::find_cutter(plan, s->cutter_id);
    ASSERT_NE(c, nullptr);
    EXPECT_LT(s->radial_depth_mm, 0.5 * c->cutting_diameter_mm) << name;
  }
}

TEST(FormFeatures, AHeadThatTurnsOutInsideTheNarrowHoleIsFound) {
  model::Plan plan = planned("/tests/door/pipeline/parts/far_ends.p21", shop());
  for (auto& s : plan.steps) {
    if (model::step_id(plan, s) != "COUNTERBORED[2] back_mill" || !s.path) continue;
    model::CutterPath higher = *s.path;
    for (double& z : higher.z) z += 2.0;
    s.path = std::make_shared<const model::CutterPath>(std::move(higher));
  }
  Job job;
  const auto findings = findings_of(plan, job);
  EXPECT_TRUE(std::any_of(findings.begin(), findings.end(), [](const auto& f) {
    return f.code == "CHK-HEAD" && f.step == "COUNTERBORED[2] back_mill";
  }));
}

TEST(EdgeBreaks, AreCutWhereTheShopAsksAndCheckedWithoutFindings) {
  Inputs in = shop();
  in.edge_break_mm = 0.3;
  const model::Plan plan = planned("/examples/bracket.p21", in);
  expect_sound(plan);
  const auto broken = std::count_if(plan.steps.begin(), plan.steps.end(), [&](const auto& s) {
    return model::step_id(plan, s).find("break_edge") != std::string::npos;
  });
  EXPECT_GE(broken, 5);
}

TEST(RestMachining, FollowsAWideCutterWithOneThatFitsTheCorners) {
  const std::filesystem::path dir = std::filesystem::path(capstan::testing::scratch_file("rest_rows"));
  std::filesystem::create_directories(dir);
  std::ofstream(dir / "pocket.yaml") << R"(table: pocket
rows:
  - id: shop.rest
    priority: 0
    when: {wall: [upright]}
    chains:
      - [{do: area_rough, corners: 0, allowance_side_mm: 0.3, allowance_bottom_mm: 0.2},
         {do: rest_rough, allowance_side_mm: 0.3, allowance_bottom_mm: 0.2},
         {do: area_finish, corners: 0}, rest_finish]
    source: "test"
)";
  Inputs in = shop();
  Job job;
  auto rules = rules::load_rules(dir.string(), job);
  ASSERT_TRUE(rules) << rules.error().message;
  in.rules = *std::move(rules);
  const model::Plan plan = planned("/examples/bracket.p21", in);
  expect_sound(plan);
  const auto* wide = step(plan, "POCKET area_rough");
  const auto* rest = step(plan, "POCKET rest_rough");
  ASSERT_TRUE(wide != nullptr && rest != nullptr);
  const double d = model::find_cutter(plan, wide->cutter_id)->cutting_diameter_mm;
  const double small = model::find_cutter(plan, rest->cutter_id)->cutting_diameter_mm;
  EXPECT_GT(d, 14.0);
  EXPECT_LE(small, 10.8);
  EXPECT_LT(rest->cutting_s, 0.6 * wide->cutting_s) << "corners only";
}

}  // namespace
}  // namespace capstan::pipeline
