#include "planner/door/pipeline/propose/members.h"

#include <algorithm>
#include <cmath>

#include "planner/model/nouns/all.h"

namespace capstan::pipeline {

void members_in_order(Work& w, const std::vector<std::size_t>& first,
                      const std::vector<std::size_t>& second) {
  const auto sizes = [&](std::size_t step) {
    return model::craft_rank(w.steps[step].operation.type) == model::craft::kSizes;
  };
  const auto sized = std::find_if(first.begin(), first.end(), sizes);
  const auto sized_too = std::find_if(second.begin(), second.end(), sizes);
  const bool opened = sized != first.end() && sized != first.begin() && sized_too != second.begin();
  const std::size_t before = opened ? *std::prev(sized) : first.back();
  w.steps[second.front()].after.push_back(before);
  if (opened) w.steps[*sized].after.push_back(*std::prev(sized_too));
}

namespace {

/// The hole that a step finds where the chain states one: the drill before it may be wider, where its
/// requirement left open which.
double opened_by(double stated_mm, const model::ProposedStep& before, const model::Cutter& drill) {
  const bool open =
      drill.cutter_class == model::CutterClass::kTwistDrill && before.tool.diameter_exact_mm <= 0.0;
  return stated_mm > 0.0 && open ? std::max(stated_mm, drill.cutting_diameter_mm) : stated_mm;
}

}  // namespace

model::ProposedStep as_opened(const std::vector<model::ProposedStep>& chain, std::size_t at,
                              const std::vector<model::Selection>& chosen) {
  model::ProposedStep step = chain[at];
  if (at == 0 || chosen[at - 1].ranked.empty()) return step;
  step.start_diameter_mm =
      opened_by(step.start_diameter_mm, chain[at - 1], chosen[at - 1].ranked.front().cutter);
  return step;
}

double depth_over_cone(const model::FeatureShape& hole, const model::Cutter& drill) {
  const double steep = std::tan(hole.bottom_angle_rad);
  const double apex = hole.depth_mm + 0.5 * hole.diameter.nominal_mm * steep;
  const double tip = model::tip_length(drill);
  const double at_corner = apex - 0.5 * drill.cutting_diameter_mm * steep;
  return std::min(apex - tip, at_corner);
}

std::optional<double> depth_with_its_cutter(const StepDraft& step) {
  if (!step.proposed || step.shapes.empty() || !(step.proposal.tool.point_angle_rad > 0.0) ||
      step.cutter.cutter_class != model::CutterClass::kTwistDrill)
    return std::nullopt;
  return depth_over_cone(step.shapes.front(), step.cutter);
}

void fit_to_cutter(Work& w, StepDraft& step) {
  if (!step.proposed) return;
  if (const auto depth = depth_with_its_cutter(step)) {
    step.proposal.depth_mm = *depth;
    if (auto* o = w.plan.model.get<model::DrillingTypeOperation>(step.operation)) o->cutting_depth = *depth;
  }
  for (StepDraft& next : w.steps) {
    if (!next.proposed || next.member != step.member || next.chain != step.chain ||
        next.in_chain != step.in_chain + 1)
      continue;
    next.proposal.start_diameter_mm = opened_by(next.start_in_chain_mm, step.proposal, step.cutter);
    if (auto* o = w.plan.model.get<model::DrillingTypeOperation>(next.operation);
        o != nullptr && next.proposal.start_diameter_mm > 0.0)
      o->previous_diameter = next.proposal.start_diameter_mm;
  }
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
