#include <gtest/gtest.h>

#include <algorithm>
#include <string>

#include "planner/model/nouns/all.h"
#include "tests/support/corpus.h"
#include "tests/support/shop.h"

// A plan that was written, read and bound again is the plan that it was.

namespace capstan::pipeline {
namespace {

const std::string kExamples = capstan::testing::source_dir() + "/examples/";

Inputs shop() {
  Job job;
  return load_shop({}, job).value();
}

std::string codes(const Job& job) {
  std::string out;
  for (const Diagnostic& d : job.diagnostics()) {
    if (d.code == "EXC-RECORD" || d.code == "EXC-EDITED" || d.code == "EXC-FEED" || d.code == "PIP-CHANGED" ||
        d.severity == Severity::kError)
      out += d.code + " " + d.message + "\n";
  }
  return out;
}

std::string limits(const model::StepResult& s) {
  std::string out;
  for (const auto& a : s.active) out += a.name + " ";
  for (const auto& h : s.held_by) out += h.name + " ";
  return out;
}

void expect_same(const model::StepResult& a, const model::StepResult& b, const std::string& step) {
  SCOPED_TRACE(step);
  // A file's units round: m/s for mm/min, degrees for radians.
  const auto near = [&](double x, double y, const char* what) {
    EXPECT_NEAR(x, y, 1e-9 * (1.0 + std::abs(x))) << what;
  };
  EXPECT_EQ(a.cutter_id, b.cutter_id);
  EXPECT_EQ(a.setup, b.setup);
  near(a.axial_depth_mm, b.axial_depth_mm, "axial depth");
  near(a.radial_depth_mm, b.radial_depth_mm, "radial depth");
  near(a.vc_m_min, b.vc_m_min, "cutting speed");
  near(a.fz_mm, b.fz_mm, "feed per tooth");
  near(a.spindle_rpm, b.spindle_rpm, "spindle");
  near(a.feed_mm_min, b.feed_mm_min, "feed");
  EXPECT_NEAR(a.cutting_s, b.cutting_s, 1e-3) << "a left-handed helix is written as points, within 0.001 mm";
  EXPECT_NEAR(a.rapid_s, b.rapid_s, 1e-3);
  EXPECT_EQ(a.flood, b.flood);
  EXPECT_EQ(limits(a), limits(b));
}

/// Who decided on tool, path, feed and speed of a step.
std::string binders(const model::Plan& plan, const model::StepResult& s) {
  const auto* ws = plan.model.get<model::MachiningWorkingstep>(s.step);
  const auto* op = ws == nullptr ? nullptr : plan.model.get<model::MachiningOperation>(ws->its_operation);
  if (op == nullptr) return "";
  std::string out;
  for (const model::DecisionKey& key : {model::DecisionKey{ws->its_operation, "its_tool"},
                                        model::DecisionKey{ws->its_operation, "its_toolpath"},
                                        model::DecisionKey{op->its_technology, "feedrate"},
                                        model::DecisionKey{op->its_technology, "spindle"}}) {
    const auto* d = plan.ledger.find(key.object, key.attribute);
    out += d == nullptr ? "given " : std::string(to_text(d->binder)) + " ";
  }
  return out;
}

class ComesBack : public ::testing::TestWithParam<const char*> {};

TEST_P(ComesBack, FromPart21AsItWasWritten) {
  const std::string name = GetParam();
  const Inputs in = shop();
  Job first, second;
  auto read = read_plan(testing::slurp(kExamples + name), name, first);
  ASSERT_TRUE(read) << to_text(read.error());
  const auto plan = bind(*std::move(read), in, {}, first);
  ASSERT_TRUE(plan) << to_text(plan.error());
  const auto text = write_plan(*plan, Format::kIso14649, first);
  ASSERT_TRUE(text) << to_text(text.error());
  auto again = read_plan(*text, "plan.p21", second);
  ASSERT_TRUE(again) << to_text(again.error());
  EXPECT_EQ(again->material.id, plan->material.id);
  EXPECT_EQ(again->material.mechanistic.size(), plan->material.mechanistic.size());
  EXPECT_EQ(again->cutters.size(), plan->cutters.size());
  const auto back = bind(*std::move(again), in, {}, second);
  ASSERT_TRUE(back) << to_text(back.error());
  EXPECT_EQ(codes(second), "");
  ASSERT_EQ(back->steps.size(), plan->steps.size());
  for (std::size_t i = 0; i < plan->steps.size(); ++i) {
    EXPECT_EQ(model::step_id(*back, back->steps[i]), model::step_id(*plan, plan->steps[i]));
    EXPECT_EQ(binders(*back, back->steps[i]), binders(*plan, plan->steps[i]));
    expect_same(plan->steps[i], back->steps[i], model::step_id(*plan, plan->steps[i]));
  }
  EXPECT_EQ(back->unplanned.size(), plan->unplanned.size());
  EXPECT_EQ(back->cutters, plan->cutters);
}

INSTANTIATE_TEST_SUITE_P(WrittenPlan, ComesBack,
                         ::testing::Values("bracket.p21", "plate_bound.p21", "reference_pocket.p21",
                                           "two_setups.p21"));

// Neither a thread nor an angle of a tap's, a tool's pocket, nor what a machine must have has a place in
// ISO 14649.
TEST(WrittenPlan, HoldsInItsHeaderWhatTheSchemaCannotHold) {
  const std::string name = "bracket.p21";
  const Inputs in = shop();
  Job job;
  auto read = read_plan(testing::slurp(kExamples + name), name, job);
  const auto plan = bind(*std::move(read), in, {}, job);
  ASSERT_TRUE(plan);
  const auto text = write_plan(*plan, Format::kIso14649, job);
  ASSERT_TRUE(text);
  const auto back = read_plan(*text, "plan.p21", job);
  ASSERT_TRUE(back) << to_text(back.error());
  const auto taps = back->model.all(model::TypeId::kTap);
  ASSERT_EQ(taps.size(), 1u);
  const auto* pitch = back->model.get<model::Tap>(taps.front());
  EXPECT_TRUE(pitch->thread_pitch.has_value()) << "M6";
  EXPECT_NEAR(pitch->thread_pitch.value_or(0.0), 1.0, 1e-12);
  const auto* project = back->model.get<model::Project>(back->project);
  const auto* main = back->model.get<model::Workplan>(project->main_workplan);
  const auto* needs = back->model.get<model::MachineParameters>(main->its_minimum_machine_params);
  ASSERT_NE(needs, nullptr);
  EXPECT_GT(needs->spindle_speed.value_or(0.0), 0.0);
}

// What a step's speed and feed reached on one machine says nothing of another.
TEST(WrittenPlan, TakesNoLimitsFromThePlanOfAnotherMachine) {
  Job job;
  auto read = read_plan(testing::slurp(kExamples + "bracket.p21"), "bracket.p21", job);
  ASSERT_TRUE(read);
  const auto plan = bind(*std::move(read), shop(), {}, job);
  ASSERT_TRUE(plan);
  ASSERT_TRUE(
      std::any_of(plan->steps.begin(), plan->steps.end(), [](const auto& s) { return !s.active.empty(); }));
  Inputs other = shop();
  other.machine.id = "another";
  const auto same = bind(*plan, shop(), {}, job);
  const auto moved = bind(*plan, other, {}, job);
  ASSERT_TRUE(same && moved);
  ASSERT_EQ(same->steps.size(), plan->steps.size());
  for (std::size_t i = 0; i < plan->steps.size(); ++i)
    EXPECT_EQ(limits(same->steps[i]), limits(plan->steps[i])) << i;
  for (const auto& s : moved->steps) EXPECT_TRUE(s.active.empty()) << model::step_id(*moved, s);
}

}  // namespace
}  // namespace capstan::pipeline
