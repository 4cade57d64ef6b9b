#include <algorithm>
#include <optional>
#include <set>
#include <utility>

#include "planner/controls/controls.h"
#include "planner/door/pipeline/checked.h"
#include "planner/door/pipeline/given/machine_needs.h"
#include "planner/door/pipeline/paths/gone.h"
#include "planner/door/pipeline/profit.h"
#include "planner/door/pipeline/work.h"
#include "planner/making/piece/in_piece.h"
#include "planner/making/piece/workpiece.h"
#include "planner/model/plan/decision/contradicted.h"
#include "planner/model/plan/decision/unreadable.h"
#include "planner/model/plan/order/step_ids.h"
#include "planner/model/plan/range/positions.h"
#include "tooling/library/nouns/nouns.h"
#include "tooling/selection/select.h"

namespace capstan::pipeline {
namespace {

/// The steps that the plan executes, where it has paths: one that was left out needs no tool, nor what was to
/// be measured before it.
bool executed(const Work& w, const StepDraft& s) {
  if (w.policy.bind != Bind::kAll || w.plan.model.holds<model::WorkpieceProbing>(s.step)) return true;
  return std::any_of(w.plan.steps.begin(), w.plan.steps.end(),
                     [&](const model::StepResult& r) { return r.step == s.step; });
}

/// The cutters that steps use, each once, with their tool numbers; nouns say the same.
void collect_cutters(Work& w) {
  std::set<std::string> seen;
  for (const StepDraft& s : w.steps) {
    if (!(s.cutter.cutting_diameter_mm > 0.0) || !executed(w, s)) continue;
    if (seen.insert(s.cutter.id).second) {
      w.plan.cutters.push_back(s.cutter);
      continue;
    }
    // It stands out as far as the deepest of its steps needs.
    for (model::Cutter& c : w.plan.cutters) {
      if (c.id != s.cutter.id) continue;
      c.stick_out_mm = std::max(c.stick_out_mm, s.cutter.stick_out_mm);
      c.usable_length_mm = std::max(c.usable_length_mm, s.cutter.usable_length_mm);
    }
  }
  tooling::assign_pockets(w.plan.cutters);
  for (const StepDraft& s : w.steps) {
    const auto* op = w.plan.model.get<model::MachiningOperation>(s.operation);
    if (const auto* probing = w.plan.model.get<model::WorkpieceProbing>(s.step)) {
      const model::Cutter* c = model::find_cutter(w.plan, s.cutter.id);
      const auto* probe = w.plan.model.get<model::TouchProbe>(probing->its_probe);
      auto* usage = probe == nullptr ? nullptr : w.plan.model.get<model::ToolUsage>(probe->its_usage);
      if (c != nullptr && usage != nullptr) usage->its_position = std::to_string(c->pocket);
      continue;
    }
    auto* tool = op != nullptr ? w.plan.model.get<model::MachiningTool>(op->its_tool) : nullptr;
    const model::Cutter* c = model::find_cutter(w.plan, s.cutter.id);
    if (tool == nullptr || c == nullptr) continue;
    const auto position = std::to_string(c->pocket);
    if (auto* usage = w.plan.model.get<model::ToolUsage>(tool->its_usage)) {
      usage->its_position = position;
    }
  }
  std::stable_sort(w.plan.cutters.begin(), w.plan.cutters.end(),
                   [](const auto& a, const auto& b) { return a.pocket < b.pocket; });
}

Status collect_setups(Work& w) {
  // A control without a row gets no program; its set-ups are named as those of the first.
  const controls::Dialect* known = controls::find_dialect(w.inputs.machine.control.dialect);
  const controls::Dialect& control = known != nullptr ? *known : *controls::dialects().front();
  const std::size_t count = control.work_offsets.size();
  if (w.setups.size() > count) {
    return fail("PIP-OFFSETS", "the part needs " + std::to_string(w.setups.size()) + " set-ups, and " +
                                   std::string(control.name) + " has " + std::to_string(count) +
                                   " work offsets; plan it in parts");
  }
  for (std::size_t i = 0; i < w.setups.size(); ++i) {
    w.plan.setups.push_back({w.setups[i].setup, std::string(control.work_offsets[i]),
                             w.setups[i].security_z_mm, w.setups[i].holding});
  }
  return {};
}

/// Each executed step gets a name of its own that every file format carries.
void name_steps(Work& w) {
  const std::vector<std::string> ids = model::step_ids(w.plan);
  for (std::size_t i = 0; i < ids.size(); ++i) {
    auto* e = w.plan.model.get<model::Executable>(w.plan.steps[i].step);
    if (e != nullptr && !e->persistent_id) e->persistent_id = ids[i];
  }
}

/// Which chain and cutter made each proposed step, so that what a check says of it can be traced back.
void list_made(Work& w) {
  w.tries.made.clear();
  for (const StepDraft& s : w.steps) {
    if (!s.proposed) continue;
    w.tries.made[s.step] = {s.member,        s.chain,
                            s.in_chain,      s.cutter.id,
                            s.proposal.name, w.plan.model.holds<model::FreeformFinishMilling>(s.operation),
                            cut_around(w, s)};
  }
}

/// Leaves open what the policy does not want bound: feeds and paths always, tools too when only operations
/// are wanted. A plan written like this is closed by a later bind.
void leave_open(Work& w) {
  for (StepDraft& s : w.steps) {
    auto* op = w.plan.model.get<model::MachiningOperation>(s.operation);
    if (op == nullptr) continue;
    if (s.open_technology) {
      const AnyRef technology = op->its_technology;
      if (auto* t = w.plan.model.get<model::MillingTechnology>(technology); t != nullptr && s.proposed) {
        t->feedrate.reset();
        t->spindle.reset();
      }
      if (technology.set() && !s.keep_feed) w.plan.ledger.reopen({technology, "feedrate"});
      if (technology.set() && !s.keep_speed) w.plan.ledger.reopen({technology, "spindle"});
    }
    if (w.policy.bind == Bind::kStrategy && s.proposed) {
      const auto wanted = tooling::nouns_from_requirement(w.plan.model, s.proposal.tool);
      w.plan.model.get<model::MachiningOperation>(s.operation)->its_tool = wanted;
      w.plan.ledger.reopen({s.operation, "its_tool"});
    }
  }
}

/// By feature and workingstep: what its file states wrongly.
std::map<AnyRef, std::string> unreadable_of(const model::Plan& plan,
                                            const std::vector<model::Unreadable>& all) {
  std::map<AnyRef, std::string> out;
  if (all.empty()) return out;
  const model::Leads leads(plan.model);
  for (const auto& u : all) {
    const auto touched = leads.touched_by(u.key.object);
    for (const AnyRef f : touched.features) out.emplace(f, u.why);
    for (const AnyRef s : touched.steps) out.emplace(s, u.why);
    // Without its operation a step would be taken for one that rules may choose.
    const auto* ws = plan.model.get<model::MachiningWorkingstep>(u.key.object);
    if (ws != nullptr && u.key.attribute == "its_operation" && ws->its_feature.set())
      out.emplace(ws->its_feature, u.why);
  }
  return out;
}

/// One try. Nothing when something failed: `tries` has learned what, and the plan is to be made again.
Result<std::optional<model::Plan>> bind_once(model::Plan plan, const Inputs& inputs, const Policy& policy,
                                             double earning_per_min, Tries& tries, Job& job) {
  draft::Recorded recorded{
      std::exchange(plan.cutters, {}), std::exchange(plan.steps, {}), plan.machine, plan.material, {}};
  for (const auto& s : plan.setups) recorded.holdings.emplace_back(s.setup, s.holding);
  plan.setups.clear();
  plan.unplanned.clear();
  model::named_by_caller(plan, inputs.material_name && !inputs.material_of_plan,
                         (inputs.stock || inputs.stock_allowance_mm) && !inputs.stock_of_plan);
  const auto wrong = model::unreadable(plan);
  auto not_made = unreadable_of(plan, wrong);
  Work w{std::move(plan), inputs, policy, job, tries, {}, {}, {}, std::move(recorded)};
  w.unreadable = std::move(not_made);
  w.earning_per_min = earning_per_min;
  using Stage = Status (*)(Work&);
  std::vector<Stage> stages = {resolve_workpiece, list_given, take_requirements};
  if (policy.bind >= Bind::kStrategy)
    stages.insert(stages.end(), {propose_missing, select_open_tools, leave_what_rests, order_steps,
                                 hold_workpieces, raise_security_planes});
  if (policy.bind == Bind::kAll) stages.insert(stages.end(), {carry_tools, make_paths, join_paths});
  for (const Stage stage : stages) {
    if (auto ok = stage(w); !ok) return tl::unexpected(ok.error());
    if (w.again) return std::optional<model::Plan>{};
  }
  if (policy.bind == Bind::kAll || policy.bind == Bind::kTools) collect_cutters(w);
  if (policy.bind == Bind::kAll || policy.bind == Bind::kTools) tell_loading(w);
  if (policy.bind == Bind::kAll) state_machine_needs(w);
  if (policy.bind == Bind::kAll) piece::tell_corners(w.piece(), w.steps, job);
  if (policy.bind != Bind::kAll && policy.bind != Bind::kNone) leave_open(w);
  if (auto ok = collect_setups(w); !ok) return tl::unexpected(ok.error());
  name_what_rests(w);
  name_steps(w);
  list_made(w);
  // What was chosen in the place of what is not known does not make it known.
  for (const auto& u : wrong) model::set_unreadable(w.plan, u.key.object, u.key.attribute, u.why);
  return std::move(w.plan);
}

/// Tries until nothing fails. Each try that does not end bans a chain, or leaves a feature out, for good:
/// there are no more of them than chains and features. What is said is that of the last.
Result<model::Plan> bind_settled(const model::Plan& plan, const Inputs& inputs, const Policy& policy,
                                 double earning_per_min, Tries& tries, Job& job) {
  tries.cuts.reset();  // another earning, other answers
  auto before = job.take_diagnostics();
  for (;;) {
    auto out = bind_once(plan, inputs, policy, earning_per_min, tries, job);
    const bool again = out && !out->has_value();
    auto said = job.take_diagnostics();
    if (again) continue;
    for (auto& d : before) job.report(std::move(d));
    for (auto& d : said) job.report(std::move(d));
    if (!out) return tl::unexpected(out.error());
    return **std::move(out);
  }
}

}  // namespace

Result<model::Plan> bind_within(const model::Plan& plan, const Inputs& inputs, const Policy& policy,
                                Tries& tries, Job& job) {
  if (inputs.objective != Objective::kProfit) return bind_settled(plan, inputs, policy, 0.0, tries, job);
  if (!inputs.revenue) {
    return fail({.code = "PIP-REVENUE",
                 .message = "most profit needs to be told what a piece brings",
                 .expected = "its price less its material, in the currency of the machine's cost per hour"});
  }
  // What is left open has no time, and so no profit: planned for least cost.
  if (policy.bind != Bind::kAll) return bind_settled(plan, inputs, policy, 0.0, tries, job);
  return most_profit(
      *inputs.revenue,
      [&](double earning_per_min, Job& trial) {
        return bind_settled(plan, inputs, policy, earning_per_min, tries, trial);
      },
      job);
}

Result<model::Plan> bind(model::Plan plan, const Inputs& inputs, const Policy& policy, Job& job) {
  if (const std::string beyond = model::beyond_range(plan); !beyond.empty())
    return fail({.code = "PIP-RANGE",
                 .message = beyond + ": nothing can be computed with it",
                 .file = plan.file_name,
                 .hint = "correct it in the file; lengths are in mm unless it says otherwise"});
  Tries tries;
  auto out = bind_within(plan, inputs, policy, tries, job);
  if (out) tell_tries(tries, job);
  return out;
}

}  // namespace capstan::pipeline
