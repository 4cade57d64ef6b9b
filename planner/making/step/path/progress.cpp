#include "planner/making/step/path/progress.h"

#include <algorithm>
#include <cmath>

#include "planner/ground/vocabulary/operation.h"
#include "planner/making/piece/surroundings.h"
#include "planner/making/step/middle_of_tolerance.h"
#include "planner/making/step/path/freeform.h"
#include "planner/making/step/path/job_of.h"
#include "planner/model/nouns/all.h"

namespace capstan::step {
namespace {

using draft::SetupDraft;
using draft::StepDraft;
using model::ShapeKind;

constexpr double kWithinMm = 1e-4;  ///< less than any path's last digits; default, unsourced

}  // namespace

/// The earlier step that reached all of the area except corners and narrow places, if this step has a smaller
/// cutter and leaves the same allowance. This step then cuts only the rest.
std::optional<toolpath::Cleared> Progress::cleared_by(const std::vector<Milled>& before,
                                                      const toolpath::PathJob& job) {
  constexpr double kSame = 1e-6;
  std::optional<toolpath::Cleared> out;
  for (const Milled& b : before) {
    if (b.operation != job.operation || std::abs(b.side_mm - job.allowance_side_mm) > kSame ||
        b.bottom_mm > job.allowance_bottom_mm + kSame ||
        b.diameter_mm < job.cutter.cutting_diameter_mm + kSame)
      continue;
    if (!out || b.diameter_mm < out->diameter_mm)
      out = toolpath::Cleared{b.diameter_mm, b.corner_radius_mm, b.side_mm};
  }
  return out;
}

void Progress::prepare(const StepDraft& step, const stock::HeightMap& map, toolpath::PathJob& job) const {
  const SetupDraft& setup = p_.setups[step.setup];
  shape_from_mesh(p_, step, job);
  aim_at_the_middle(job.shape);
  piece::stop_at_walls(p_.piece, job.shape);
  if (model::has(job.shape.kind, model::ShapeTrait::kOutwards)) {
    const auto outline = transformed(setup.stock, inverse(job.feature_in_setup));
    const auto raw = geometry::rectangle(geometry::xy(outline.lo), geometry::xy(outline.hi));
    job.shape.area = geometry::intersect(job.shape.area, raw);
  }
  if (job.shape.open && (job.shape.kind == ShapeKind::kStep || job.shape.kind == ShapeKind::kSlot ||
                         job.shape.kind == ShapeKind::kPocket)) {
    // A little within its own sides, so that the walls of the feature stay those of its own reach.
    const geometry::Region beside =
        geometry::offset(piece::stays_beside(p_.piece, job.shape), -kWithinMm, 0.1 * kWithinMm);
    if (!beside.empty()) job.shape.reach = geometry::subtract(job.shape.reach, beside);
  }
  const double top = job.feature_in_setup.origin.z;
  const double bottom = top - job.shape.depth_mm;
  const double material = top_over(map, job);
  // Nothing there at all: the file's own top is as good as any (and the path runs in air).
  job.start_z_mm = material > bottom ? material : top;
  if (job.shape.kind == ShapeKind::kHole || job.shape.kind == ShapeKind::kThread ||
      job.shape.kind == ShapeKind::kChamfer) {
    job.start_z_mm = std::max(job.start_z_mm, top);
  }
  const auto hole = holes_.find({step.feature, job.shape.member});
  if (hole != holes_.end() && !job.previous_diameter_mm) job.previous_diameter_mm = hole->second;
  const auto it = left_.find({step.feature, job.shape.member});
  if (it != left_.end()) {
    job.left_on_side_mm = it->second.side_mm;
    job.left_on_bottom_mm = it->second.bottom_mm;
    job.floor_made = it->second.floor_made;
  }
  take_rest(step, job);
}

/// Sets whether the step cuts the rest of an earlier step, and whether a later step will cut its rest. A
/// proposed step carries this flag, and roughing's rest is also cut by a finish with a smaller cutter, that
/// in an allowance by one with an equal cutter; for a step from the file it is read from the nouns.
void Progress::take_rest(const StepDraft& step, toolpath::PathJob& job) const {
  const bool area = job.shape.kind == ShapeKind::kPocket || job.shape.kind == ShapeKind::kSlot;
  if (!area || !model::has(job.cutter.cutter_class, model::CutterTrait::kEndMill)) return;
  if (step.proposed) {
    const bool roughs = model::has(step.operation.type, model::OperationTrait::kRoughs);
    const bool leaves = job.allowance_side_mm > 0.0;
    const auto after = [&](const StepDraft& s) {
      if (s.feature != step.feature) return false;
      const bool finishes = s.member == step.member && s.in_chain > step.in_chain &&
                            model::has(s.operation.type, model::OperationTrait::kFinishes);
      const double narrower = step.cutter.cutting_diameter_mm - s.cutter.cutting_diameter_mm;
      return (finishes && ((roughs && narrower > 0.0) || (leaves && narrower >= 0.0))) ||
             (s.proposal.rest_of_diameter_mm > 0.0 && s.operation.type == step.operation.type);
    };
    job.rest_follows =
        step.proposal.rest_of_diameter_mm == 0.0 && std::any_of(p_.steps.begin(), p_.steps.end(), after);
    if (step.proposal.rest_of_diameter_mm == 0.0) return;
  }
  const auto it = milled_.find({step.feature, job.shape.member});
  if (it != milled_.end()) job.cleared_by = cleared_by(it->second, job);
}

void Progress::done(const StepDraft& step) {
  for (const auto& shape : step.shapes) {
    const auto job = job_of(p_, step, shape);
    if (p_.plan.model.holds<model::Two5dMillingOperation>(step.operation)) {
      Left& left = left_.try_emplace({step.feature, shape.member}, Left{0.0, job.allowance_bottom_mm, false})
                       .first->second;
      left.side_mm = job.allowance_side_mm;
      // What finishes walls alone leaves the floor as it was.
      if (step.operation.type != model::TypeId::kSideFinishMilling) {
        left.bottom_mm = job.allowance_bottom_mm;
        left.floor_made = model::has(step.operation.type, model::OperationTrait::kFinishes);
      }
      if (model::has(step.cutter.cutter_class, model::CutterTrait::kEndMill)) {
        milled_[{step.feature, shape.member}].push_back({job.operation, step.cutter.cutting_diameter_mm,
                                                         step.cutter.corner_radius_mm, job.allowance_side_mm,
                                                         job.allowance_bottom_mm});
      }
    }
    const bool bores = p_.plan.model.holds<model::DrillingTypeOperation>(step.operation) &&
                       !p_.plan.model.holds<model::CenterDrilling>(step.operation) &&
                       !p_.plan.model.holds<model::CounterSinking>(step.operation);
    // A pilot or a mark that ends far above the bottom is no hole for the next tool to go through.
    const bool deep = job.cutting_depth_mm.value_or(shape.depth_mm) >= 0.5 * shape.depth_mm;
    if (bores && deep) holes_[{step.feature, shape.member}] = step.cutter.cutting_diameter_mm;
  }
}

}  // namespace capstan::step
