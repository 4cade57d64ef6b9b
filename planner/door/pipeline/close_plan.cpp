#include <algorithm>
#include <optional>
#include <set>
#include <utility>

#include "planner/controls/controls.h"
#include "planner/door/pipeline/stages.h"
#include "planner/door/pipeline/tools/sisters.h"
#include "planner/making/given/machine_needs.h"
#include "planner/making/given/tool_material.h"
#include "planner/making/piece/corner_rests.h"
#include "planner/making/piece/raw_piece_limits.h"
#include "planner/making/step/record/expected_by_cases.h"
#include "planner/making/step/record/other_classes.h"
#include "planner/making/step/record/worn_edges.h"
#include "planner/model/plan/decision/reopen_all.h"
#include "planner/model/plan/order/step_ids.h"
#include "tooling/library/nouns/nouns.h"
#include "tooling/selection/select.h"

// The last stage: set-ups, tools and names of a plan whose steps are made.

namespace capstan::pipeline {
namespace {

using draft::StepDraft;

/// The steps that the plan executes, where it has paths: one that was left out needs no tool, nor what was to
/// be measured before it.
bool executed(const model::Plan& plan, const Policy& policy, const StepDraft& s) {
  if (policy.bind != Bind::kAll || plan.model.holds<model::WorkpieceProbing>(s.step)) return true;
  return std::any_of(plan.steps.begin(), plan.steps.end(),
                     [&](const model::StepResult& r) { return r.step == s.step; });
}

/// The cutters that steps use, each once, with their tool numbers.
std::vector<model::Cutter> cutters_of(const model::Plan& plan, const std::vector<StepDraft>& steps,
                                      const Policy& policy) {
  std::vector<model::Cutter> out;
  std::set<std::string> seen;
  for (const StepDraft& s : steps) {
    if (!(s.cutter.cutting_diameter_mm > 0.0) || !executed(plan, policy, s)) continue;
    if (seen.insert(s.cutter.id).second) {
      out.push_back(s.cutter);
      continue;
    }
    // The stick-out is what the deepest of its steps needs.
    for (model::Cutter& c : out) {
      if (c.id != s.cutter.id) continue;
      c.stick_out_mm = std::max(c.stick_out_mm, s.cutter.stick_out_mm);
      c.usable_length_mm = std::max(c.usable_length_mm, s.cutter.usable_length_mm);
    }
  }
  tooling::assign_pockets(out);
  return out;
}

/// Writes the plan's tool numbers into the nouns of the tools.
void state_tool_numbers(model::Plan& plan, const std::vector<StepDraft>& steps) {
  for (const StepDraft& s : steps) {
    const auto* op = plan.model.get<model::MachiningOperation>(s.operation);
    if (const auto* probing = plan.model.get<model::WorkpieceProbing>(s.step)) {
      const model::Cutter* c = model::find_cutter(plan, s.cutter.id);
      const auto* probe = plan.model.get<model::TouchProbe>(probing->its_probe);
      auto* usage = probe == nullptr ? nullptr : plan.model.get<model::ToolUsage>(probe->its_usage);
      if (c != nullptr && usage != nullptr) usage->its_position = std::to_string(c->pocket);
      continue;
    }
    auto* tool = op != nullptr ? plan.model.get<model::MachiningTool>(op->its_tool) : nullptr;
    const model::Cutter* c = model::find_cutter(plan, s.cutter.id);
    if (tool == nullptr || c == nullptr) continue;
    const auto position = std::to_string(c->pocket);
    if (auto* usage = plan.model.get<model::ToolUsage>(tool->its_usage)) {
      usage->its_position = position;
    }
  }
}

/// The set-ups with their work offsets.
Result<std::vector<model::SetupResult>> setups_of(const model::Plan& plan,
                                                  const std::vector<draft::SetupDraft>& setups) {
  // A control without a row gets no program; its set-ups are named as those of the first.
  const controls::Dialect* known = controls::find_dialect(plan.machine.control.dialect);
  const controls::Dialect& control = known != nullptr ? *known : *controls::dialects().front();
  const std::size_t count = control.work_offsets.size();
  if (setups.size() > count) {
    return fail("PIP-OFFSETS", std::to_string(setups.size()) + " set-ups, but " + std::string(control.name) +
                                   " has " + std::to_string(count) + " work offsets (" +
                                   std::string(control.work_offsets.front()) + " to " +
                                   std::string(control.work_offsets.back()) + "); split the part");
  }
  std::vector<model::SetupResult> out;
  for (std::size_t i = 0; i < setups.size(); ++i) {
    out.push_back(
        {setups[i].setup, std::string(control.work_offsets[i]), setups[i].security_z_mm, setups[i].holding});
  }
  return out;
}

/// Each executed step gets a name of its own that every file format carries.
void name_steps(model::Plan& plan) {
  const std::vector<std::string> ids = model::step_ids(plan);
  for (std::size_t i = 0; i < ids.size(); ++i) {
    auto* e = plan.model.get<model::Executable>(plan.steps[i].step);
    if (e != nullptr && !e->persistent_id) e->persistent_id = ids[i];
  }
}

/// Leaves open what the policy does not want bound: feeds and paths always, tools too when only operations
/// are wanted. A plan written like this is closed by a later bind.
void leave_open(model::Plan& plan, const std::vector<StepDraft>& steps, Bind bind) {
  std::vector<model::DecisionKey> open;
  for (const StepDraft& s : steps) {
    auto* op = plan.model.get<model::MachiningOperation>(s.operation);
    if (op == nullptr) continue;
    if (s.open_technology) {
      const AnyRef technology = op->its_technology;
      if (auto* t = plan.model.get<model::MillingTechnology>(technology); t != nullptr && s.proposed) {
        t->feedrate.reset();
        t->spindle.reset();
      }
      if (technology.set() && !s.keep_feed) open.push_back({technology, "feedrate"});
      if (technology.set() && !s.keep_speed) open.push_back({technology, "spindle"});
    }
    if (bind == Bind::kStrategy && s.proposed) {
      const auto wanted = tooling::nouns_from_requirement(plan.model, s.proposal.tool);
      plan.model.get<model::MachiningOperation>(s.operation)->its_tool = wanted;
      open.push_back({s.operation, "its_tool"});
    }
  }
  model::reopen_all(plan.ledger, open);
}

}  // namespace

Result<model::Plan> close_plan(model::Plan plan, const Drafts& drafts, const Required& required,
                               const Asked& asked, Job& job) {
  const Bind bind = asked.policy.bind;
  if (bind == Bind::kAll || bind == Bind::kTools) {
    plan.cutters = cutters_of(plan, drafts.steps, asked.policy);
    state_tool_numbers(plan, drafts.steps);
    std::stable_sort(plan.cutters.begin(), plan.cutters.end(),
                     [](const auto& a, const auto& b) { return a.pocket < b.pocket; });
    plan.cutters = given::loaded_of(plan, asked.inputs.library, job);
    for (model::Provenance& row : given::assumed_materials_of(plan, job))
      plan.provenance.push_back(std::move(row));
  }
  if (bind == Bind::kAll) {
    const piece::Piece piece{plan, required.shapes, grown_mm(asked.inputs)};
    share_among_sisters(plan, asked.inputs.library, restrictions_of(asked.inputs), job);
    step::tell_edges(plan, asked.inputs.cases.get(), job);
    step::tell_other_classes(plan, asked.inputs.cases.get(), job);
    given::state_machine_needs(plan);
    plan.provenance = piece::settled_corner_rests(piece, drafts.steps, job);
    piece::tell_corners(piece, drafts.steps, job);
  }
  if (bind != Bind::kAll && bind != Bind::kNone) leave_open(plan, drafts.steps, bind);
  auto setups = setups_of(plan, drafts.setups);
  if (!setups) return tl::unexpected(setups.error());
  plan.setups = *std::move(setups);
  plan.unplanned = with_what_rests(plan, drafts.setups);
  name_steps(plan);
  if (bind == Bind::kAll) {
    for (model::Provenance& row : step::tell_expected(plan, asked.inputs.cases.get(), job))
      plan.provenance.push_back(std::move(row));
  }
  return plan;
}

}  // namespace capstan::pipeline
