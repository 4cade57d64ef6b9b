#include "planner/pipeline/members.h"

#include <algorithm>
#include <cmath>

#include "planner/model/nouns/all.h"

namespace capstan::pipeline {

void members_in_order(Work& w, const std::vector<std::size_t>& first,
                      const std::vector<std::size_t>& second) {
  const auto sizes = [&](std::size_t step) { return craft_rank(w.steps[step].operation.type) == kSizes; };
  const auto sized = std::find_if(first.begin(), first.end(), sizes);
  const auto sized_too = std::find_if(second.begin(), second.end(), sizes);
  const bool opened = sized != first.end() && sized != first.begin() && sized_too != second.begin();
  const std::size_t before = opened ? *std::prev(sized) : first.back();
  w.steps[second.front()].after.push_back(before);
  if (opened) w.steps[*sized].after.push_back(*std::prev(sized_too));
}

model::ProposedStep as_opened(const std::vector<model::ProposedStep>& chain, std::size_t at,
                              const std::vector<model::Selection>& chosen) {
  model::ProposedStep step = chain[at];
  if (at == 0 || !(step.start_diameter_mm > 0.0) || chosen[at - 1].ranked.empty()) return step;
  const model::ProposedStep& before = chain[at - 1];
  const model::Cutter& drill = chosen[at - 1].ranked.front().cutter;
  if (drill.cutter_class == model::CutterClass::kTwistDrill && before.tool.diameter_exact_mm <= 0.0)
    step.start_diameter_mm = std::max(step.start_diameter_mm, drill.cutting_diameter_mm);
  return step;
}

double depth_over_cone(const model::FeatureShape& hole, const model::Cutter& drill) {
  const double steep = std::tan(hole.bottom_angle_rad);
  const double apex = hole.depth_mm + 0.5 * hole.diameter.nominal_mm * steep;
  const double tip = model::tip_length(drill);
  const double at_corner = apex - 0.5 * drill.cutting_diameter_mm * steep;
  return std::min(apex - tip, at_corner);
}

void warn_of_lost_threads(Work& w) {
  const model::Model& m = w.plan.model;
  for (const AnyRef r : m.all_below(model::TypeId::kRoundHole)) {
    const auto* hole = m.get<model::RoundHole>(r);
    for (const AnyRef op : hole->its_operations.items) {
      if (!m.holds<model::Tapping>(op) && !m.holds<model::ThreadDrilling>(op)) continue;
      const auto* o = m.get<model::MachiningOperation>(op);
      w.job.report({.code = "PIP-THREAD-LOST",
                    .severity = Severity::kWarning,
                    .message = "hole '" + hole->its_id.value_or("") + "': its operation '" +
                               (o == nullptr ? "" : o->its_id.value_or("")) +
                               "' makes a thread that no feature states; planned anew, a plain hole stays",
                    .file = w.plan.file_name,
                    .line = m.origin(r).line,
                    .instance = m.origin(r).instance,
                    .hint = "state the thread as a feature on the hole, or keep the operation"});
    }
  }
}

}  // namespace capstan::pipeline
