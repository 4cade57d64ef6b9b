#include "planner/making/propose/coaxial_steps.h"

#include <algorithm>
#include <iterator>

#include "planner/ground/vocabulary/operation.h"
#include "planner/making/step/cut/drilled_hole.h"
#include "planner/model/nouns/all.h"

namespace capstan::propose {

void members_in_order(std::vector<draft::StepDraft>& steps, const std::vector<std::size_t>& first,
                      const std::vector<std::size_t>& second) {
  const auto sizes = [&](std::size_t step) {
    return model::craft_rank(steps[step].operation.type) == model::craft::kSizes;
  };
  const auto sized = std::find_if(first.begin(), first.end(), sizes);
  const auto sized_too = std::find_if(second.begin(), second.end(), sizes);
  const bool opened = sized != first.end() && sized != first.begin() && sized_too != second.begin();
  const std::size_t before = opened ? *std::prev(sized) : first.back();
  steps[second.front()].after.push_back(before);
  if (opened) steps[*sized].after.push_back(*std::prev(sized_too));
}

model::ProposedStep as_opened(const std::vector<model::ProposedStep>& chain, std::size_t at,
                              const std::vector<model::Selection>& chosen) {
  model::ProposedStep step = chain[at];
  if (at == 0 || chosen[at - 1].ranked.empty()) return step;
  const model::Cutter& before = chosen[at - 1].ranked.front().cutter;
  // The cutter that left the rest is known, where its largest was only bounded.
  if (step.rest_of_diameter_mm > 0.0)
    step.rest_of_diameter_mm = std::min(step.rest_of_diameter_mm, before.cutting_diameter_mm);
  step.start_diameter_mm = step::opened_by(step.start_diameter_mm, chain[at - 1], before);
  if (chain[at - 1].operation == model::TypeId::kCenterDrilling && before.point_angle_rad > 0.0)
    step.tool.spot_angle_rad = before.point_angle_rad;
  return step;
}

void warn_of_lost_threads(const model::Plan& plan, Job& job) {
  const model::Model& m = plan.model;
  for (const model::AnyRef r : m.all_below(model::TypeId::kRoundHole)) {
    const auto* hole = m.get<model::RoundHole>(r);
    for (const model::AnyRef op : hole->its_operations.items) {
      if (!m.holds<model::Tapping>(op) && !m.holds<model::ThreadDrilling>(op)) continue;
      const auto* o = m.get<model::MachiningOperation>(op);
      job.report({.code = "PIP-THREAD-LOST",
                  .severity = Severity::kWarning,
                  .message = "hole '" + hole->its_id.value_or("") + "': its operation '" +
                             (o == nullptr ? "" : o->its_id.value_or("")) +
                             "' makes a thread that no feature states: planning anew drops it",
                  .file = plan.file_name,
                  .line = m.origin(r).line,
                  .instance = m.origin(r).instance,
                  .hint = "state a thread feature on the hole, or keep the operation"});
    }
  }
}

}  // namespace capstan::propose
