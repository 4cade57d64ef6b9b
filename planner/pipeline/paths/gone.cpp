#include "planner/pipeline/paths/gone.h"

#include <algorithm>

#include "planner/engagement/engagement.h"
#include "planner/pipeline/paths/results.h"
#include "planner/pipeline/steps.h"

// What other features' steps took away already is not cut again: the step is left out, not its feature.

namespace capstan::pipeline {
namespace {

geometry::Box3 box_over(const geometry::Region& area) {
  const auto b = geometry::bounds(area);
  geometry::Box3 out;
  out.add({b.lo.x, b.lo.y, 0.0});
  out.add({b.hi.x, b.hi.y, 0.0});
  return out;
}

/// The last step with a path, in whichever set-up, in whose area this one's lies: what it would cut is gone
/// with that.
Ref<model::Executable> made_by(const Work& w, const StepWork& step) {
  Ref<model::Executable> out;
  for (const model::StepResult& kept : w.plan.steps) {
    const auto it =
        std::find_if(w.steps.begin(), w.steps.end(), [&](const StepWork& s) { return s.step == kept.step; });
    if (it == w.steps.end() || it->shapes.empty() || step.shapes.empty()) continue;
    const auto& a = it->shapes.front();
    const auto& b = step.shapes.front();
    const auto box = transformed(box_over(a.area), compose(inverse(b.frame), a.frame));
    const auto own = geometry::bounds(b.area);
    if (box.lo.x <= own.hi.x && box.hi.x >= own.lo.x && box.lo.y <= own.hi.y && box.hi.y >= own.lo.y)
      out = kept.step;
  }
  return out;
}

}  // namespace

bool in_air(const Work& w, const StepWork& step, double removed_mm3) {
  constexpr double kNothingMm3 = 0.01;  // default, unsourced: what a map's cells cannot tell from nothing
  const model::Model& m = w.plan.model;
  if (!step.proposed || removed_mm3 > kNothingMm3 || engagement::head_height(step.cutter)) return false;
  if (m.holds<model::CenterDrilling>(step.operation) || m.holds<model::Drilling>(step.operation) ||
      m.holds<model::MultistepDrilling>(step.operation))
    return true;
  const bool rough = m.holds<model::PlaneRoughMilling>(step.operation) ||
                     m.holds<model::SideRoughMilling>(step.operation) ||
                     m.holds<model::BottomAndSideRoughMilling>(step.operation);
  if (rough) return true;
  if (!m.holds<model::Two5dMillingOperation>(step.operation)) return false;
  // A finish stays after other steps of what it finishes: of the same element, where there are several.
  return std::none_of(w.steps.begin(), w.steps.end(), [&](const StepWork& other) {
    const auto is_other = [&](const model::StepResult& r) { return r.step == other.step; };
    return other.feature == step.feature && (!other.proposed || other.member == step.member) &&
           std::any_of(w.plan.steps.begin(), w.plan.steps.end(), is_other);
  });
}

bool leave_out(Work& w, const StepWork& step, const std::string& why) {
  model::Model& m = w.plan.model;
  // Steps of the feature that are kept, or still to come: without any, and made by no other's, it is not
  // made.
  const auto kept = [&](const StepWork& s) {
    return std::any_of(w.plan.steps.begin(), w.plan.steps.end(),
                       [&](const model::StepResult& r) { return r.step == s.step; });
  };
  bool later = false, others = false;
  for (const StepWork& s : w.steps) {
    if (s.step == step.step) {
      later = true;
    } else if (s.feature == step.feature) {
      others = others || later || kept(s);
    }
  }
  auto* maker = m.get<model::MachiningWorkingstep>(made_by(w, step));
  if (maker == nullptr && !others) return false;
  if (maker != nullptr && AnyRef(maker->its_feature) != step.feature) {
    auto& made = maker->final_features;
    if (std::find(made.items.begin(), made.items.end(), step.feature) == made.items.end())
      made.push_back(Ref<model::ManufacturingFeature>(step.feature));
  }
  for (const AnyRef p : m.all(model::TypeId::kWorkplan))
    std::erase(m.get<model::Workplan>(p)->its_elements.items, AnyRef(step.step));
  if (auto* f = m.get<model::MachiningFeature>(step.feature))
    std::erase(f->its_operations.items, step.operation);
  w.job.note("PIP-GONE",
             "step '" + name_of(w, step) + "' is left out: what it would cut is gone already; " + why);
  return true;
}

}  // namespace capstan::pipeline
