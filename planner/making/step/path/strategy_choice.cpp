#include "planner/making/step/path/strategy_choice.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "planner/ground/base/number.h"
#include "planner/ground/vocabulary/operation.h"
#include "planner/model/nouns/all.h"
#include "planner/model/plan/decision/by_planning.h"
#include "planner/physics/motion/time.h"

// Rings take wide cuts and begin each level with a slot, at which corners and bending hold depth and feed.
// Constant engagement takes narrow ones as deep as the edge is long. At equal force rings remove more per
// time, at equal chip and life a narrow cut is fed and turned faster. Rings outwards come into each corner
// with more of the cutter than on the straight, inwards they go round the corner of what is left with less;
// and the longest ring, the slot along the wall, is cut by the ramp on its way down. But that slot is longer
// than one in the middle. None wins everywhere, so all are made and the quickest is kept
// (door/pipeline/paths/make_paths.cpp).

namespace capstan::step {
namespace {

using draft::StepDraft;
using model::AnyRef;
using model::Model;
using model::Ref;

constexpr const char* kStrategy = "its_machining_strategy";
/// Another way is taken where its path takes less than this share of the time: the spindle comes up to its
/// speed, and its program is longer. Default, unsourced.
constexpr double kWorthwhile = 0.99;

AnyRef strategy_of(const Model& m, const StepDraft& step) {
  const auto* o = m.get<model::Two5dMillingOperation>(step.operation);
  return o == nullptr ? AnyRef{} : AnyRef(o->its_machining_strategy);
}

/// Whether planning may choose it: nothing is stated, or it was chosen by planning and is open again.
bool is_free(const model::Plan& plan, const StepDraft& step, AnyRef strategy) {
  if (!strategy.set()) return true;
  const auto* d = plan.ledger.find(step.operation, kStrategy);
  if (d == nullptr || d->pinned) return false;
  if (d->state == model::DecisionState::kOpen) return true;
  return model::by_planning(d);
}

/// Whether a strategy is one that rings follow, with the cutter climbing.
bool is_rings(const Model& m, AnyRef strategy) {
  const auto climbs = [](const auto& mode) {
    return !mode.set() || mode.value() == model::CutmodeType::kClimb;
  };
  if (!strategy.set() || m.holds<model::ExplicitStrategy>(strategy)) return true;
  if (const auto* c = m.get<model::ContourParallel>(strategy)) return climbs(c->cutmode);
  if (const auto* s = m.get<model::ContourSpiral>(strategy)) return climbs(s->cutmode);
  return false;
}

/// Whether the wall goes round like a circle: a ramp along it would be a helix that leaves a core
/// (CHK-HELIX).
bool is_round(const geometry::Region& area) {
  constexpr double kRound =
      0.98;  // of 4 pi area / circumference^2, which is 1 of a circle; default, unsourced
  return std::any_of(area.loops.begin(), area.loops.end(), [](const geometry::Loop& loop) {
    double around_mm = 0.0;
    for (std::size_t i = 0; i < loop.size(); ++i) around_mm += norm(loop[(i + 1) % loop.size()] - loop[i]);
    return 4.0 * std::numbers::pi * geometry::signed_area(loop) > kRound * around_mm * around_mm;
  });
}

}  // namespace

bool engages_constantly(const model::Plan& plan, const StepDraft& step) {
  const AnyRef strategy = strategy_of(plan.model, step);
  if (!strategy.set() || !plan.model.holds<model::ExplicitStrategy>(strategy)) return false;
  const auto* d = plan.ledger.find(step.operation, kStrategy);
  return d != nullptr && d->state == model::DecisionState::kBound && d->binder == model::Binder::kOptimiser;
}

bool may_engage_constantly(const PlanSoFar& p, const StepDraft& step, const toolpath::PathJob& job) {
  const Model& m = p.plan.model;
  const model::TypeId operation = step.operation.type;
  const bool roughs = m.holds<model::Two5dMillingOperation>(step.operation) &&
                      model::has(operation, model::OperationTrait::kRoughs) &&
                      model::has(operation, model::OperationTrait::kWalls);
  const model::Cutter& c = step.cutter;
  const bool upright = model::has(c.cutter_class, model::CutterTrait::kEndMill) && c.taper_angle_rad == 0.0 &&
                       c.lead_angle_rad == 0.0 && !model::has(c.cutter_class, model::CutterTrait::kBall);
  const bool open = step.open_technology && !step.keep_speed && !step.keep_feed &&
                    !(job.axial_depth_mm > 0.0) && !(job.radial_depth_mm > 0.0) &&
                    job.multiple_passes.value_or(true);
  const AnyRef strategy = strategy_of(m, step);
  if (p.wishes.edits != nullptr &&
      model::barred_strategy(*p.wishes.edits, draft::edit_names(m, step), model::kConstantEngagementWord))
    return false;
  return roughs && upright && open && !job.cleared_by && is_free(p.plan, step, strategy) &&
         is_rings(m, strategy);
}

bool may_ring_inwards(const PlanSoFar& p, const StepDraft& step, const toolpath::PathJob& job) {
  return may_engage_constantly(p, step, job) && !job.shape.open && !is_round(job.shape.area) &&
         step.cutter.maximum_ramp_angle_rad > 0.0 && !job.left_on_side_mm &&
         job.approach.kind == toolpath::Approach::Kind::kFree && !job.start_point &&
         model::has(job.shape.kind, model::ShapeTrait::kWalled);
}

double estimated_seconds(const optimise::CutQuestion& q, const optimise::CutAnswer& cut, double volume_mm3,
                         bool walled) {
  const double rate = cut.ap_mm * cut.ae_mm * cut.feed_mm_min;
  if (!(rate > 0.0)) return 0.0;
  const model::Cutter& c = q.cutter;
  constexpr double kTurns = 2.0;  // of the diameter
  const bool crescents = q.constant_engagement && q.width_mm < kTurns * c.cutting_diameter_mm;
  double out = volume_mm3 / rate * (crescents ? 0.5 * std::numbers::pi : 1.0);
  const double wide = q.fz_start_mm * std::max(1, c.teeth) * cut.n_rpm / optimise::speed_by_arc(q, cut.ae_mm);
  const double slope = std::tan(c.maximum_ramp_angle_rad);
  if (walled && slope > 0.0 && wide > 0.0) out += q.depth_mm / slope / std::min(wide, cut.feed_mm_min);
  return 60.0 * out;
}

bool worthwhile(double seconds, double than_s) { return seconds < kWorthwhile * than_s; }

std::string slower_text(double seconds, double best_s) {
  return (seconds < best_s ? "saves too little: takes " : "takes ") + motion::duration_text(seconds) +
         " against " + motion::duration_text(best_s);
}

std::string estimate_text(double about_s, double best_s) {
  return "takes about " + motion::duration_text(about_s) + " by its rate and entry against " +
         motion::duration_text(best_s);
}

std::string words_of(Clearing way, const optimise::CutAnswer& cut) {
  const char* what = way == Clearing::kConstantEngagement ? "constant engagement "
                     : way == Clearing::kInwards          ? "rings from the wall inwards "
                                                          : "rings ";
  return what + trimmed(cut.ae_mm, 2) + " mm wide, " + trimmed(cut.ap_mm, 2) + " mm deep";
}

void record_strategy(model::Plan& plan, const StepDraft& step, const StrategyChoice& choice) {
  Model& m = plan.model;
  const AnyRef now = strategy_of(m, step);
  const auto* ringed = m.get<model::ContourParallel>(now);
  const Clearing was = now.set() && m.holds<model::ExplicitStrategy>(now)      ? Clearing::kConstantEngagement
                       : ringed != nullptr && ringed->rotation_direction.set() ? Clearing::kInwards
                                                                               : Clearing::kOutwards;
  if (choice.way == was) {
    // The strategy stays as the rules proposed it or an earlier choice left it: record the others beside it.
    auto* d = plan.ledger.find(step.operation, kStrategy);
    if (choice.way == Clearing::kOutwards && d != nullptr && d->state == model::DecisionState::kBound) {
      for (const model::Rejected& r : choice.lost) d->rejected.push_back(r);
      return;
    }
  }
  Ref<model::Two5dMillingStrategy> made;
  const char* why = "path.constant_engagement";
  if (choice.way == Clearing::kConstantEngagement) {
    made = m.add(model::ExplicitStrategy{});
  } else {
    model::ContourParallel rings;
    rings.cutmode = model::CutmodeType::kClimb;
    if (choice.way == Clearing::kInwards)
      rings.rotation_direction =
          step.cutter.hand == model::Hand::kLeft ? model::RotDirection::kCcw : model::RotDirection::kCw;
    made = m.add(rings);
    why = choice.way == Clearing::kInwards ? "path.rings_inwards" : "path.rings";
  }
  m.get<model::Two5dMillingOperation>(step.operation)->its_machining_strategy = made;
  plan.ledger.bind(step.operation, kStrategy, model::Binder::kOptimiser,
                   {why, "the quickest of its paths at equal limits: " + choice.taken,
                    "times of the paths along their feeds"},
                   {{step.operation, "its_tool"}}, choice.lost);
}

}  // namespace capstan::step
