#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <numbers>
#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "planner/making/step/cut_samples.h"
#include "planner/model/nouns/all.h"
#include "planner/proof/verify/verify.h"
#include "tests/support/corpus.h"
#include "tests/support/plate.h"
#include "tests/support/scratch.h"
#include "tests/support/shop.h"
#include "tooling/shop/machine/machine.h"

// Features are made whole or not at all, and what the check condemns is made anew.

namespace capstan::pipeline {
namespace {

using model::CutterClass;

const std::string kBracket = capstan::testing::source_dir() + "/examples/bracket.p21";

Inputs shop() {
  static const Inputs kShop = [] {
    Job job;
    return load_shop({}, job).value();
  }();
  return kShop;
}

model::Plan part() {
  Job job;
  return read_plan(testing::slurp(kBracket), "bracket.p21", job).value();
}

model::Plan bound(const Inputs& in, Job& job) { return bind(part(), in, {}, job).value(); }

std::string name_of(const model::Plan& plan, model::AnyRef feature) {
  const auto* f = plan.model.get<model::ManufacturingFeature>(feature);
  return f == nullptr ? "" : f->its_id.value_or("");
}

const model::Unplanned* unplanned(const model::Plan& plan, const std::string& name) {
  for (const auto& u : plan.unplanned) {
    if (name_of(plan, u.feature) == name) return &u;
  }
  return nullptr;
}

const model::StepResult* step(const model::Plan& plan, const std::string& name) {
  for (const auto& s : plan.steps) {
    if (model::step_id(plan, s) == name) return &s;
  }
  return nullptr;
}

bool has_steps(const model::Plan& plan, const std::string& feature) {
  return std::any_of(plan.steps.begin(), plan.steps.end(), [&](const auto& s) {
    const auto* ws = plan.model.get<model::MachiningWorkingstep>(s.step);
    return ws != nullptr && name_of(plan, ws->its_feature) == feature;
  });
}

/// Neither result, nor workplan, nor feature holds a step of what is not planned.
void expect_whole_or_not_at_all(const model::Plan& plan) {
  std::set<model::AnyRef> out;
  for (const auto& u : plan.unplanned) {
    out.insert(u.feature);
    EXPECT_TRUE(plan.model.at<model::ManufacturingFeature>(u.feature).its_operations.items.empty())
        << name_of(plan, u.feature);
  }
  const auto of_step = [&](model::AnyRef s) {
    const auto* ws = plan.model.get<model::MachiningWorkingstep>(s);
    return ws == nullptr ? model::AnyRef{} : model::AnyRef(ws->its_feature);
  };
  for (const auto& s : plan.steps) EXPECT_FALSE(out.contains(of_step(s.step))) << model::step_id(plan, s);
  for (const auto w : plan.model.all(model::TypeId::kWorkplan)) {
    for (const auto e : plan.model.at<model::Workplan>(model::Ref<model::Workplan>(w)).its_elements.items)
      EXPECT_FALSE(out.contains(of_step(e)));
  }
}

std::size_t errors(const std::vector<model::Finding>& findings) {
  return static_cast<std::size_t>(std::count_if(
      findings.begin(), findings.end(), [](const auto& f) { return f.severity == Severity::kError; }));
}

Inputs without_the_core_drill() {
  Inputs in = shop();
  std::erase_if(in.library, [](const model::Cutter& c) {
    return c.cutter_class == CutterClass::kTwistDrill && c.cutting_diameter_mm > 4.8 &&
           c.cutting_diameter_mm < 5.2;
  });
  return in;
}

TEST(Whole, AThreadIsNotTappedWhenItsCoreHoleIsNotPlanned) {
  Job job;
  const model::Plan plan = bound(without_the_core_drill(), job);
  const auto* core = unplanned(plan, "M6 CORE");
  const auto* thread = unplanned(plan, "M6");
  ASSERT_TRUE(core != nullptr && thread != nullptr);
  EXPECT_EQ(core->needed_by, std::vector<std::string>{"M6"});
  EXPECT_NE(thread->reason.find("rests on 'M6 CORE'"), std::string::npos) << thread->reason;
  EXPECT_FALSE(has_steps(plan, "M6"));
  EXPECT_TRUE(has_steps(plan, "POCKET"));
  expect_whole_or_not_at_all(plan);
}

TEST(Whole, ATapOfTheFileIsNotCutWhenTheDrillBeforeItHasNoCutter) {
  Job job;
  const auto open = bind(part(), shop(), {.reopen = Reopen::kNothing, .bind = Bind::kStrategy}, job);
  const auto text = write_plan(open.value(), Format::kIso14649, job);
  auto read = read_plan(text.value(), "open.p21", job);
  const auto plan = bind(read.value(), without_the_core_drill(), {}, job);
  ASSERT_TRUE(plan);
  EXPECT_FALSE(has_steps(*plan, "M6"));
  const auto* thread = unplanned(*plan, "M6");
  ASSERT_NE(thread, nullptr);
  EXPECT_NE(thread->reason.find("needs"), std::string::npos) << thread->reason;
}

TEST(Whole, AFeatureIsNotFinishedWhenItsRoughingHasNoPath) {
  // No cut is so thin that this spindle turns it: nothing is tried along a path.
  Inputs in = shop();
  for (auto& point : in.machine.spindle.curve) {
    point.power_w *= 1e-5;
    point.torque_nm *= 1e-5;
  }
  Job job;
  const auto plan = bind(part(), in, {}, job);
  ASSERT_TRUE(plan);
  EXPECT_FALSE(plan->unplanned.empty());
  expect_whole_or_not_at_all(*plan);
  for (const auto& d : job.diagnostics()) EXPECT_NE(d.code, "PIP-NO-PATH") << d.message;
}

// A hole, too: its spot drill would be as deep in the solid as the face and the spot together.
TEST(Whole, WhatLiesInAFaceThatIsNotPlannedIsLeftOut) {
  const std::filesystem::path dir = std::filesystem::path(capstan::testing::scratch_file("no_face_rows"));
  std::filesystem::create_directories(dir);
  std::ofstream(dir / "face.yaml") << "table: face\nrows:\n  - id: shop.no_face\n    priority: 0\n"
                                      "    when: {}\n    cannot: \"no faces here\"\n    source: \"test\"\n";
  Inputs in = shop();
  Job job;
  auto rules = rules::load_rules(dir.string(), job);
  ASSERT_TRUE(rules) << rules.error().message;
  in.rules = *std::move(rules);
  const model::Plan plan = bound(in, job);
  const model::Unplanned* face = nullptr;
  for (const auto& u : plan.unplanned) {
    if (plan.model.holds<model::PlanarFace>(u.feature)) face = &u;
  }
  ASSERT_NE(face, nullptr);
  const auto needs = [&](const char* name) {
    return std::find(face->needed_by.begin(), face->needed_by.end(), name) != face->needed_by.end();
  };
  EXPECT_TRUE(needs("POCKET"));
  EXPECT_TRUE(needs("DOWEL HOLE 1"));
  EXPECT_FALSE(has_steps(plan, "POCKET"));
  EXPECT_FALSE(has_steps(plan, "DOWEL HOLE 1"));
  expect_whole_or_not_at_all(plan);
}

TEST(Whole, ACounterboreIsMilledBeforeTheHoleInItIsReamed) {
  // The cap screw hole's through hole as a fit, 8 H7: drilled, and reamed when the counterbore is
  // made.
  std::string text = testing::slurp(kBracket);
  const std::string was = "#140=TOLERANCED_LENGTH_MEASURE(6.6,#55);";
  ASSERT_NE(text.find(was), std::string::npos);
  text.replace(text.find(was), was.size(), "#140=TOLERANCED_LENGTH_MEASURE(8.,#95);");
  Job job;
  const model::Plan plan = bind(read_plan(text, "fit.p21", job).value(), shop(), {}, job).value();
  std::vector<model::TypeId> operations;
  for (const auto& s : plan.steps) {
    const auto* ws = plan.model.get<model::MachiningWorkingstep>(s.step);
    if (ws != nullptr && name_of(plan, ws->its_feature) == "CAP SCREW HOLE")
      operations.push_back(ws->its_operation.type);
  }
  ASSERT_GE(operations.size(), 3U);  // drilled, milled, reamed
  EXPECT_EQ(operations.back(), model::TypeId::kReaming);
  const bool mills = std::any_of(operations.begin(), operations.end(), [](model::TypeId t) {
    return model::is_a(t, model::TypeId::kMillingTypeOperation);
  });
  EXPECT_TRUE(mills);
  for (const auto& f : verify::check_plan(plan, job)) EXPECT_NE(f.severity, Severity::kError) << f.message;
}

TEST(Anew, ASmallRouterKeepsItsTorqueWithThinnerCuts) {
  Inputs in = shop();
  Job job;
  in.machine = tooling::load_machine("small_router", job).value();
  const auto checked = bind_checked(part(), in, {}, job);
  ASSERT_TRUE(checked);
  EXPECT_EQ(errors(checked->findings), 0U) << checked->findings.front().message;
  for (const auto& d : job.diagnostics()) EXPECT_NE(d.code, "PIP-EXCESS") << d.message;
  for (const auto& s : checked->plan.steps)
    EXPECT_TRUE(s.exceeded.empty()) << model::step_id(checked->plan, s);
  // 1500 W at 24000 1/min: 0.597 Nm at most, and no thread but by a plan that keeps it.
  for (const auto& s : checked->plan.steps)
    EXPECT_LE(s.loads.torque_nm, 0.597) << model::step_id(checked->plan, s);
  EXPECT_TRUE(has_steps(checked->plan, "SLOT"));
}

/// The cutter's holder is as wide as a plate and begins 5 mm above its tip: planning without workholding does
/// not look at holders, the check does.
void widen(model::Cutter& c) {
  c.stick_out_mm = 5.0;
  c.holder.clear();
  c.holder_diameter_mm = 120.0;
}

TEST(Anew, TheNextCutterMakesWhatTheCheckCondemned) {
  Job job;
  const model::Plan plain = bound(shop(), job);
  const std::string was = step(plain, "POCKET area_rough")->cutter_id;
  Inputs in = shop();
  for (auto& c : in.library) {
    if (c.id == was) widen(c);
  }
  Job condemned;
  ASSERT_GT(errors(verify::check_plan(bound(in, condemned), condemned)), 0U);
  Job told;
  const auto checked = bind_checked(part(), in, {}, told);
  ASSERT_TRUE(checked);
  EXPECT_EQ(errors(checked->findings), 0U);
  EXPECT_GT(checked->replanned, 0);
  EXPECT_LE(checked->replanned, kMostReplannings);
  EXPECT_TRUE(checked->plan.unplanned.empty());
  const auto* now = step(checked->plan, "POCKET area_rough");
  ASSERT_NE(now, nullptr);
  EXPECT_NE(now->cutter_id, was);
  const bool noted = std::any_of(told.diagnostics().begin(), told.diagnostics().end(), [&](const auto& d) {
    return d.code == "PIP-ANEW" && d.message.find("POCKET area_rough") != std::string::npos &&
           d.message.find(was) != std::string::npos && d.message.find("the check found") != std::string::npos;
  });
  EXPECT_TRUE(noted);
  // explain tells it: the cutter stands among the rejected alternatives with what the check found.
  const auto& ws = checked->plan.model.at<model::MachiningWorkingstep>(now->step);
  const auto* d = checked->plan.ledger.find(ws.its_operation, "its_tool");
  ASSERT_NE(d, nullptr);
  EXPECT_TRUE(std::any_of(d->rejected.begin(), d->rejected.end(), [&](const auto& r) {
    return r.what == was && r.why.find("the check found") != std::string::npos;
  }));
}

TEST(Anew, WhatWasSaidOfTheFileStaysWhenAnotherTryIsTaken) {
  Job job;
  const std::string was = step(bound(shop(), job), "POCKET area_rough")->cutter_id;
  Inputs in = shop();
  for (auto& c : in.library) {
    if (c.id == was) widen(c);
  }
  Job told;
  told.warn("FILE-SAYS", "read before planning");
  const auto checked = bind_checked(part(), in, {}, told);
  ASSERT_TRUE(checked);
  ASSERT_GT(checked->replanned, 0);
  ASSERT_FALSE(told.diagnostics().empty());
  EXPECT_EQ(told.diagnostics().front().code, "FILE-SAYS");
}

TEST(Anew, WhatNoCutterMakesWithoutAnErrorIsLeftOutAfterABoundedNumberOfTries) {
  Inputs in = shop();
  for (auto& c : in.library) {
    if (c.cutter_class == CutterClass::kEndmill || c.cutter_class == CutterClass::kBullnoseEndmill) widen(c);
  }
  Job job;
  const auto checked = bind_checked(part(), in, {}, job);
  ASSERT_TRUE(checked);
  EXPECT_EQ(errors(checked->findings), 0U);
  EXPECT_LE(checked->replanned, kMostReplannings);
  const auto* pocket = unplanned(checked->plan, "POCKET");
  ASSERT_NE(pocket, nullptr);
  EXPECT_NE(pocket->reason.find("the check found"), std::string::npos) << pocket->reason;
  expect_whole_or_not_at_all(checked->plan);
}

TEST(Anew, ACleanPlanIsTheFirstOne) {
  Job job;
  const auto checked = bind_checked(part(), shop(), {}, job);
  ASSERT_TRUE(checked);
  EXPECT_EQ(checked->replanned, 0);
  EXPECT_EQ(errors(checked->findings), 0U);
  for (const auto& d : job.diagnostics()) EXPECT_NE(d.code, "PIP-ANEW") << d.message;
}

/// How often features are proposed: at each try once.
struct Tried {
  Checked checked;
  int times = 0;
};
Tried tried(const testing::Plate& plate, double travel_x_mm) {
  Inputs in = shop();
  in.machine.axes[0].travel_min_mm = 0.0;
  in.machine.axes[0].travel_max_mm = travel_x_mm;
  Job job;
  int times = 0;
  job.set_progress([&](std::string_view stage, double done) { times += stage == "propose" && done == 0.0; });
  auto checked = bind_checked(read_plan(plate.text, "plate.p21", job).value(), in, {}, job).value();
  return {std::move(checked), times};
}
bool spans_too_much(const Checked& c) {
  return std::any_of(c.findings.begin(), c.findings.end(),
                     [](const model::Finding& f) { return f.code == "CHK-TRAVEL-X"; });
}

// Holes in a row of which any two neighbours lie farther apart than X travels, by three or more of them.
TEST(Anew, FeaturesFartherApartThanAnAxisTravelsArePlannedOnce) {
  const auto plate = testing::plate_of_holes(9);
  const auto roomy = tried(plate, 500.0);
  ASSERT_FALSE(spans_too_much(roomy.checked));
  const auto short_of_it = tried(plate, 5.0);
  EXPECT_TRUE(spans_too_much(short_of_it.checked));
  EXPECT_EQ(short_of_it.times, roomy.times);
  EXPECT_EQ(short_of_it.checked.replanned, 0);
}

// Without one of two holes the other is within the travel of any machine.
TEST(Anew, OneFeatureBeyondTheTravelIsStillTriedInOtherWays) {
  const auto plate = testing::plate_of_holes(2);
  const auto roomy = tried(plate, 500.0), short_of_it = tried(plate, 5.0);
  ASSERT_FALSE(spans_too_much(roomy.checked));
  EXPECT_GT(short_of_it.times, roomy.times);
}

TEST(Sections, NoSectionIsWiderThanTheCutterAndWhatIsMoreIsCutByTheEnd) {
  // 25 mm cutter, 1 mm down over 20 mm: the end removes pi 12.5^2 / sqrt(401) = 24.51 mm2 per mm of way, and
  // where it first touches the flank has 0.03 mm: at most 25 x 0.03 mm2 of that is the flank's.
  model::CutterPath path;
  path.start({0, 0, 0});
  path.line({20, 0, -1}, model::MoveRole::kRamp);
  path.line({40, 0, -1}, model::MoveRole::kCut);
  model::Cutter cutter;
  cutter.cutting_diameter_mm = 25.0;
  engagement::Measurement m;
  for (const std::uint32_t move : {1U, 2U}) {
    m.engagement.push_back({.ap_mm = 0.03,
                            .ae_mm = 25.0,
                            .exit_rad = std::numbers::pi,
                            .csa_mm2 = 24.51,
                            .removed_mm3 = 24.51,
                            .step_mm = 1.0});
    m.sections.move.push_back(move);
    m.sections.at_mm.push_back(1.0);
    m.sections.ad_max_mm.push_back(0.03);
    m.sections.rd_max_mm.push_back(25.0);
    m.sections.x_max_ofs_mm.push_back(0.0);
    m.sections.y_max_ofs_mm.push_back(0.015);
    m.sections.csa_mm2.push_back(24.51);
    m.sections.x_cg_ofs_mm.push_back(0.0);
    m.sections.y_cg_ofs_mm.push_back(0.015);
    m.sections.removed_mm3.push_back(24.51);
  }
  const auto samples = step::samples_of(m, path, cutter);
  ASSERT_EQ(samples.size(), 2U);
  EXPECT_NEAR(samples[0].ae_mm, 25.0, 1e-9);
  EXPECT_EQ(samples[0].ap_mm, 0.03);
  EXPECT_EQ(samples[0].csa_mm2, 24.51) << "what is removed stays what was measured";
  EXPECT_NEAR(samples[0].end_mm2, 24.51 - 25.0 * 0.03, 1e-12);
  EXPECT_NEAR(samples[0].end_slope, 1.0 / std::sqrt(401.0), 1e-12);
  // A level way has no end cut: what is more than was seen is deeper.
  EXPECT_NEAR(samples[1].ae_mm, 25.0, 1e-9);
  EXPECT_EQ(samples[1].end_mm2, 0.0);
  EXPECT_NEAR(samples[1].ap_mm, 24.51 / 25.0, 1e-12);
}

TEST(Sections, AHelixsFirstContactIsNotFedSlowerThanItsNextTurn) {
  // Reference pocket in C45: the first arcs of the helix, where the area is the end's and the depth nothing,
  // crawled at a tenth of what the rest of the helix is fed, and their chips read ten times the feed.
  Job job;
  auto inputs = shop();
  inputs.material_name = "C45";
  const std::string text = testing::slurp(capstan::testing::source_dir() + "/examples/reference_pocket.p21");
  const auto plan = bind(read_plan(text, "reference_pocket.p21", job).value(), inputs, {}, job);
  ASSERT_TRUE(plan) << plan.error().message;
  const auto& step = plan->steps.front();
  double least = 1e9, most = 0.0;
  for (std::size_t i = 1; i < step.path->size(); ++i) {
    if (step.path->role[i] != model::MoveRole::kRamp) continue;
    least = std::min(least, step.schedule->feed_mm_min[i]);
    most = std::max(most, step.schedule->feed_mm_min[i]);
  }
  ASSERT_GT(most, 0.0);
  // The end cut of the 5 degree helix of 10 mm takes as much as a slot half a millimetre deep, which a cut of
  // 1.4 mm at full width bears: nothing is to slow it below half of the steady helix.
  EXPECT_GT(least, 0.5 * most);
  // Nowhere is a chip thicker than the start value of the generic mills in steel, 0.005 of 10 mm, to which
  // lighter places are fed, but for the outer edge in a corner.
  EXPECT_LT(step.loads.chip_thickness_mm, 1.3 * std::max(step.fz_mm, 0.005 * 10.0));
}

}  // namespace
}  // namespace capstan::pipeline
