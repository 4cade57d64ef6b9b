#include "planner/making/step/cut/question.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <span>
#include <utility>

#include "planner/ground/base/number.h"
#include "planner/ground/vocabulary/operation.h"
#include "planner/ground/vocabulary/thread_mill.h"
#include "planner/making/step/cut/thread_bound.h"
#include "planner/making/step/path/freeform.h"
#include "planner/making/step/record/record.h"
#include "planner/making/toolpath/hole/hole_paths.h"
#include "planner/making/toolpath/region/form/undercut.h"
#include "planner/model/features/fit/general.h"
#include "planner/model/features/raw_piece.h"
#include "planner/model/plan/cutter/ramp.h"
#include "planner/model/plan/decision/by_planning.h"
#include "planner/model/plan/preset_feeds.h"
#include "planner/physics/mechanics/constants.h"
#include "planner/physics/mechanics/holding_constants.h"
#include "planner/physics/mechanics/stability.h"
#include "tooling/library/cutters/edge_kind.h"
#include "tooling/selection/select.h"

namespace capstan::step {
namespace {

using draft::StepDraft;
using model::AnyRef;
using model::Model;
using model::ShapeKind;
using model::TypeId;
using optimise::CutKind;

/// Share of a tolerance zone that bending of the tool may use in finishing. Default, unsourced.
constexpr double kDeflectionShare = 0.25;
constexpr double kFinishDeflection = 0.02;  // mm, of a surface without a tolerance; default, unsourced
/// What one wall may be off of a zone: a size in its middle has half of it on either side (derived).
constexpr double kWallOfZone = 0.5;
constexpr double kLeastDeflection = 0.004;  // mm; below, the model's own error rules
/// Largest height of the terraces that roughing of a leaning wall leaves, in diameters. Default, measured: of
/// 0.07, 0.13, 0.2, 0.25 and 0.4 the one with which examples/surface.stl was roughed and evened out soonest
/// when its levels were as far apart.
constexpr double kTerraceShare = 0.25;
/// Largest depth of a cut that roughs a surface, in diameters; levels between bound its terraces. Default,
/// measured with a bull nose of 16 mm: of 0.25, 0.32, 0.4, 0.5 and no bound the one with which
/// examples/surface.stl is roughed soonest in 6061.
constexpr double kSurfaceShare = 0.5;
/// A slot no wider than its cutter by this is cut at its full width. Default, unsourced.
constexpr double kAsWide = 1.02;

CutKind kind_of(const Model& m, AnyRef op, const model::Cutter& c) {
  if (model::mills_threads(c.cutter_class) && !m.holds<model::Tapping>(op)) return CutKind::kFinish;
  if (!model::axial_law(op.type).empty()) {
    const bool mills = model::has(c.cutter_class, model::CutterTrait::kEndMill);
    return mills && m.holds<model::ThreadDrilling>(op) ? CutKind::kRough : CutKind::kAxial;
  }
  const bool plane = model::has(op.type, model::OperationTrait::kPlane);
  return !plane && model::has(op.type, model::OperationTrait::kFinishes) ? CutKind::kFinish : CutKind::kRough;
}

void take_axial_law(TypeId operation, optimise::CutQuestion& q) {
  q.kind = CutKind::kAxial;
  if (const std::string_view law = model::axial_law(operation); !law.empty()) q.law = law;
}

double tolerance_of(const Model& m, AnyRef feature, const model::FeatureShape& s) {
  if (const double width = stated_zone_mm(s); width > 0.0) return width;
  if (const auto* f = m.get<model::ManufacturingFeature>(feature)) {
    if (const auto* piece = m.get<model::Workpiece>(f->its_workpiece)) {
      return 2.0 * model::global_tolerance_of(*piece).value_or(0.0);
    }
  }
  return 0.0;
}

/// Zone of a size that states no tolerance, mm: the general one of the drawing, else ISO 2768-1 class f
/// (default, unsourced: which class a shop holds where a drawing says nothing); 0: none for this size.
double general_zone_mm(const std::optional<model::GeneralTolerance>& general, double size_mm) {
  model::GeneralTolerance fine;
  fine.size_class = 'f';
  return 2.0 * model::general_size(general.value_or(fine), size_mm).value_or(0.0);
}

/// Zone of the feature's sizes across, mm: stated, of the workpiece, or general; 0: of a surface, or none.
double zone_across(const PlanSoFar& p, const StepDraft& step, const toolpath::PathJob& job, double width_mm) {
  const bool surface = p.plan.model.holds<model::FreeformOperation>(step.operation);
  return zone_across_mm(p.plan.model, step.feature, job.shape, surface ? 0.0 : width_mm, p.demands.general);
}

/// What a cut before the last may bend at its tip, mm. A wall is pushed off by no more than the tip is bent.
double rough_bending_mm(const PlanSoFar& p, const StepDraft& step, const toolpath::PathJob& job,
                        const optimise::CutQuestion& q) {
  if (p.plan.model.holds<model::PlaneMilling>(step.operation)) return optimise::kFaceDeflectionMm;
  const bool surface = p.plan.model.holds<model::FreeformOperation>(step.operation);
  const double left = surface ? freeform_allowance(p.plan.model, p.steps, step) : job.allowance_side_mm;
  if (left > 0.0) return bending_in_allowance_mm(left, q.cutter, q.material);
  return bending_of_last_rough_mm(zone_across(p, step, job, q.width_mm));
}

/// How much more than its allowance the last step before left on the feature's walls at most, mm: what its
/// tip was bent, for a cutter that climbs is pushed off the wall. 0: no such step, or its bending is unknown.
double left_by_bending_mm(const PlanSoFar& p, const StepDraft& step) {
  const Model& m = p.plan.model;
  const auto left_by = [&](const model::StepResult& r) -> std::optional<double> {
    const auto* ws = m.get<model::MachiningWorkingstep>(r.step);
    if (ws == nullptr || AnyRef(ws->its_feature) != step.feature) return std::nullopt;
    const auto* side = m.get<model::SideMilling>(ws->its_operation);
    const auto* both = m.get<model::BottomAndSideMilling>(ws->its_operation);
    const double left = side != nullptr   ? side->allowance_side.value_or(0.0)
                        : both != nullptr ? both->allowance_side.value_or(0.0)
                                          : 0.0;
    return left > 0.0 ? std::optional(std::min(left, r.loads.deflection_mm)) : std::nullopt;
  };
  const std::span<const model::StepResult> cut(p.recorded.steps.data(),
                                               std::min(p.cut, p.recorded.steps.size()));
  for (const std::span<const model::StepResult> steps : {std::span(std::as_const(p.plan.steps)), cut}) {
    for (auto r = steps.rbegin(); r != steps.rend(); ++r)
      if (const auto mm = left_by(*r)) return *mm;
  }
  return 0.0;
}

/// Sets the surface limits of a finishing step: roughness and form error. Roughing steps have none.
///
/// If the wall error can be computed, it is limited to a share of the tolerance (tip_beside_wall_mm).
void hold_quality(const PlanSoFar& p, const StepDraft& step, const toolpath::PathJob& job,
                  optimise::CutQuestion& q) {
  const Model& m = p.plan.model;
  const bool floor = job.allowance_bottom_mm > 0.0;
  const bool wall = job.allowance_side_mm > 0.0;
  const bool finishes = model::has(step.operation.type, model::OperationTrait::kFinishes);
  const auto asked = p.demands.qualities.find(step.feature);
  if (finishes && !(floor && wall) && asked != p.demands.qualities.end())
    q.surface_ra_um = asked->second.ra_um.value_or(0.0);
  const bool upright = model::has(step.cutter.cutter_class, model::CutterTrait::kEndMill);
  if (q.kind != CutKind::kFinish || wall || !upright || m.holds<model::FreeformFinishMilling>(step.operation))
    return;
  q.wall_error_limit_mm = q.deflection_limit_mm;
  q.deflection_limit_mm = tip_beside_wall_mm(q.wall_error_limit_mm);
}

/// Speed of a face mill whose edges lean outwards: it counts where they leave the material.
void count_speed_at_top(optimise::CutQuestion& q) {
  const double widest = tooling::widest_circle_mm(q.cutter, q.depth_mm);
  if (widest > q.cutter.cutting_diameter_mm) q.speed_diameter_mm = widest;
}

/// Largest cutting force that the workholding holds, N; 0: unknown. Applies to milling cuts whose technology
/// planning chooses: the thrust of a drill acts down into the table. A given cut is kept; the check reports
/// it where it exceeds the holding force.
double most_force_n(const PlanSoFar& p, const StepDraft& step, const optimise::CutQuestion& q) {
  if (!step.open_technology || !optimise::is_milling(q.kind) || step.setup >= p.setups.size()) return 0.0;
  return p.setups[step.setup].holding.holding_force_n / mechanics::kHoldingForceSafety;
}

/// The widest cut that the feature offers: a slot's width, a pocket's narrower side.
double width_of(const model::FeatureShape& s) {
  if (model::has(s.kind, model::ShapeTrait::kRound)) return s.diameter.nominal_mm;
  if (s.kind == ShapeKind::kSlot) {
    double half = 0.5 * s.width.nominal_mm;
    for (const geometry::Vec2 p : s.slot_profile) half = std::max(half, p.y);
    return 2.0 * half;
  }
  if (s.area.empty()) return 0.0;
  const auto b = geometry::bounds(s.area);
  return std::min(b.hi.x - b.lo.x, b.hi.y - b.lo.y);
}

/// True if the wall leans from its upper edge on, so that no level may be deep.
bool leans_at_top(const model::FeatureShape& s) {
  constexpr double kSteep = 0.05;  // tangent of the lean, as good as upright; default, unsourced
  if (!leaves_terraces(s)) return false;
  if (s.kind == ShapeKind::kHole)
    return s.diameter.nominal_mm - s.bottom_diameter_mm > 2.0 * kSteep * s.depth_mm;
  const auto n = s.slot_profile.size();
  if (n < 2) return false;
  const geometry::Vec2 rise = s.slot_profile[n - 1] - s.slot_profile[n - 2];
  return rise.y > kSteep * rise.x;
}

/// Speed and feed of a cone that is not in as wide as it is: at its point the material passes more slowly,
/// and a tooth takes less. Speed counts at the widest circle that cuts. A feed that nobody states for this
/// very tool is a share of the diameter (tooling/data/cutters.yaml), and so of that circle's. Source of the
/// first: short spots run at the speed of their small circle, as chamfer mills do (myshopmetrics.com, wiki,
/// drilling, spot drills).
void start_at_point(optimise::CutQuestion& q, double wanted_vc_m_min) {
  const double d = q.cutter.cutting_diameter_mm;
  if (!(q.engaged_diameter_mm > 0.0) || q.engaged_diameter_mm >= d) return;
  q.speed_diameter_mm = q.engaged_diameter_mm;
  q.vc_start_m_min = std::max(q.vc_start_m_min, wanted_vc_m_min);
  const auto* own = model::preset_of(q.cutter, q.material, false);
  if (own == nullptr || !(own->fz_mm > 0.0) || model::nobodys(*own)) {
    const double least = q.cutter.fz_min_mm * q.engaged_diameter_mm / d;
    q.fz_start_mm = std::max(least, q.fz_start_mm * q.engaged_diameter_mm / d);
  }
}

/// Depth of a level at most where it begins with the cutter's whole width in the solid, between walls: rings
/// with a slot, constant engagement with a bore along a helix; 0: it does not begin so.
double deepest_slot_mm(const optimise::CutQuestion& q, const toolpath::PathJob& job) {
  const bool walled = model::has(job.shape.kind, model::ShapeTrait::kWalled);
  const bool hollow = job.left_on_side_mm || job.cleared_by ||
                      job.previous_diameter_mm.value_or(0.0) >= q.cutter.cutting_diameter_mm;
  // Narrow passes begin from an open side in the air; rings cut a slot there.
  const bool from_air = q.constant_engagement && job.shape.open;
  if (q.kind != CutKind::kRough || !walled || hollow || from_air) return 0.0;
  const model::Ramp ramp = model::ramp_of(q.cutter, q.material);
  return q.constant_engagement ? ramp.bore_depth_mm : ramp.slot_depth_mm;
}

AnyRef technology_of(const PlanSoFar& p, const StepDraft& step) {
  const auto* op = p.plan.model.get<model::MachiningOperation>(step.operation);
  return op != nullptr ? AnyRef(op->its_technology) : AnyRef{};
}

bool override_locked(const PlanSoFar& p, const StepDraft& step) {
  const auto* t = p.plan.model.get<model::MillingTechnology>(technology_of(p, step));
  return (step.proposed && step.proposal.lock_override) ||
         (t != nullptr && t->inhibit_feedrate_override.value_or(false));
}

/// True if planning chose the feed, now or when the plan was made. Such a feed keeps its margins when it is
/// planned again. A feed that was edited since counts as given.
bool feed_by_planning(const PlanSoFar& p, const StepDraft& step) {
  const AnyRef technology = technology_of(p, step);
  if (!technology.set()) return false;
  for (const char* name : {"feedrate", "feedrate_per_tooth"}) {
    const auto* d = p.plan.ledger.find(technology, name);
    if (model::by_planning(d) && d->state == model::DecisionState::kBound) return true;
  }
  return false;
}

/// Depth, width and start feed of a cut under an overhang, whose sections are not measured along the path.
/// Depth is the head's full height. The start feed is halved because chips cannot leave upwards (the half is
/// a default, unsourced). If the mouth was milled before, the width is what the head cuts beside it: both
/// edges at once in the middle, less when it moves aside. Else it is a slot of the head's diameter.
void under_an_overhang(optimise::CutQuestion& q, const toolpath::PathJob& job) {
  constexpr double kFeedShare = 0.5;
  const model::Cutter& c = job.cutter;
  const double d = c.cutting_diameter_mm;
  q.kind = CutKind::kRough;
  q.slot = true;
  q.ap_mm = c.cutting_width_mm > 0.0 ? c.cutting_width_mm : c.maximum_depth_of_cut_mm;
  q.depth_mm = *q.ap_mm;
  q.ae_mm = q.width_mm = d;
  q.fz_start_mm *= kFeedShare;
  const auto u = toolpath::undercut_of(job.shape);
  if (!u || !job.left_on_side_mm) return;
  q.slot = false;
  q.ae_mm = q.width_mm = toolpath::undercut_width_mm(job, *u);
}

/// Where a thin last pass makes the walls under an overhang, the others may bend the neck within it.
void bend_within_last_pass(optimise::CutQuestion& q, const toolpath::PathJob& job) {
  const double left = last_width_under_overhang_mm(job, 0.0);
  if (left > 0.0 && !q.slot)
    q.deflection_limit_mm =
        std::max(q.deflection_limit_mm,
                 bending_in_allowance_mm(std::min(left, toolpath::kLastSide), q.cutter, q.material));
}

/// The operator's limits on feed and speed, as if the machine did no more.
void hold_to_edits(const StepDraft& step, optimise::CutQuestion& q) {
  if (const auto most = step.limits.feed_mm_min) {
    for (auto& axis : q.machine.axes)
      axis.feed_max_mm_min = axis.feed_max_mm_min > 0.0 ? std::min(axis.feed_max_mm_min, *most) : *most;
  }
  if (const auto most = step.limits.speed_rpm) {
    double& rpm = q.machine.spindle.rpm_max;
    rpm = rpm > 0.0 ? std::min(rpm, *most) : *most;
  }
}

}  // namespace

double engaged_diameter_mm(TypeId operation, const model::Cutter& c, std::optional<double> depth_mm) {
  const bool cone = model::has(operation, model::OperationTrait::kConeTip);
  if (!cone || !(depth_mm.value_or(0.0) > 0.0) || !(c.point_angle_rad > 0.0)) return 0.0;
  return c.tip_diameter_mm + 2.0 * *depth_mm * std::tan(0.5 * c.point_angle_rad);
}

double engaged_diameter_mm(TypeId operation, const model::Cutter& c, std::optional<double> depth_mm,
                           const model::FeatureShape& s) {
  const double stated = engaged_diameter_mm(operation, c, depth_mm);
  const bool sinks = operation == TypeId::kCounterSinking && s.kind == ShapeKind::kHole;
  if (stated > 0.0 || !sinks || !(c.point_angle_rad > 0.0)) return stated;
  return s.diameter.middle();
}

double stated_zone_mm(const model::FeatureShape& s) {
  double width = 0.0;
  for (const auto& t : {s.width, s.length, s.diameter}) {
    if (t.given && t.width() > 0.0) width = width > 0.0 ? std::min(width, t.width()) : t.width();
  }
  return width;
}

double zone_across_mm(const Model& m, AnyRef feature, const model::FeatureShape& s, double width_mm,
                      const std::optional<model::GeneralTolerance>& general) {
  const double stated = tolerance_of(m, feature, s);
  if (stated > 0.0) return stated;
  return width_mm > 0.0 ? general_zone_mm(general, width_mm) : 0.0;
}

double bending_in_allowance_mm(double left_mm, const model::Cutter& c, const model::WorkMaterial& material) {
  const bool hss = c.substrate == model::Substrate::kHss;
  const double least = mechanics::least_depth_mm(c.cutting_diameter_mm, hss, material.iso_group);
  return std::max(0.5 * left_mm, left_mm - least);
}

double bending_of_last_rough_mm(double zone_mm) {
  return zone_mm > 0.0 ? std::max(kLeastDeflection, kWallOfZone * zone_mm) : kFinishDeflection;
}

double bending_of_finish_mm(double zone_mm) {
  return zone_mm > 0.0 ? std::max(kLeastDeflection, kDeflectionShare * zone_mm) : kFinishDeflection;
}

double tip_beside_wall_mm(double wall_error_mm) {
  return std::max(kWallOfZone / kDeflectionShare * wall_error_mm, mechanics::kQuietDeflectionMm);
}

bool cuts_under_overhang(const model::Cutter& c) {
  return model::has(c.cutter_class, model::CutterTrait::kUndercuts) &&
         model::has(c.cutter_class, model::CutterTrait::kNecked);
}

double last_width_under_overhang_mm(const toolpath::PathJob& job, double bent_mm) {
  if (job.shape.kind == ShapeKind::kHole)
    return job.hole_above_mm > 0.0 && toolpath::cuts_from_below(job) ? toolpath::last_circle_mm(job, bent_mm)
                                                                     : 0.0;
  const auto u = toolpath::undercut_of(job.shape);
  const double left = u ? toolpath::last_side_mm(job, *u) : 0.0;
  return left > 0.0 ? std::min(left + bent_mm, job.cutter.cutting_diameter_mm) : 0.0;
}

double bending_of_last_pass_mm(const PlanSoFar& p, const StepDraft& step, const toolpath::PathJob& job,
                               const optimise::CutQuestion& q) {
  if (job.allowance_side_mm > 0.0) return rough_bending_mm(p, step, job, q);
  return bending_of_finish_mm(zone_across(p, step, job, width_of(job.shape)));
}

bool leaves_terraces(const model::FeatureShape& s) {
  const bool narrows = s.kind == ShapeKind::kHole && s.bottom_diameter_mm > 0.0 &&
                       s.bottom_diameter_mm < s.diameter.nominal_mm - 1e-6;
  return narrows || (s.kind == ShapeKind::kSlot && !s.slot_profile.empty());
}

optimise::CutQuestion hole_question(const model::Plan& plan, double margin_deviations,
                                    const model::ProposedStep& step, const model::FeatureShape& shape,
                                    const model::Candidate& c) {
  optimise::CutQuestion q;
  q.cutter = c.cutter;
  q.material = plan.material;
  q.machine = plan.machine;
  q.margin_deviations = margin_deviations;
  take_axial_law(step.operation, q);
  q.vc_start_m_min = c.vc_m_min;
  q.fz_start_mm = c.fz_mm;
  q.pre_hole_mm = step.start_diameter_mm;
  q.least_feed_ratio = optimise::kLeastDrillFeed;
  q.override_locked = step.lock_override;
  q.engaged_diameter_mm = engaged_diameter_mm(step.operation, c.cutter, step.depth_mm, shape);
  start_at_point(q, tooling::start_values(c.cutter, plan.material, plan.machine).wanted_vc_m_min);
  return q;
}

optimise::CutQuestion question_of(const PlanSoFar& p, const StepDraft& step,
                                  const model::Candidate* candidate, const toolpath::PathJob& job) {
  const Model& m = p.plan.model;
  optimise::CutQuestion q;
  q.cutter = step.cutter;
  q.material = p.plan.material;
  q.machine = p.plan.machine;
  q.margin_deviations = p.wishes.margin_deviations;
  q.kind = kind_of(m, step.operation, step.cutter);
  if (q.kind == CutKind::kAxial) take_axial_law(step.operation.type, q);
  q.aim = p.wishes.aim;
  q.earning_per_min = p.wishes.earning_per_min;
  const auto start = tooling::start_values(step.cutter, p.plan.material, p.plan.machine);
  q.vc_table_m_min = start.wanted_vc_m_min;
  if (candidate != nullptr) {
    q.vc_start_m_min = candidate->vc_m_min;
    q.fz_start_mm = candidate->fz_mm;
  } else {
    q.vc_start_m_min = start.vc_m_min;
    q.fz_start_mm = start.fz_mm;
  }
  // What is milled through is cut below its bottom, inside by the cutter's corner, too (region/area.cpp), and
  // levels are divided over all of that.
  const double corner = job.shape.kind == ShapeKind::kOutside ? 0.0 : step.cutter.corner_radius_mm;
  const double below = job.shape.through && q.kind != CutKind::kAxial ? job.break_through_mm + corner : 0.0;
  const double bottom = job.feature_in_setup.origin.z - job.shape.depth_mm - below + job.allowance_bottom_mm;
  q.depth_mm = std::max(0.0, job.start_z_mm - bottom);
  q.width_mm = width_of(job.shape);
  q.slot = model::has(job.shape.kind, model::ShapeTrait::kWalled) && q.width_mm > 0.0 &&
           q.width_mm <= kAsWide * step.cutter.cutting_diameter_mm;
  q.constant_engagement = job.constant_engagement && q.kind == CutKind::kRough;
  q.pre_hole_mm = job.previous_diameter_mm.value_or(0.0);
  q.engaged_diameter_mm =
      engaged_diameter_mm(step.operation.type, step.cutter, job.cutting_depth_mm, job.shape);
  start_at_point(q, start.wanted_vc_m_min);
  count_speed_at_top(q);
  const double d = step.cutter.cutting_diameter_mm;
  if (job.axial_depth_mm > 0.0) q.ap_mm = job.axial_depth_mm;
  // The finishing pass cuts the terraces that the levels leave on a slope.
  const bool surface = m.holds<model::FreeformOperation>(step.operation);
  const bool terraces = job.allowance_side_mm > 0.0 && leans_at_top(job.shape);
  if ((surface || terraces) && q.kind == CutKind::kRough)
    q.ap_most_mm = (surface ? kSurfaceShare : kTerraceShare) * d;
  // Across the floor a finishing pass steps as given; what it takes from the wall is what roughing left.
  const bool rough = q.kind != CutKind::kFinish;
  if (rough && job.radial_depth_mm > 0.0) {
    q.ae_mm = job.radial_depth_mm;
  } else if (rough && job.overlap && !step.proposed) {
    q.ae_mm = std::max(0.0, 1.0 - *job.overlap) * d;
  }
  if (q.kind == CutKind::kRough) q.deflection_limit_mm = rough_bending_mm(p, step, job, q);
  if (q.kind == CutKind::kFinish) {
    // Width: the allowance that the step before left on the walls, and what it left beside by its bending; if
    // unknown, the usual finishing allowance.
    q.width_mm = std::max(0.05, job.left_on_side_mm.value_or(0.5) - job.allowance_side_mm);
    if (job.left_on_side_mm) q.width_mm += left_by_bending_mm(p, step);
    q.deflection_limit_mm = bending_of_finish_mm(zone_across(p, step, job, width_of(job.shape)));
    // A semi-finishing pass may bend as a rough one: the tolerance is for the next step.
    if (job.allowance_side_mm > 0.0) q.deflection_limit_mm = rough_bending_mm(p, step, job, q);
    // A semi-finishing pass of a surface may bend within the allowance it leaves.
    if (m.holds<model::FreeformFinishMilling>(step.operation) && job.allowance_bottom_mm > 0.0)
      q.deflection_limit_mm = std::max(q.deflection_limit_mm, kDeflectionShare * job.allowance_bottom_mm);
    if (model::mills_threads(step.cutter.cutter_class)) {
      const ThreadBound bound = thread_bound(step.cutter, job.shape);
      q.width_mm = bound.ae_mm;
      q.ap_mm = bound.ap_mm;
      q.fz_start_mm *= bound.centre_share;
    }
  }
  // A ball as wide as a round slot, milling it into the solid, cuts as in roughing; its deflection limit
  // stays.
  if (q.kind == CutKind::kFinish && job.shape.kind == ShapeKind::kSlot && !job.left_on_side_mm &&
      model::has(step.cutter.cutter_class, model::CutterTrait::kBall) && width_of(job.shape) <= kAsWide * d) {
    q.kind = CutKind::kRough;
    q.slot = true;
    q.ae_mm = q.width_mm = d;
  }
  const bool floor_only =
      job.multiple_passes.has_value() && !*job.multiple_passes && job.left_on_bottom_mm.value_or(0.0) > 0.0;
  if (q.kind == CutKind::kFinish && floor_only) {
    // A floor alone: as wide as a rough pass, as deep as what is left on it.
    q.kind = CutKind::kRough;
    q.width_mm = width_of(job.shape);
    q.depth_mm = std::max(0.0, *job.left_on_bottom_mm - job.allowance_bottom_mm);
    q.ap_mm = q.depth_mm;
  } else if (q.kind == CutKind::kFinish && job.cleared_by) {
    // Between two right-angled corners of radius R and r, at most (sqrt 2 - 1)(R - r) of material is left.
    q.width_mm += 0.41422 * std::max(0.0, 0.5 * (job.cleared_by->diameter_mm - d));
    q.width_mm = std::min(q.width_mm, d);
  }
  const bool under = cuts_under_overhang(step.cutter);
  if (under) under_an_overhang(q, job);
  if (q.slot && job.shape.kind == model::ShapeKind::kHole && toolpath::cuts_from_below(job)) {
    const auto most = toolpath::back_cut(job);
    q.slot = false;
    q.ap_mm = q.depth_mm = most.ap_mm;
    q.ae_mm = q.width_mm = most.ae_mm;
  }
  if (under) bend_within_last_pass(q, job);
  const bool cone = model::has(step.cutter.cutter_class, model::CutterTrait::kSinks);
  // A broken edge: as wide as it is deep.
  if (cone && q.kind == CutKind::kFinish && q.ap_mm) q.width_mm = std::max(0.05, *q.ap_mm);
  // A hole's cone, in one cut: as deep and as wide as it is.
  const double narrowing = job.shape.diameter.nominal_mm - job.shape.bottom_diameter_mm;
  if (cone && q.kind == CutKind::kFinish && !q.ap_mm && job.shape.kind == ShapeKind::kHole &&
      narrowing > 0.0) {
    q.ap_mm = q.depth_mm = job.shape.depth_mm;
    q.width_mm = 0.5 * narrowing;
  }
  if (const double slot = deepest_slot_mm(q, job); slot > 0.0 && !q.ap_mm)
    q.ap_most_mm = q.ap_most_mm > 0.0 ? std::min(q.ap_most_mm, slot) : slot;
  hold_quality(p, step, job, q);
  q.peak_force_limit_n = most_force_n(p, step, q);
  q.override_locked = override_locked(p, step);
  hold_to_edits(step, q);
  const auto given = given_technology(m, step.operation, step.cutter);
  if ((!step.open_technology || step.keep_speed) && given.rpm) q.n_rpm = std::abs(*given.rpm);
  if (!step.open_technology) {
    q.feed_mm_min = given.feed_mm_min;
    q.feed_by_planning = feed_by_planning(p, step);
  } else if (step.keep_feed) {
    const auto* t = m.get<model::MillingTechnology>(technology_of(p, step));
    if (t->feedrate && *t->feedrate > 0.0) {
      q.feed_mm_min = t->feedrate;
    } else {
      q.fz_mm = t->feedrate_per_tooth;
    }
  }
  return q;
}

}  // namespace capstan::step
