#include <gtest/gtest.h>

#include <functional>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "planner/model/nouns/all.h"
#include "planner/proof/verify/verify.h"
#include "tests/mutation/classes.h"
#include "tests/support/differences/subjects.h"
#include "tests/support/soak.h"

// A check that knows what earlier ones found of steps says what one says that knows nothing, whatever became
// of plan, program or table in between.

namespace capstan::mutation {
namespace {

using testing::subjects;

std::uint64_t next_seed() {
  static std::uint64_t seed =
      1 + 7000 * static_cast<std::uint64_t>(::testing::UnitTest::GetInstance()->random_seed());
  return seed++;
}

constexpr std::size_t kSample = 3;  ///< one class of so many, but where tests soak

std::vector<model::Finding> of_program(const Emitted& e, const Edit& edit, memo::Memo* known) {
  Job job;
  return verify::check_program({e.name, edit.text, edit.table}, &e.plan, e.plan.machine, e.plan.cutters, job,
                               known);
}

TEST(KnownStepsProperty, AProgramThatWasEditedHasTheFindingsOfAWholeCheck) {
  for (const Emitted& e : emitted_and_planned()) {
    memo::Memo known;
    (void)of_program(e, {e.text, e.table}, &known);
    const auto first = known.counts(memo::Stage::kSweep);
    EXPECT_EQ(of_program(e, {e.text, e.table}, &known), of_program(e, {e.text, e.table}, nullptr)) << e.name;
    EXPECT_EQ(known.counts(memo::Stage::kSweep).made, first.made) << e.name << " is swept again";
    const auto unedited = of_program(e, {e.text, e.table}, nullptr);
    std::size_t differ = 0, at = 0;
    for (const Class& c : classes()) {
      Random random(next_seed());
      if (!soaking() && at++ % kSample != 0) continue;
      const auto edit = c.make(e, random);
      if (!edit) continue;
      const auto whole = of_program(e, *edit, nullptr);
      EXPECT_EQ(of_program(e, *edit, &known), whole) << e.name << ", " << c.name;
      differ += whole == unedited ? 0 : 1;
    }
    EXPECT_GT(differ, soaking() ? 20U : 20U / kSample) << e.name;
  }
}

TEST(KnownStepsProperty, AProgramWhosePlanIsKnownHasTheFindingsOfAWholeCheck) {
  std::size_t taken = 0, steps = 0;
  for (const Emitted& e : emitted_and_planned()) {
    Job job;
    memo::Memo known;
    (void)verify::check_plan(e.plan, job, &known);
    const auto planned = known.counts(memo::Stage::kSweep);
    EXPECT_EQ(subjects(of_program(e, {e.text, e.table}, &known)),
              subjects(of_program(e, {e.text, e.table}, nullptr)))
        << e.name;
    steps += planned.made;
    taken += planned.made - (known.counts(memo::Stage::kSweep).made - planned.made);
    std::size_t at = 0;
    for (const Class& c : classes()) {
      Random random(next_seed());
      if (!soaking() && at++ % kSample != 1) continue;
      const auto edit = c.make(e, random);
      if (!edit) continue;
      EXPECT_EQ(subjects(of_program(e, *edit, &known)), subjects(of_program(e, *edit, nullptr)))
          << e.name << ", " << c.name;
    }
  }
  EXPECT_GE(2 * taken, steps) << "of " << steps << " steps that move as planned few are known";
}

/// A change of a plan that may change what the check finds of some of its steps.
struct PlanEdit {
  const char* name;
  std::function<void(model::Plan&, Random&)> make;
};

model::Cutter& a_cutter(model::Plan& plan, Random& r) { return plan.cutters[r.below(plan.cutters.size())]; }
model::StepResult& a_step(model::Plan& plan, Random& r) { return plan.steps[r.below(plan.steps.size())]; }

/// A copy of the step's path, changed.
void path_of(model::StepResult& step, const std::function<void(model::CutterPath&)>& change) {
  if (step.path == nullptr || step.path->size() == 0) return;
  auto path = std::make_shared<model::CutterPath>(*step.path);
  change(*path);
  step.path = std::move(path);
}

const std::vector<PlanEdit>& plan_edits() {
  static const std::vector<PlanEdit> kAll = {
      {"a worn cutter", [](auto& p, auto& r) { a_cutter(p, r).cutting_diameter_mm -= 0.05; }},
      {"a longer cutter", [](auto& p, auto& r) { a_cutter(p, r).functional_length_mm += 3.0; }},
      {"a shorter stick-out", [](auto& p, auto& r) { a_cutter(p, r).stick_out_mm *= r.between(0.2, 0.9); }},
      {"a wide holder", [](auto& p, auto& r) { a_cutter(p, r).holder_diameter_mm += r.between(10.0, 80.0); }},
      {"a thick shank", [](auto& p, auto& r) { a_cutter(p, r).shank_diameter_mm += r.between(1.0, 9.0); }},
      {"short flutes", [](auto& p, auto& r) { a_cutter(p, r).maximum_depth_of_cut_mm *= 0.2; }},
      {"fewer teeth", [](auto& p, auto& r) { a_cutter(p, r).teeth = 1; }},
      {"no centre edge", [](auto& p, auto& r) { a_cutter(p, r).centre_cutting = false; }},
      {"another hand", [](auto& p, auto& r) { a_cutter(p, r).hand = model::Hand::kLeft; }},
      {"another depth", [](auto& p, auto& r) { a_step(p, r).axial_depth_mm *= 0.1; }},
      {"another width", [](auto& p, auto& r) { a_step(p, r).radial_depth_mm *= 0.1; }},
      {"a higher feed",
       [](auto& p, auto& r) {
         auto& s = a_step(p, r);
         if (s.schedule == nullptr) return;
         auto schedule = std::make_shared<model::FeedSchedule>(*s.schedule);
         for (double& f : schedule->feed_mm_min) f *= 4.0;
         s.schedule = std::move(schedule);
       }},
      {"a deeper path",
       [](auto& p, auto& r) {
         path_of(a_step(p, r), [&](model::CutterPath& path) { path.z[r.below(path.size())] -= 1.5; });
       }},
      {"a path aside",
       [](auto& p, auto& r) {
         path_of(a_step(p, r), [&](model::CutterPath& path) { path.x[r.below(path.size())] += 2.0; });
       }},
      {"a step less",
       [](auto& p, auto& r) {
         p.steps.erase(p.steps.begin() + static_cast<std::ptrdiff_t>(r.below(p.steps.size())));
       }},
      {"steps changed about", [](auto& p, auto& r) { std::swap(a_step(p, r), a_step(p, r)); }},
      {"a step twice",
       [](auto& p, auto& r) {
         const model::StepResult s = a_step(p, r);
         p.steps.insert(p.steps.begin() + static_cast<std::ptrdiff_t>(r.below(p.steps.size())), s);
       }},
      {"a harder material", [](auto& p, auto&) { p.material.kc11_n_mm2 *= 3.0; }},
      {"a weaker spindle",
       [](auto& p, auto&) {
         for (auto& at : p.machine.spindle.curve) at.power_w *= 0.02, at.torque_nm *= 0.02;
       }},
      {"a higher raw piece", [](auto& p, auto&) { p.stock.box.hi.z += 2.0; }},
      {"a round raw piece", [](auto& p, auto&) { p.stock.cylinder_radius_mm = 30.0; }},
      {"a finer tolerance",
       [](auto& p, auto&) {
         for (const auto w : p.model.all(model::TypeId::kWorkpiece))
           p.model.template at<model::Workpiece>(w).global_tolerance = 0.001;
       }},
      {"shallower features",
       [](auto& p, auto&) {
         for (const auto at : p.model.all(model::TypeId::kCartesianPoint)) {
           auto& c = p.model.template at<model::CartesianPoint>(at).coordinates.items;
           if (c.size() == 3 && c[2] < 0.0) c[2] += 0.5;
         }
       }},
  };
  return kAll;
}

TEST(KnownStepsProperty, APlanThatWasChangedHasTheFindingsOfAWholeCheck) {
  Job job;
  for (const Emitted& e : emitted_and_planned()) {
    memo::Memo known;
    const auto first = verify::check_plan(e.plan, job, &known);
    EXPECT_EQ(first, verify::check_plan(e.plan, job)) << e.name;
    std::size_t differ = 0;
    for (const PlanEdit& edit : plan_edits()) {
      for (int i = 0; i < rounds(1, 3); ++i) {
        Random random(next_seed());
        model::Plan changed = e.plan;
        edit.make(changed, random);
        const auto whole = verify::check_plan(changed, job);
        EXPECT_EQ(verify::check_plan(changed, job, &known), whole) << e.name << ", " << edit.name;
        differ += whole == first ? 0 : 1;
      }
    }
    EXPECT_GT(differ, soaking() ? 20U : 20U / kSample) << e.name;
    EXPECT_EQ(verify::check_plan(e.plan, job, &known), first) << e.name << ", after all of them";
  }
}

TEST(KnownSteps, OnlyStepsThatACutterTouchesAreSweptAgain) {
  // A pocket and a drilled and reamed hole elsewhere: whatever becomes of the drill, the pocket stands.
  const Emitted& e = emitted().front();
  ASSERT_GE(e.plan.steps.size(), 2U);
  Job job;
  memo::Memo known;
  (void)verify::check_plan(e.plan, job, &known);
  const auto first = known.counts(memo::Stage::kSweep);
  EXPECT_EQ(first.made, e.plan.steps.size());
  model::Plan changed = e.plan;
  const std::string id = changed.steps.front().cutter_id;
  std::size_t of_it = 0;
  for (const auto& s : changed.steps) of_it += s.cutter_id == id ? 1 : 0;
  for (auto& c : changed.cutters)
    if (c.id == id) c.functional_length_mm += 1.0;
  (void)verify::check_plan(changed, job, &known);
  const auto again = known.counts(memo::Stage::kSweep);
  EXPECT_EQ(again.made - first.made, of_it);
  EXPECT_EQ(again.found - first.found, e.plan.steps.size() - of_it);
}

}  // namespace
}  // namespace capstan::mutation
