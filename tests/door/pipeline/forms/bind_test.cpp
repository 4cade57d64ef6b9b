#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstring>
#include <memory>
#include <set>
#include <string>

#include "casebase/casebase.h"
#include "planner/model/nouns/all.h"
#include "tests/support/corpus.h"
#include "tests/support/shop.h"
#include "tests/support/witness.h"

namespace capstan::pipeline {
namespace {

const std::string kExamples = capstan::testing::source_dir() + "/examples/";

Inputs shop() {
  static const Inputs kShop = [] {
    Job job;
    auto in = load_shop({}, job);
    return in ? *std::move(in) : Inputs{};
  }();
  return kShop;
}

model::Plan part(const std::string& name) {
  Job job;
  auto plan = read_plan(testing::slurp(kExamples + name), name, job);
  EXPECT_TRUE(plan) << (plan ? "" : to_text(plan.error()));
  return plan ? *std::move(plan) : model::Plan{};
}

model::Plan bound(model::Plan plan, const Inputs& in, const Policy& policy = {}) {
  Job job;
  auto out = bind(std::move(plan), in, policy, job);
  EXPECT_TRUE(out) << (out ? "" : to_text(out.error()));
  return out ? *std::move(out) : model::Plan{};
}

const model::StepResult* step(const model::Plan& plan, const std::string& name) {
  for (const auto& s : plan.steps) {
    if (model::step_id(plan, s) == name) return &s;
  }
  return nullptr;
}

/// What the sections of a step took.
double removed_mm3(const model::StepResult& s) {
  double out = 0.0;
  for (const double one : s.sections->removed_mm3) out += one;
  return out;
}

TEST(Bind, PlansTheBracketWholeAndSafe) {
  const model::Plan plan = bound(part("bracket.p21"), shop());
  EXPECT_TRUE(plan.unplanned.empty());
  std::set<model::AnyRef> made;
  for (const auto& s : plan.steps)
    made.insert(plan.model.at<model::MachiningWorkingstep>(s.step).its_feature);
  const std::set<model::AnyRef> parts = model::parts_of_others(plan.model);
  std::size_t features = 0;
  for (const auto f : plan.model.all_below(model::TypeId::kManufacturingFeature)) {
    if (parts.contains(f)) continue;
    ++features;
    EXPECT_TRUE(made.contains(f)) << plan.model.at<model::ManufacturingFeature>(f).its_id.value_or("");
  }
  EXPECT_EQ(features, 9U);  // of the file
  Job job;
  for (const auto& f : findings_of(plan, job))
    EXPECT_EQ(f.severity, Severity::kNote) << f.code << " " << f.message;
  for (const auto& s : plan.steps) {
    EXPECT_TRUE(s.path && s.schedule && s.sections) << model::step_id(plan, s);
    EXPECT_GT(s.cutting_s, 0.0);
    EXPECT_NE(model::find_cutter(plan, s.cutter_id), nullptr);
  }
}

/// A part planned and checked on so many threads: all forms, all findings of the plan and of its program, all
/// that was reported. `workers` are the threads that helped.
std::string made_on(const std::string& name, const Inputs& in, unsigned threads, std::size_t& workers) {
  testing::Witness witness(threads > 1);
  Job job;
  job.threads = threads;
  job.set_deadline(std::chrono::steady_clock::now() + std::chrono::hours(1));  // so that the clock is read
  job.set_clock([&witness] { return witness.read(); });
  const auto made = bind_checked(part(name), in, {}, job);
  EXPECT_TRUE(made) << (made ? "" : to_text(made.error()));
  if (!made) return {};
  std::string out;
  for (const Format f :
       {Format::kIso14649, Format::kAp238, Format::kJson, Format::kLinuxCnc, Format::kToolTable}) {
    auto text = write_plan(made->plan, f, job);
    EXPECT_TRUE(text) << (text ? "" : to_text(text.error()));
    out += text ? *text : "";
  }
  for (const model::Finding& f : findings_of(*made, job))
    out += f.code + " " + f.step + " " + std::to_string(f.move) + " " + f.message + "\n";
  for (const Diagnostic& d : job.diagnostics()) out += to_text(d) + "\n";
  workers = witness.helpers();
  return out;
}

// Of planning only paths over surfaces are made on several threads; for files and checks see
// tests/door/service/threads_test.cpp.
TEST(Bind, GivesTheSameBytesOnOneTwoAndEightThreads) {
  Inputs in = shop();
  in.material_name = "EN AW-6061";
  std::size_t alone = 0;
  const std::string one = made_on("surface.stl", in, 1, alone);
  EXPECT_EQ(alone, 0U) << "one thread is the planner's own";
  ASSERT_FALSE(one.empty());
  for (const unsigned threads : {2U, 8U}) {
    std::size_t together = 0;
    const std::string many = made_on("surface.stl", in, threads, together);
    EXPECT_GE(together, 1U);
    EXPECT_TRUE(one == many) << "on " << threads;
  }
}

TEST(Bind, BindsEveryToolAndFeedWithAReason) {
  const model::Plan plan = bound(part("bracket.p21"), shop());
  for (const auto& s : plan.steps) {
    const auto& ws = plan.model.at<model::MachiningWorkingstep>(s.step);
    const auto& op = plan.model.at<model::MachiningOperation>(ws.its_operation);
    for (const auto& [object, attribute] : {std::pair<model::AnyRef, const char*>{s.step, "its_operation"},
                                            {ws.its_operation, "its_tool"},
                                            {op.its_technology, "feedrate"},
                                            {op.its_technology, "spindle"}}) {
      const auto* d = plan.ledger.find(object, attribute);
      ASSERT_NE(d, nullptr) << model::step_id(plan, s) << " " << attribute;
      EXPECT_EQ(d->state, model::DecisionState::kBound);
      EXPECT_FALSE(plan.ledger.reason(d->reason).text.empty());
      EXPECT_FALSE(plan.ledger.reason(d->reason).source.empty());
    }
  }
}

TEST(Bind, ClosesInASecondRunWhatAFirstLeftOpen) {
  const Inputs in = shop();
  const model::Plan open =
      bound(part("bracket.p21"), in, {.reopen = Reopen::kNothing, .bind = Bind::kStrategy});
  EXPECT_TRUE(open.steps.empty());
  Job job;
  const auto text = write_plan(open, Format::kIso14649, job);
  ASSERT_TRUE(text);
  auto read = read_plan(*text, "open.p21", job);
  ASSERT_TRUE(read);
  const model::Plan closed = bound(*std::move(read), in);
  EXPECT_TRUE(closed.unplanned.empty()) << closed.unplanned.front().reason;
  EXPECT_EQ(closed.steps.size(), bound(part("bracket.p21"), in).steps.size());
  const auto findings = findings_of(closed, job);
  EXPECT_TRUE(std::none_of(findings.begin(), findings.end(),
                           [](const auto& f) { return f.severity == Severity::kError; }));
}

TEST(Bind, StartsFromTheNearestCaseWithinLimits) {
  const testing::ScratchFolder folder;
  Inputs in = shop();
  const model::Plan plain = bound(part("plate_bound.p21"), in);
  // Every drilling step again as a good case, cut at nine tenths of the speed.
  std::vector<casebase::Case> cases;
  for (const auto& s : plain.steps) {
    auto c = casebase::case_of(plain, s);
    if (!c || c->asked.operation != "DRILLING") continue;
    c->bound.vc_m_min *= 0.9;
    c->observed.verdict = casebase::Verdict::kGood;
    c->origin = casebase::Origin::kMeasured;
    c->from.source = "test";
    cases.push_back(*std::move(c));
  }
  ASSERT_FALSE(cases.empty());
  Job job;
  auto base = casebase::CaseBase::open_or_create(folder.file("cases.db"), job);
  ASSERT_TRUE(base);
  ASSERT_TRUE(base->add(cases));
  in.cases = std::make_shared<const casebase::CaseBase>(*std::move(base));
  const model::Plan tuned = bound(part("plate_bound.p21"), in);
  std::size_t from_case = 0;
  for (const auto& s : tuned.steps) {
    const auto* op = tuned.model.get<model::MachiningOperation>(
        tuned.model.at<model::MachiningWorkingstep>(s.step).its_operation);
    const auto* d = tuned.ledger.find(op->its_technology, "spindle");
    if (d == nullptr || d->binder != model::Binder::kCase) continue;
    ++from_case;
    const auto* before = step(plain, model::step_id(tuned, s));
    ASSERT_NE(before, nullptr);
    EXPECT_LT(std::abs(s.spindle_rpm), std::abs(before->spindle_rpm));
  }
  EXPECT_GT(from_case, 0U);
}

TEST(Bind, SaysWhyAFeatureIsNotPlanned) {
  Inputs in = shop();
  std::erase_if(in.library, [](const model::Cutter& c) {
    return c.cutter_class == model::CutterClass::kTap || c.cutter_class == model::CutterClass::kThreadMill;
  });
  Job job;
  const auto plan = bind(part("bracket.p21"), in, {}, job);
  ASSERT_TRUE(plan);
  ASSERT_FALSE(plan->unplanned.empty());
  EXPECT_NE(plan->unplanned.front().reason.find("tap"), std::string::npos) << plan->unplanned.front().reason;
}

TEST(Bind, RefusesByNameWhatItDoesNotPlan) {
  model::Plan plan = part("bracket.p21");
  model::Model& m = plan.model;
  const auto kept = [&](const char* keyword, const char* text) {
    model::KeptInstance k;
    k.keyword = keyword;
    k.pieces.emplace_back(text);
    return m.add(std::move(k));
  };
  model::MachiningWorkingstep turned;
  turned.its_id = "turned";
  turned.its_operation.type = model::TypeId::kKeptInstance;
  turned.its_operation.index =
      kept("FACING_TURNING_OPERATION", "FACING_TURNING_OPERATION('','roughing','','')").index;
  auto& workplan = m.at<model::Workplan>(m.at<model::Project>(plan.project).main_workplan);
  workplan.its_elements.items.push_back(m.add(std::move(turned)));
  workplan.its_elements.items.push_back(kept("TURNING_WORKINGSTEP", "TURNING_WORKINGSTEP('t',$,(),$)"));
  workplan.its_elements.items.push_back(kept("VENDOR_STEP", "VENDOR_STEP()"));
  model::MachiningWorkingstep extended;
  extended.its_operation = m.add<model::ExtendedOperation>();
  m.at<model::Workplan>(m.at<model::Project>(plan.project).main_workplan)
      .its_elements.items.push_back(m.add(std::move(extended)));
  const model::Plan out = bound(std::move(plan), shop());
  std::vector<std::string> reasons;
  for (const auto& u : out.unplanned) reasons.push_back(u.reason);
  ASSERT_EQ(reasons.size(), 4U);
  EXPECT_NE(reasons[0].find("is turning (FACING_TURNING_OPERATION)"), std::string::npos) << reasons[0];
  EXPECT_NE(reasons[1].find("is turning (TURNING_WORKINGSTEP)"), std::string::npos) << reasons[1];
  EXPECT_NE(reasons[2].find("has VENDOR_STEP, which is not understood"), std::string::npos) << reasons[2];
  EXPECT_NE(reasons[3].find("has EXTENDED_OPERATION"), std::string::npos) << reasons[3];
}

TEST(Bind, FinishesASurfaceWithinItsTolerance) {
  Inputs in = shop();
  in.material_name = "EN AW-6061";
  const model::Plan plan = bound(part("surface.stl"), in);
  EXPECT_TRUE(plan.unplanned.empty());
  ASSERT_EQ(plan.steps.size(), 3U) << "roughed, evened out, finished";
  Job job;
  for (const auto& f : findings_of(plan, job))
    EXPECT_EQ(f.severity, Severity::kNote) << f.code << " " << f.message;
}

TEST(Bind, ASurfaceThatIsRoughedOnlyIsFoundToStandTooHigh) {
  // What lacks its finish keeps terraces and half a millimetre on them.
  Inputs in = shop();
  in.material_name = "EN AW-6061";
  model::Plan plan = bound(part("surface.stl"), in);
  ASSERT_EQ(plan.steps.size(), 3U);
  plan.steps.erase(plan.steps.begin() + 1, plan.steps.end());
  Job job;
  const auto findings = findings_of(plan, job);
  EXPECT_TRUE(std::any_of(findings.begin(), findings.end(), [](const model::Finding& f) {
    return f.code == "CHK-LEFT" && f.severity == Severity::kError &&
           f.message.find("square to the surface, still stand") != std::string::npos;
  }));
}

// Roughing leaves terraces, and a finishing ball that meets them cuts a slot of their height, millimetres
// deep. Evened out before, it meets square to the surface 0.2 mm, ridges and chords of 0.05 mm each, and what
// a ball of 20 mm leaves in a crease of 20 degrees (sharper ones are corners), 10 mm (1 / cos 10 deg - 1) =
// 0.15 mm. The widest cut of that depth h = 0.45 mm is the first pass along the border, half a segment of the
// ball: 2/3 h sqrt(2 R h) = 0.9 mm2 for 20 mm.
TEST(Bind, FinishesASurfaceThroughThinStock) {
  Inputs in = shop();
  in.material_name = "EN AW-6061";
  Job job;
  const auto made = bind(part("surface.stl"), in, {}, job);
  ASSERT_TRUE(made) << (made ? "" : to_text(made.error()));
  const model::Plan& plan = *made;
  ASSERT_EQ(plan.steps.size(), 3U);
  EXPECT_LT(removed_mm3(plan.steps[1]), 0.1 * removed_mm3(plan.steps[0])) << "7.5 mm are roughed to 0.9";
  const auto said = job.diagnostics();
  EXPECT_TRUE(std::none_of(said.begin(), said.end(), [](const Diagnostic& d) {
    return d.code == "PIP-BITE";
  })) << "no step bites deeper than twice what it was left";
  const auto& s = *plan.steps.back().sections;
  ASSERT_FALSE(s.csa_mm2.empty());
  EXPECT_LT(*std::max_element(s.csa_mm2.begin(), s.csa_mm2.end()), 1.0);
}

// The finish was asked for as if it cut the part's height of 22.9 mm at once, and might go no faster
// afterwards: 0.025 mm per tooth in steel, half its start value, at the speed of the ball's full diameter: 94
// mm/min for 44 minutes. What it cuts is less than 1 mm2 (above).
TEST(Bind, FeedsASurfacesFinishByWhatItCutsThere) {
  Inputs in = shop();
  in.material_name = "C45";
  const model::Plan plan = bound(part("surface.stl"), in);
  // A rough, what brings its rest down to what a finish bears, and a finish.
  ASSERT_GE(plan.steps.size(), 3U);
  for (std::size_t i = 1; i < plan.steps.size(); ++i) {
    // The stair that a level of the roughing leaves, and its allowance, below 1 mm.
    EXPECT_LT(plan.steps[i].axial_depth_mm, plan.steps.front().axial_depth_mm + 1.0)
        << "no cut of the part's height";
  }
  const model::StepResult& last = plan.steps.back();
  double way = 0.0, minutes = 0.0;
  for (std::size_t i = 1; i < last.path->size(); ++i) {
    if (last.path->role[i] != model::MoveRole::kCut) continue;
    way += model::move_length(*last.path, i);
    minutes += model::move_length(*last.path, i) / last.schedule->feed_mm_min[i];
  }
  const model::Cutter* ball = model::find_cutter(plan, last.cutter_id);
  ASSERT_NE(ball, nullptr);
  // Start value of the generic balls in steel: 0.005 of the diameter.
  const double at_start = 0.005 * ball->cutting_diameter_mm * ball->teeth * std::abs(last.spindle_rpm);
  // The heavier places bend it as far as they may; on the whole it goes near its start value.
  EXPECT_GT(way / minutes, 0.8 * at_start);
  EXPECT_LT(last.loads.chip_thickness_mm, 1.02 * 0.005 * ball->cutting_diameter_mm)
      << "and no chip is thicker";
  // It touches with less than its full diameter: the table's 132.6 m/min (78 of the card, 1.7 for the
  // coating) are those of where it cuts.
  const double at_rim = 3.14159 * ball->cutting_diameter_mm * std::abs(last.spindle_rpm) / 1000.0;
  EXPECT_GT(at_rim, 1.1 * 132.6);
  EXPECT_LT(at_rim, 2.0 * 132.6);
}

/// Hills and pits of 4 mm on 60 x 60 mm, as an ASCII STL sheet.
std::string waves_stl() {
  constexpr int kN = 40;
  constexpr double kSize = 60.0;
  const auto point = [](int i, int j) {
    const double x = kSize * i / kN, y = kSize * j / kN;
    const double z = -6.0 + 4.0 * std::sin(0.16 * x) * std::cos(0.13 * y);
    return "vertex " + std::to_string(x) + " " + std::to_string(y) + " " + std::to_string(z) + "\n";
  };
  std::string out = "solid waves\n";
  const auto facet = [&](const std::string& a, const std::string& b, const std::string& c) {
    out += "facet normal 0 0 1\nouter loop\n" + a + b + c + "endloop\nendfacet\n";
  };
  for (int j = 0; j < kN; ++j) {
    for (int i = 0; i < kN; ++i) {
      facet(point(i, j), point(i + 1, j), point(i + 1, j + 1));
      facet(point(i, j), point(i + 1, j + 1), point(i, j + 1));
    }
  }
  return out + "endsolid waves\n";
}

/// The waves in EN AW-6061, planned once for the tests below, which only look at the plan.
struct PlannedWaves {
  Inputs in = shop();
  Result<model::Plan> plan = model::Plan();
  std::vector<Diagnostic> said;
};
const PlannedWaves& planned_waves() {
  static const PlannedWaves made = [] {
    PlannedWaves out;
    out.in.material_name = "EN AW-6061";
    Job job;
    out.plan = read_plan(waves_stl(), "waves.stl", job);
    if (out.plan) out.plan = bind(*std::move(out.plan), out.in, {}, job);
    out.said = job.diagnostics();
    return out;
  }();
  return made;
}

// The widest mill ranked first. On the waves its only level was the height of the lowest place that it could
// be let down to: one plunge took 1 of 40 cm3, and the ball after it all the rest, 7.7 mm deep. Of the pits,
// which a mill of some width does not reach, a narrower one takes what the next step would bite too deep
// into.
TEST(Bind, RoughsASurfaceAndThenItsPitsBeforeItIsEvenedOut) {
  const Result<model::Plan>& plan = planned_waves().plan;
  const std::vector<Diagnostic>& said = planned_waves().said;
  ASSERT_TRUE(plan) << (plan ? "" : to_text(plan.error()));
  ASSERT_EQ(plan->steps.size(), 4U);
  const auto diameter = [&](std::size_t i) {
    const auto c = std::find_if(plan->cutters.begin(), plan->cutters.end(), [&](const model::Cutter& cutter) {
      return cutter.id == plan->steps[i].cutter_id;
    });
    return c != plan->cutters.end() ? c->cutting_diameter_mm : 0.0;
  };
  EXPECT_LT(diameter(1), diameter(0));
  // Of some 4 mm half a millimetre stays everywhere, and half of 0.7 mm of terraces on the whole.
  const double roughed = removed_mm3(plan->steps[0]) + removed_mm3(plan->steps[1]);
  EXPECT_LT(removed_mm3(plan->steps[2]), 0.25 * roughed);
  EXPECT_TRUE(std::none_of(said.begin(), said.end(), [](const Diagnostic& d) {
    return d.code == "PIP-BITE";
  })) << "the next bites no deeper than twice what is left for it";
}

/// The waves' plan, bound again with the narrower rough's mill for both. `foreign`: nobody says who decided.
Result<model::Plan> roughed_twice(model::Plan plan, bool foreign, const Inputs& in, Job& job) {
  const auto operation = [&](std::size_t i) {
    const auto* ws = plan.model.get<model::MachiningWorkingstep>(plan.steps[i].step);
    return plan.model.get<model::MachiningOperation>(ws->its_operation);
  };
  operation(0)->its_tool = operation(1)->its_tool;
  for (std::size_t i = 0; i < plan.steps.size() && foreign; ++i) operation(i)->its_toolpath = {};
  if (foreign) plan.ledger = {};
  plan.steps.clear();
  return bind(std::move(plan), in, {}, job);
}

// The second rough has nothing or little to do. As a rest it was given up, and with it the surface.
TEST(Bind, KeepsASurfaceWhoseSecondRoughFindsNoRest) {
  const Result<model::Plan>& plan = planned_waves().plan;
  ASSERT_TRUE(plan) << (plan ? "" : to_text(plan.error()));
  ASSERT_EQ(plan->steps.size(), 4U);
  for (const bool foreign : {false, true}) {
    SCOPED_TRACE(foreign ? "a foreign file" : "a plan of ours");
    Job again;
    const auto back = roughed_twice(*plan, foreign, planned_waves().in, again);
    ASSERT_TRUE(back) << (back ? "" : to_text(back.error()));
    for (const Diagnostic& d : again.diagnostics()) EXPECT_NE(d.code, "PIP-NO-PATH") << d.message;
    ASSERT_GE(back->steps.size(), 3U);
    EXPECT_EQ(model::step_id(*back, back->steps.back()), model::step_id(*plan, plan->steps.back()));
  }
}

TEST(Bind, StopsWhenItIsAsked) {
  Job job;
  job.request_stop();
  const auto plan = bind(part("bracket.p21"), shop(), {}, job);
  ASSERT_FALSE(plan);
  EXPECT_EQ(plan.error().code, "PIP-STOPPED");
}

}  // namespace
}  // namespace capstan::pipeline
