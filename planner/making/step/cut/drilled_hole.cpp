#include "planner/making/step/cut/drilled_hole.h"

#include <algorithm>
#include <cmath>

namespace capstan::step {

using draft::StepDraft;

double opened_by(double stated_mm, const model::ProposedStep& before, const model::Cutter& drill) {
  const bool open =
      drill.cutter_class == model::CutterClass::kTwistDrill && before.tool.diameter_exact_mm <= 0.0;
  return stated_mm > 0.0 && open ? std::max(stated_mm, drill.cutting_diameter_mm) : stated_mm;
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

void fit_to_cutter(model::Model& m, std::vector<StepDraft>& steps, StepDraft& step) {
  if (!step.proposed) return;
  if (const auto depth = depth_with_its_cutter(step)) {
    step.proposal.depth_mm = *depth;
    if (auto* o = m.get<model::DrillingTypeOperation>(step.operation)) o->cutting_depth = *depth;
  }
  for (StepDraft& next : steps) {
    if (!next.proposed || next.member != step.member || next.chain != step.chain ||
        next.in_chain != step.in_chain + 1)
      continue;
    next.proposal.start_diameter_mm = opened_by(next.start_in_chain_mm, step.proposal, step.cutter);
    if (auto* o = m.get<model::DrillingTypeOperation>(next.operation);
        o != nullptr && next.proposal.start_diameter_mm > 0.0)
      o->previous_diameter = next.proposal.start_diameter_mm;
  }
}

bool goes_on_below(const model::FeatureShape& s, const model::FeatureShape& other) {
  constexpr double kSame = 1e-4;  // mm
  if (other.kind != model::ShapeKind::kHole) return false;
  const auto rel = compose(inverse(s.frame), other.frame);
  const bool coaxial = std::hypot(rel.origin.x, rel.origin.y) < kSame && rel.z.z > 1.0 - kSame;
  const bool goes_on =
      rel.origin.z > -s.depth_mm - kSame && rel.origin.z - other.depth_mm < -s.depth_mm - kSame;
  return coaxial && goes_on && other.diameter.nominal_mm < s.diameter.nominal_mm - kSame;
}

}  // namespace capstan::step
