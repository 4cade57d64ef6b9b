#include "planner/making/propose/operation_nouns.h"

#include <algorithm>
#include <string>
#include <utility>

#include "casebase/planned.h"
#include "planner/ground/base/number.h"
#include "planner/making/piece/surroundings.h"
#include "planner/making/step/cut/preferences.h"
#include "planner/model/nouns/all.h"
#include "planner/model/nouns/arena/walk.h"
#include "tooling/library/nouns/nouns.h"

// Proposed steps as nouns: workingstep, operation, strategy, tool, technology, functions, and who bound them.

namespace capstan::propose {
namespace {

using model::AnyRef;
using model::Binder;
using model::DecisionKey;
using model::Model;
using model::Reason;
using model::Ref;
using model::TypeId;

constexpr double kRetract = 5.0;  // retract plane above the material over a feature, mm; default, unsourced

/// The coolant of a step, or the next best that the machine has: mist for flood, else none.
struct Coolant {
  bool flood = false, mist = false, through = false;
  std::string instead;  ///< coolant used and coolant wanted, in words; empty: as wanted
};

Coolant coolant_on(const model::Machine& machine, const model::ProposedStep& step) {
  Coolant out{step.coolant, false, step.coolant_through, {}};
  if (!out.flood || machine.has_flood) return out;
  out.flood = false;
  out.mist = machine.has_mist;
  out.instead =
      "machine '" + machine.id + "' has no flood coolant: " + (out.mist ? "cut with mist" : "cut dry");
  return out;
}

Ref<model::MachineFunctions> functions(Model& m, const Coolant& want, Job& job) {
  for (const AnyRef r : m.all(TypeId::kMillingMachineFunctions)) {
    const auto* f = m.get<model::MillingMachineFunctions>(r);
    if (m.origin(r).instance == 0 && f->coolant == want.flood && f->through_spindle_coolant == want.through &&
        f->mist.value_or(false) == want.mist)
      return Ref<model::MachineFunctions>(r);
  }
  if (!want.instead.empty()) job.warn("PIP-CHANGED", want.instead);
  model::MillingMachineFunctions f;
  f.coolant = want.flood;
  if (want.mist) f.mist = true;
  f.through_spindle_coolant = want.through;
  f.chip_removal = false;
  f.axis_clamping.given = true;
  f.other_functions.given = true;
  return m.add(f);
}

Ref<model::Technology> technology(Model& m, bool lock_override) {
  model::MillingTechnology t;
  t.feedrate_reference = model::ToolReferencePoint::kTcp;
  t.synchronize_spindle_with_feed = false;
  t.inhibit_feedrate_override = lock_override;
  t.inhibit_spindle_override = lock_override;
  return m.add(t);
}

Ref<model::Two5dMillingStrategy> strategy(Model& m, const model::ProposedStep& step) {
  const auto mode = step.climb ? model::CutmodeType::kClimb : model::CutmodeType::kConventional;
  switch (step.strategy) {
    case model::StrategyKind::kBidirectional:
      return m.add(model::BidirectionalMilling{});
    case model::StrategyKind::kUnidirectional: {
      model::UnidirectionalMilling s;
      s.cutmode = mode;
      return m.add(s);
    }
    case model::StrategyKind::kContourParallel: {
      model::ContourParallel s;
      s.cutmode = mode;
      return m.add(s);
    }
    case model::StrategyKind::kContourSpiral: {
      model::ContourSpiral s;
      s.cutmode = mode;
      return m.add(s);
    }
    case model::StrategyKind::kContourBidirectional:
      return m.add(model::ContourBidirectional{});
    case model::StrategyKind::kCenterMilling:
      return m.add(model::CenterMilling{});
    case model::StrategyKind::kNone:
      break;
  }
  return {};
}

void fill_milling(Model& m, AnyRef op, const model::ProposedStep& step) {
  if (auto* o = m.get<model::Two5dMillingOperation>(op)) {
    const auto made = strategy(m, step);
    if (auto* s = m.get<model::Two5dMillingStrategy>(made); s != nullptr && step.one_level)
      s->allow_multiple_passes = false;
    o->its_machining_strategy = made;
  }
  if (auto* o = m.get<model::PlaneMilling>(op)) o->allowance_bottom = step.allowance_bottom_mm;
  if (auto* o = m.get<model::SideMilling>(op)) {
    o->allowance_side = step.allowance_side_mm;
    if (step.axial_depth_mm > 0.0) o->axial_cutting_depth = step.axial_depth_mm;
  }
  if (auto* o = m.get<model::BottomAndSideMilling>(op)) {
    o->allowance_side = step.allowance_side_mm;
    o->allowance_bottom = step.allowance_bottom_mm;
    if (step.axial_depth_mm > 0.0) o->axial_cutting_depth = step.axial_depth_mm;
  }
}

/// Parallel passes at the usual tolerances.
Ref<model::FreeformStrategy> passes(Model& m, const model::ProposedStep& step) {
  model::Tolerances t;
  const double within = step::freeform_ridges_mm(step);
  t.chordal_tolerance = within;
  t.scallop_height = within;
  model::Direction across;
  across.name = "";
  across.direction_ratios = {{0.0, 1.0, 0.0}, true};
  model::PlaneClStrategy s;
  s.pathmode = model::PathmodeType::kZigzag;
  s.cutmode = step.climb ? model::CutmodeType::kClimb : model::CutmodeType::kConventional;
  s.its_milling_tolerances = m.add(t);
  s.its_plane_normal = m.add(across);
  return m.add(s);
}

void fill_drilling(Model& m, AnyRef op, const model::ProposedStep& step) {
  auto* o = m.get<model::DrillingTypeOperation>(op);
  if (o == nullptr) return;
  if (step.depth_mm > 0.0) o->cutting_depth = step.depth_mm;
  if (step.start_diameter_mm > 0.0) o->previous_diameter = step.start_diameter_mm;
  if (step.dwell_s > 0.0) o->dwell_time_bottom = step.dwell_s;
  if (auto* s = m.get<model::MultistepDrilling>(op)) {
    // Out of the hole to just above the material, or up a little to break the chip. The first two diameters
    // are drilled before pecks begin (Kennametal-Greenfield IPG, technical tips, iowamidland.com); then by
    // one diameter, a common default, unsourced.
    const double d =
        step.tool.diameter_exact_mm > 0.0 ? step.tool.diameter_exact_mm : step.tool.diameter_max_mm;
    s->first_depth = 2.0 * d;
    s->depth_of_step = d;
    s->retract_distance = step.peck_retract_mm;
  }
  if (!step.tool.classes.empty() && step.tool.classes.front() == model::CutterClass::kGunDrill) {
    // Into its pilot a gun drill turns slowly; defaults, unsourced.
    model::DrillingTypeStrategy slow;
    slow.reduced_cut_at_start = 0.3;
    slow.reduced_feed_at_start = 0.3;
    slow.depth_of_start = 1.5 * step.tool.diameter_exact_mm;
    const auto made = m.add(slow);
    m.get<model::DrillingTypeOperation>(op)->its_machining_strategy = made;
  }
  if (auto* b = m.get<model::BoringOperation>(op)) b->spindle_stop_at_bottom = false;
  if (auto* t = m.get<model::Tapping>(op)) t->compensation_chuck = false;
  if (auto* t = m.get<model::ThreadDrilling>(op)) t->helical_movement_on_forward = true;
}

}  // namespace

Ref<model::MachiningWorkingstep> add_nouns(model::Plan& plan, const model::ProposedStep& step,
                                           const model::Candidate& tool, const model::FeatureShape& shape,
                                           std::vector<model::Rejected> rejected_chains,
                                           std::vector<model::Rejected> rejected_tools, Job& job) {
  Model& m = plan.model;
  model::Ledger& ledger = plan.ledger;
  const AnyRef op = m.add_object(step.operation);
  const auto made_tool = tooling::tool_noun(m, tool.cutter);
  const auto made_technology = technology(m, step.lock_override);
  const Coolant coolant = coolant_on(plan.machine, step);
  const auto made_functions = functions(m, coolant, job);
  auto* o = m.get<model::MachiningOperation>(op);
  o->its_id = step.name;
  o->its_tool = made_tool;
  o->its_technology = made_technology;
  o->its_machine_functions = made_functions;
  fill_milling(m, op, step);
  fill_drilling(m, op, step);
  if (m.holds<model::FreeformOperation>(op)) {
    const auto strategy = passes(m, step);
    m.get<model::FreeformOperation>(op)->its_machining_strategy = strategy;
  }
  // The retract plane counts from the feature's top; the raw piece may be higher.
  m.get<model::MachiningOperation>(op)->retract_plane =
      piece::raw_above(plan.stock.box, shape.frame) + kRetract;

  model::MachiningWorkingstep ws;
  ws.its_id = step.name;
  ws.its_feature = Ref<model::ManufacturingFeature>(step.feature);
  ws.its_operation = Ref<model::MachiningOperation>(op);
  const auto made = m.add(ws);
  if (auto* f = m.get<model::ManufacturingFeature>(step.feature)) {
    f->its_operations.push_back(Ref<model::MachiningOperation>(op));
  }

  const DecisionKey chain{made, "its_operation"};
  ledger.bind(made, "its_operation", Binder::kRule, step.why, {}, std::move(rejected_chains));
  ledger.bind(op, "its_tool", Binder::kToolSelection, tool.why, {chain}, std::move(rejected_tools));
  for (const char* name : {"its_machining_strategy", "axial_cutting_depth", "allowance_side",
                           "allowance_bottom", "cutting_depth", "previous_diameter", "dwell_time_bottom",
                           "first_depth", "depth_of_step", "retract_distance", "its_machine_functions"}) {
    const auto* a = model::find_attribute(op.type, name);
    if (a != nullptr && model::has_value(*a, m.object(op)))
      ledger.bind(op, name, Binder::kRule, step.why, {chain});
  }
  if (!coolant.instead.empty())
    ledger.bind(op, "its_machine_functions", Binder::kRule,
                {"machine.coolant", step.why.text + "; " + coolant.instead, "the machine's own description"},
                {chain});
  ledger.bind(
      op, "retract_plane", Binder::kDefault,
      {"default.retract_plane", trimmed(kRetract, 3) + " mm above the raw piece", "default, unsourced"});
  return made;
}

casebase::Coolant coolant_of(const model::Machine& machine, const model::ProposedStep& step) {
  const Coolant c = coolant_on(machine, step);
  model::StepResult step_with;
  step_with.flood = c.flood;
  step_with.mist = c.mist;
  step_with.through = c.through;
  return casebase::coolant_of(step_with);
}

}  // namespace capstan::propose
