#include "planner/making/step/path/job_of.h"

#include <algorithm>
#include <cmath>

#include "planner/making/step/cut/drilled_hole.h"
#include "planner/making/step/path/freeform.h"
#include "planner/making/step/path/strategy_choice.h"
#include "planner/model/features/resolve.h"
#include "planner/model/nouns/all.h"
#include "planner/model/plan/cutter/ramp.h"
#include "planner/model/plan/decision/by_planning.h"

// What the nouns of an operation say, as the values that the path is made from.

namespace capstan::step {
namespace {

using draft::SetupDraft;
using draft::StepDraft;
using model::AnyRef;
using model::Model;
using model::Ref;
using model::StrategyKind;
using model::TypeId;

toolpath::Approach approach_of(const Model& m, AnyRef given) {
  using Kind = toolpath::Approach::Kind;
  toolpath::Approach a;
  if (m.holds<model::PlungeToolaxis>(given)) a.kind = Kind::kPlunge;
  if (const auto* s = m.get<model::PlungeRamp>(given)) {
    a.kind = Kind::kRamp;
    a.angle_rad = s->angle.value_or(0.0);
  }
  if (const auto* s = m.get<model::PlungeHelix>(given)) {
    a.kind = Kind::kHelix;
    a.radius_mm = s->radius.value_or(0.0);
    a.angle_rad = s->angle.value_or(0.0);
  }
  if (const auto* s = m.get<model::PlungeZigzag>(given)) {
    a.kind = Kind::kZigzag;
    a.angle_rad = s->angle.value_or(0.0);
    a.width_mm = s->width.value_or(0.0);
  }
  if (const auto* s = m.get<model::ApRetractTangent>(given)) {
    a.kind = Kind::kTangent;
    a.radius_mm = s->radius.value_or(0.0);
  }
  if (const auto* s = m.get<model::ApRetractAngle>(given)) {
    a.kind = Kind::kAngle;
    a.angle_rad = s->angle.value_or(0.0);
    a.length_mm = s->travel_length.value_or(0.0);
  }
  return a;
}

void take_strategy(const Model& m, AnyRef given, toolpath::PathJob& job) {
  const auto* base = m.get<model::Two5dMillingStrategy>(given);
  if (base == nullptr) return;
  job.overlap = base->overlap;
  job.multiple_passes = base->allow_multiple_passes;
  const auto direction = [&](Ref<model::Direction> d) {
    if (const auto v = model::direction(m, d)) job.feed_direction = geometry::xy(*v);
  };
  const auto side = [&](model::Enumerated<model::LeftOrRight> s) {
    if (s.set()) job.stepover_left = s.value() == model::LeftOrRight::kLeft;
  };
  const auto mode = [&](model::Enumerated<model::CutmodeType> c) {
    if (c.set()) job.climb = c.value() == model::CutmodeType::kClimb;
  };
  const auto turn = [&](model::Enumerated<model::RotDirection> r) {
    if (r.set()) job.rotation_ccw = r.value() == model::RotDirection::kCcw;
  };
  if (const auto* s = m.get<model::BidirectionalMilling>(given)) {
    job.strategy = StrategyKind::kBidirectional;
    direction(s->feed_direction);
    side(s->stepover_direction);
  } else if (const auto* u = m.get<model::UnidirectionalMilling>(given)) {
    job.strategy = StrategyKind::kUnidirectional;
    direction(u->feed_direction);
    mode(u->cutmode);
  } else if (const auto* c = m.get<model::ContourParallel>(given)) {
    job.strategy = StrategyKind::kContourParallel;
    turn(c->rotation_direction);
    mode(c->cutmode);
  } else if (const auto* p = m.get<model::ContourSpiral>(given)) {
    job.strategy = StrategyKind::kContourSpiral;
    turn(p->rotation_direction);
    mode(p->cutmode);
  } else if (const auto* b = m.get<model::ContourBidirectional>(given)) {
    job.strategy = StrategyKind::kContourBidirectional;
    direction(b->feed_direction);
    side(b->stepover_direction);
    mode(b->spiral_cutmode);
  } else if (const auto* d = m.get<model::BidirectionalContour>(given)) {
    job.strategy = StrategyKind::kContourBidirectional;
    direction(d->feed_direction);
    side(d->stepover_direction);
    mode(d->spiral_cutmode);
  } else if (m.holds<model::CenterMilling>(given)) {
    job.strategy = StrategyKind::kCenterMilling;
  }
}

void take_milling(const Model& m, AnyRef op, toolpath::PathJob& job) {
  if (const auto* o = m.get<model::MillingTypeOperation>(op)) {
    job.approach = approach_of(m, o->approach);
    job.retract = approach_of(m, o->retract);
  }
  if (const auto* o = m.get<model::Two5dMillingOperation>(op))
    take_strategy(m, o->its_machining_strategy, job);
  if (const auto* o = m.get<model::PlaneMilling>(op)) {
    job.axial_depth_mm = o->axial_cutting_depth.value_or(0.0);
    job.allowance_bottom_mm = o->allowance_bottom.value_or(0.0);
  }
  if (const auto* o = m.get<model::SideMilling>(op)) {
    job.axial_depth_mm = o->axial_cutting_depth.value_or(0.0);
    job.radial_depth_mm = o->radial_cutting_depth.value_or(0.0);
    job.allowance_side_mm = o->allowance_side.value_or(0.0);
  }
  if (const auto* o = m.get<model::BottomAndSideMilling>(op)) {
    job.axial_depth_mm = o->axial_cutting_depth.value_or(0.0);
    job.radial_depth_mm = o->radial_cutting_depth.value_or(0.0);
    job.allowance_side_mm = o->allowance_side.value_or(0.0);
    job.allowance_bottom_mm = o->allowance_bottom.value_or(0.0);
  }
}

void take_drilling(const Model& m, AnyRef op, toolpath::PathJob& job) {
  const auto* o = m.get<model::DrillingTypeOperation>(op);
  if (o == nullptr) return;
  job.cutting_depth_mm = o->cutting_depth;
  job.previous_diameter_mm = o->previous_diameter;
  job.feed_on_retract = o->feed_on_retract;
  job.dwell_s = o->dwell_time_bottom.value_or(0.0);
  if (const auto* s = m.get<model::DrillingTypeStrategy>(o->its_machining_strategy)) {
    toolpath::DrillPhases phases;
    phases.speed_at_start = s->reduced_cut_at_start.value_or(1.0);
    phases.feed_at_start = s->reduced_feed_at_start.value_or(1.0);
    phases.depth_of_start_mm = s->depth_of_start.value_or(0.0);
    phases.speed_at_end = s->reduced_cut_at_end.value_or(1.0);
    phases.feed_at_end = s->reduced_feed_at_end.value_or(1.0);
    phases.depth_of_end_mm = s->depth_of_end.value_or(0.0);
    // depth_of_end is the depth at which the end phase begins, as the interpreter of the standard's own
    // example reads it: 8 mm in a hole of 30 mm reduces the feed from 8 mm on.
    phases.end_counts_from_top = true;
    if (phases.depth_of_start_mm > 0.0 || phases.depth_of_end_mm > 0.0) job.phases = phases;
  }
  if (const auto* s = m.get<model::MultistepDrilling>(op)) {
    toolpath::Peck peck;
    peck.first_mm = s->first_depth.value_or(0.0);
    peck.step_mm = s->depth_of_step.value_or(0.0);
    peck.retract_mm = s->retract_distance.value_or(0.0);
    peck.dwell_s = s->dwell_time_step.value_or(0.0);
    job.peck = peck;
  }
  if (const auto* b = m.get<model::BoringOperation>(op)) {
    job.spindle_stop_at_bottom = b->spindle_stop_at_bottom.value_or(false);
  }
}

/// ISO 14649 has no place for necks: that of a form cutter read from a file is the one of the library's
/// cutter of the same name, class and diameter.
model::Cutter with_neck(const std::vector<model::Cutter>& library, model::Cutter c) {
  if (!model::has(c.cutter_class, model::CutterTrait::kNecked)) return c;
  for (const model::Cutter& known : library) {
    if (known.id != c.id || known.cutter_class != c.cutter_class ||
        std::abs(known.cutting_diameter_mm - c.cutting_diameter_mm) > 1e-6)
      continue;
    if (c.neck_diameter_mm <= 0.0) {
      c.neck_diameter_mm = known.neck_diameter_mm;
      c.neck_length_mm = known.neck_length_mm;
    }
    if (c.tip_diameter_mm <= 0.0) c.tip_diameter_mm = known.tip_diameter_mm;
    if (c.corner_radius_mm <= 0.0) c.corner_radius_mm = known.corner_radius_mm;
  }
  return c;
}

/// The narrowest hole of the same feature that begins higher on the shape's axis and reaches it; 0: none.
double hole_above(const Model& m, AnyRef feature, const model::FeatureShape& s) {
  constexpr double kSame = 1e-4;  // mm
  if (s.kind != model::ShapeKind::kHole) return 0.0;
  const auto all = model::shapes_of(m, Ref<model::ManufacturingFeature>(feature));
  if (!all) return 0.0;
  double out = 0.0;
  for (const model::FeatureShape& other : *all) {
    if (other.kind != model::ShapeKind::kHole) continue;
    const auto rel = compose(inverse(s.frame), other.frame);
    const bool coaxial = std::hypot(rel.origin.x, rel.origin.y) < kSame && rel.z.z > 1.0 - kSame;
    const double d = other.diameter.nominal_mm;
    if (!coaxial || rel.origin.z < kSame || rel.origin.z - other.depth_mm > kSame) continue;
    if (d < std::max(s.diameter.nominal_mm, s.bottom_diameter_mm) - kSame && (out == 0.0 || d < out)) out = d;
  }
  return out;
}

/// The widest narrower hole that goes on below a cone's foot or a shoulder, of the same feature or as the
/// proposal of a cone knows it.
double hole_below(const Model& m, const StepDraft& step, const model::FeatureShape& s) {
  constexpr double kSame = 1e-4;  // mm
  const bool cone = s.bottom_diameter_mm < s.diameter.nominal_mm - kSame;
  if (s.kind != model::ShapeKind::kHole || (s.through && !cone)) return 0.0;
  double out = cone && step.proposed ? step.proposal.start_diameter_mm : 0.0;
  const auto all = model::shapes_of(m, Ref<model::ManufacturingFeature>(step.feature));
  if (!all) return out;
  for (const model::FeatureShape& other : *all) {
    if (goes_on_below(s, other)) out = std::max(out, other.diameter.nominal_mm);
  }
  return out;
}

}  // namespace

toolpath::PathJob job_of(const PlanSoFar& p, const StepDraft& step, const model::FeatureShape& shape) {
  const Model& m = p.plan.model;
  const SetupDraft& setup = p.setups[step.setup];
  toolpath::PathJob job;
  job.step = draft::name_of(m, step);
  job.shape = shape;
  job.feature_in_setup = compose(setup.workpiece, shape.frame);
  job.operation = step.operation.type;
  job.cutter = with_neck(p.wishes.library, step.cutter);
  const model::Ramp ramp = model::ramp_of(job.cutter, p.plan.material);
  job.ramp_angle_rad = ramp.angle_rad;
  job.ramp_depth_mm = ramp.bore_depth_mm;
  job.digit_mm = std::pow(10.0, -p.plan.machine.control.decimals);
  take_milling(m, step.operation, job);
  take_drilling(m, step.operation, job);
  job.constant_engagement = step.constant_engagement.value_or(engages_constantly(p.plan, step));
  if (job.constant_engagement) {  // the same path whatever strategy it was chosen over
    job.strategy = StrategyKind::kNone;
    job.climb = true;
    job.overlap.reset();
    job.rotation_ccw.reset();
    job.feed_direction.reset();
    job.stepover_left.reset();
  }
  // What planning chose bounds how far passes are apart, which are equally wide; what a file gives is kept.
  if (const auto* o = m.get<model::Two5dMillingOperation>(step.operation);
      o != nullptr && job.overlap && !step.proposed && !(job.radial_depth_mm > 0.0) &&
      model::by_planning(p.plan.ledger.find(o->its_machining_strategy, "overlap"))) {
    job.radial_depth_mm = std::max(0.0, 1.0 - *job.overlap) * step.cutter.cutting_diameter_mm;
    job.overlap.reset();
  }
  // Inwards with the material beside the pass on the right of a climbing right-hand cutter: clockwise.
  if (step.inwards && !job.constant_engagement) {
    job.rotation_ccw.reset();
    if (*step.inwards) job.rotation_ccw = job.climb == (step.cutter.hand == model::Hand::kLeft);
  }
  // The noun's is that of the cutter that the step had: another may be tried.
  if (const auto depth = depth_with_its_cutter(step)) job.cutting_depth_mm = depth;
  if (m.holds<model::FreeformFinishMilling>(step.operation))
    job.allowance_side_mm = job.allowance_bottom_mm = freeform_allowance(m, p.steps, step);
  // What was chosen for a tool that has been re-opened is open again, whatever stands in the noun.
  if (p.plan.ledger.is_open(step.operation, "axial_cutting_depth")) job.axial_depth_mm = 0.0;
  if (p.plan.ledger.is_open(step.operation, "radial_cutting_depth")) job.radial_depth_mm = 0.0;
  const auto* op = m.get<model::MachiningOperation>(step.operation);
  if (op != nullptr && op->start_point.set()) {
    if (const auto at = model::point(m, op->start_point)) job.start_point = geometry::xy(*at);
  }
  const double top = job.feature_in_setup.origin.z;
  job.security_z_mm = setup.security_z_mm;
  job.retract_z_mm =
      std::min(setup.security_z_mm, top + (op != nullptr ? op->retract_plane.value_or(5.0) : 5.0));
  job.stock = geometry::rectangle(geometry::xy(setup.stock.lo), geometry::xy(setup.stock.hi));
  job.hole_above_mm = hole_above(m, step.feature, shape);
  job.hole_below_mm = hole_below(m, step, shape);
  if (shape.through) job.break_through_mm = 1.0;  // below what is through; default, unsourced
  return job;
}

bool has_given_path(const model::Plan& plan, const StepDraft& step) {
  if (plan.model.holds<model::RapidMovement>(step.step)) return true;
  const auto* op = plan.model.get<model::MachiningOperation>(step.operation);
  if (op == nullptr || !op->its_toolpath.set()) return false;
  // A surface that the file could not hold is cut along the path that was computed when it was there.
  if (plan.model.holds<model::FreeformOperation>(step.operation) && !plan.target_mesh) return true;
  const auto* d = plan.ledger.find(step.operation, "its_toolpath");
  return d == nullptr || d->binder == model::Binder::kGiven || d->pinned;
}

}  // namespace capstan::step
