#include "planner/door/service/tuning/planned_limits.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "casebase/casebase.h"
#include "planner/ground/vocabulary/limit.h"
#include "planner/ground/vocabulary/operation.h"
#include "planner/making/optimise/cut.h"
#include "planner/making/step/cut/question.h"
#include "planner/model/features/quality.h"
#include "planner/model/features/shape.h"
#include "planner/model/nouns/all.h"
#include "planner/model/plan/preset_feeds.h"
#include "planner/physics/mechanics/force/force_law.h"
#include "planner/physics/mechanics/holding_constants.h"
#include "planner/physics/mechanics/life/life.h"
#include "planner/physics/mechanics/spindle.h"
#include "planner/physics/mechanics/stability.h"
#include "tooling/selection/select.h"

/// A plan states the limits that held each cut, not those that were far; here they are found again from what
/// the plan keeps: the holding force, the roughness asked, allowances, tolerances, spindle, axes and cutter.
/// Loads are the plan's own along the whole path, margin included, carried to another speed and feed by the
/// ratio of what the models say of a straight cut: slots, corners and the plan's margin are in them. What the
/// schedule of feeds slows down for on the way it slows down for again when the step is planned with other
/// values: there the straight cut of the step's depth and width counts, with the plan's margin. Where a
/// limit cannot be found again (a bending whose zone only the user's general tolerance states), what the path
/// has is the limit: the load may not grow.
namespace capstan::service {
namespace {

using casebase::tune::Setting;
using model::StepLoads;

constexpr double kBeyond = 2.0;  // of a limit: no speed or feed there may be proposed

/// The power of the spindle at a speed; 0: not known.
double power_at(const model::Machine& machine, double rpm) {
  const auto curve = mechanics::curve_of(machine.spindle);
  if (!curve) return 0.0;
  const auto capacity = curve->at(rpm);
  return capacity ? capacity->power_w : 0.0;
}

/// The zone that every shape of a feature states, the narrowest, mm; 0: one states none.
double zone_of(const model::Model& m, model::Ref<model::ManufacturingFeature> feature) {
  const auto shapes = model::shapes_of(m, feature);
  double zone = 0.0;
  if (!shapes) return zone;
  for (const model::FeatureShape& s : *shapes) {
    const double one = step::stated_zone_mm(s);
    if (!(one > 0.0)) return 0.0;
    zone = zone > 0.0 ? std::min(zone, one) : one;
  }
  return zone;
}

/// What tip and wall may be off by bending, mm, as step/cut/question.cpp has it of operations and allowances.
struct Bending {
  double tip_mm = 0.0, wall_mm = 0.0;
};
Bending bending_of(const model::Plan& plan, const model::MachiningWorkingstep& ws,
                   const casebase::Bound& bound, const model::Cutter& cutter, const StepLoads& on_path) {
  const Bending as_planned{on_path.deflection_mm, std::abs(on_path.wall_error_mm)};
  const model::Model& m = plan.model;
  if (m.holds<model::PlaneMilling>(ws.its_operation)) return {optimise::kFaceDeflectionMm, 0.0};
  if (m.holds<model::FreeformOperation>(ws.its_operation)) return as_planned;
  if (bound.allowance_side_mm > 0.0)
    return {step::bending_in_allowance_mm(bound.allowance_side_mm, cutter, plan.material), 0.0};
  const double zone = zone_of(m, ws.its_feature);
  if (!(zone > 0.0)) return as_planned;
  if (!model::has(ws.its_operation.type, model::OperationTrait::kFinishes))
    return {step::bending_of_last_rough_mm(zone), 0.0};
  const double wall = step::bending_of_finish_mm(zone);
  if (!model::has(cutter.cutter_class, model::CutterTrait::kEndMill)) return {wall, 0.0};
  // A floor alone, or a slot as wide as the tool, is held to the share itself: what the path has tells.
  return {on_path.deflection_mm > wall ? step::tip_beside_wall_mm(wall) : wall, wall};
}

/// The step's cut as a question: what it was bound to, and its limits.
optimise::CutQuestion question_of(const model::Plan& plan, const model::StepResult& step,
                                  const model::MachiningWorkingstep& ws, const casebase::Case& asked,
                                  const model::Cutter& cutter) {
  optimise::CutQuestion q;
  q.cutter = cutter;
  q.material = plan.material;
  q.machine = plan.machine;
  const bool finishes = model::has(ws.its_operation.type, model::OperationTrait::kFinishes);
  q.kind = finishes ? optimise::CutKind::kFinish : optimise::CutKind::kRough;
  q.slot = step.radial_depth_mm >= (1.0 - 1e-9) * cutter.cutting_diameter_mm;
  q.depth_mm = step.axial_depth_mm;
  q.width_mm = step.radial_depth_mm;
  // The most that a tooth may take is what the cutter bears; where nobody says what that is, the start value.
  const double borne = model::largest_tooth_feed_mm(cutter, plan.material);
  q.fz_start_mm = borne > 0.0 ? borne / optimise::feed_override(q)
                              : tooling::start_values(cutter, plan.material, plan.machine).fz_mm;
  if (finishes && !(asked.bound.allowance_side_mm > 0.0 && asked.bound.allowance_bottom_mm > 0.0))
    q.surface_ra_um = asked.asked.asked_ra_um;
  if (step.setup < plan.setups.size())
    q.peak_force_limit_n = plan.setups[step.setup].holding.holding_force_n / mechanics::kHoldingForceSafety;
  const Bending bending = bending_of(plan, ws, asked.bound, cutter, step.loads);
  q.deflection_limit_mm = bending.tip_mm;
  q.wall_error_limit_mm = bending.wall_mm;
  return q;
}

/// The loads that limits are held against.
struct LoadOf {
  double StepLoads::*load;
  bool of_force;  ///< the margin counts in it
  std::array<model::Limit, 2> limits;
};
constexpr LoadOf kLoads[] = {
    {&StepLoads::peak_force_n, true, {model::Limit::kPeakForce, model::Limit::kPeakForce}},
    {&StepLoads::torque_nm, true, {model::Limit::kSpindleTorque, model::Limit::kSpindlePower}},
    {&StepLoads::power_w, true, {model::Limit::kSpindleTorque, model::Limit::kSpindlePower}},
    {&StepLoads::deflection_mm, true, {model::Limit::kToolDeflection, model::Limit::kToolDeflection}},
    {&StepLoads::wall_error_mm, true, {model::Limit::kWallError, model::Limit::kWallError}},
    {&StepLoads::chip_thickness_mm, false, {model::Limit::kChipThickness, model::Limit::kChipThickness}},
    {&StepLoads::surface_rz_mm, false, {model::Limit::kSurfaceRoughness, model::Limit::kSurfaceRoughness}}};

/// Whether the plan's schedule slows down for one of these limits, and keeps it.
bool slows_for(const model::StepResult& step, const LoadOf& l) {
  const auto is = [&](const auto& limit) {
    return std::any_of(l.limits.begin(), l.limits.end(),
                       [&](model::Limit x) { return limit.name == model::row_of(x).name; });
  };
  return std::any_of(step.held_by.begin(), step.held_by.end(), is) &&
         std::none_of(step.exceeded.begin(), step.exceeded.end(), is);
}

/// The step's loads at another setting, of a straight cut `there` and as `planned`. Where the schedule slows
/// down for a limit it does so again: there the straight cut counts, with the plan's margin.
StepLoads carried(const model::StepResult& step, const StepLoads& there, const StepLoads& planned) {
  StepLoads out;
  const bool margins = step.loads.force_margin > 0.0 && there.force_margin > 0.0;
  const double margin = margins ? step.loads.force_margin / there.force_margin : 1.0;
  for (const LoadOf& l : kLoads) {
    const double on_path = step.loads.*l.load, straight = there.*l.load, before = planned.*l.load;
    const bool by_path = on_path != 0.0 && before != 0.0 && !slows_for(step, l);
    out.*l.load = std::abs(by_path ? on_path * straight / before : straight * (l.of_force ? margin : 1.0));
  }
  return out;
}

/// Whether the axes and the cutter run so fast, and without chatter where the machine's modes say so.
bool runs(const optimise::CutQuestion& q, double n_rpm, double feed_mm_min) {
  const auto above = [](double v, double most) { return most > 0.0 && v > most * (1.0 + 1e-9); };
  if (above(n_rpm, q.machine.spindle.rpm_max) || above(n_rpm, q.cutter.maximum_speed_rpm)) return false;
  for (std::size_t axis = 0; axis < 2; ++axis) {
    if (above(feed_mm_min, q.machine.axes[axis].feed_max_mm_min)) return false;
  }
  if (mechanics::modes_for(q.machine, q.cutter.id).empty()) return true;
  optimise::CutQuestion given = q;
  given.vc_start_m_min = 1.0;  // not used: speed and feed are given
  given.ap_mm = q.depth_mm;
  given.ae_mm = q.width_mm;
  given.n_rpm = n_rpm;
  given.feed_mm_min = feed_mm_min;
  given.feed_by_planning = true;
  Job quiet;
  const auto answer = optimise::cut(given, {}, quiet);
  return answer && answer->feasible;
}

}  // namespace

Result<casebase::tune::PlannedStep> planned_step(const model::Plan& plan, const model::StepResult& step) {
  auto asked = casebase::case_of(plan, step);
  if (!asked) return tl::unexpected(asked.error());
  casebase::tune::PlannedStep out;
  out.step = *std::move(asked);
  const model::Cutter& cutter = *model::find_cutter(plan, step.cutter_id);  // case_of has found it
  const auto* ws = plan.model.get<model::MachiningWorkingstep>(step.step);
  out.force_margin = step.loads.force_margin;
  const bool milled = mechanics::is_milled(ws->its_operation.type, cutter);
  out.force_spread = (milled ? mechanics::force_margin(plan.material, cutter.substrate)
                             : mechanics::kienzle_margin(plan.material))
                         .spread;
  out.power_limit_w = mechanics::spindle_efficiency(plan.machine.spindle.efficiency) *
                      power_at(plan.machine, step.spindle_rpm);
  out.mc = plan.material.mc;
  out.taylor_n = mechanics::taylor_exponent(cutter.substrate);
  // Drills, reamers and taps are only ever lowered: their feeds are bound to depth and thread.
  if (!milled || !(step.axial_depth_mm > 0.0) || !(step.radial_depth_mm > 0.0)) return out;
  // A file that keeps no loads of its path tells nothing of how near its limits are: nothing is raised.
  if (!(step.loads.peak_force_n > 0.0) || !(step.loads.deflection_mm > 0.0)) return out;
  const optimise::CutQuestion q = question_of(plan, step, *ws, out.step, cutter);
  const auto loads_at = [q, n = step.spindle_rpm, fz = step.fz_mm](const Setting& s, double& rpm,
                                                                   double& feed) {
    rpm = n * std::exp(s.ln_vc);
    feed = rpm * std::max(1, q.cutter.teeth) * fz * std::exp(s.ln_fz);
    return optimise::loads_of(q, q.depth_mm, q.width_mm, rpm, feed);
  };
  double rpm = 0.0, feed = 0.0;
  const auto planned = loads_at({}, rpm, feed);
  if (!planned) return out;  // beyond the range of the formulas: nothing is raised
  out.hard = [q, loads_at, planned = *planned, step](const Setting& s) {
    double n = 0.0, vf = 0.0;
    const auto there = loads_at(s, n, vf);
    if (!there || !runs(q, n, vf)) return kBeyond;
    const double load = 1.0 + optimise::worst_excess(q, carried(step, *there, planned), n);
    // What a cutter bears is stated as the feed of a wide cut, and held as that but in narrow passes of
    // constant engagement, whose feed only the chip bounds (optimise/cut/search.cpp).
    const bool bounds = step.fz_mm <= q.fz_start_mm * (1.0 + 1e-9);
    return bounds ? std::max(load, step.fz_mm * std::exp(s.ln_fz) / q.fz_start_mm) : load;
  };
  return out;
}

}  // namespace capstan::service
