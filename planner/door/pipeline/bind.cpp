#include <algorithm>
#include <optional>
#include <set>
#include <utility>

#include "casebase/casebase.h"
#include "planner/controls/controls.h"
#include "planner/door/pipeline/checked.h"
#include "planner/door/pipeline/profit.h"
#include "planner/door/pipeline/stages.h"
#include "planner/ground/base/number.h"
#include "planner/ground/base/stopping.h"
#include "planner/making/given/ends.h"
#include "planner/making/given/machine_needs.h"
#include "planner/making/given/operator_edits.h"
#include "planner/making/given/tool_material.h"
#include "planner/making/piece/corner_rests.h"
#include "planner/making/piece/raw_piece_limits.h"
#include "planner/making/piece/workpiece.h"
#include "planner/making/step/record/gone.h"
#include "planner/making/step/record/worn_edges.h"
#include "planner/model/plan/decision/contradicted.h"
#include "planner/model/plan/decision/reopen_all.h"
#include "planner/model/plan/decision/unreadable.h"
#include "planner/model/plan/order/step_ids.h"
#include "planner/model/plan/range/positions.h"
#include "tooling/library/nouns/nouns.h"
#include "tooling/selection/select.h"

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

/// The cutters that steps use, each once, with their tool numbers; nouns say the same.
void collect_cutters(model::Plan& plan, const std::vector<StepDraft>& steps, const Policy& policy) {
  std::set<std::string> seen;
  for (const StepDraft& s : steps) {
    if (!(s.cutter.cutting_diameter_mm > 0.0) || !executed(plan, policy, s)) continue;
    if (seen.insert(s.cutter.id).second) {
      plan.cutters.push_back(s.cutter);
      continue;
    }
    // The stick-out is what the deepest of its steps needs.
    for (model::Cutter& c : plan.cutters) {
      if (c.id != s.cutter.id) continue;
      c.stick_out_mm = std::max(c.stick_out_mm, s.cutter.stick_out_mm);
      c.usable_length_mm = std::max(c.usable_length_mm, s.cutter.usable_length_mm);
    }
  }
  tooling::assign_pockets(plan.cutters);
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
  std::stable_sort(plan.cutters.begin(), plan.cutters.end(),
                   [](const auto& a, const auto& b) { return a.pocket < b.pocket; });
}

Status collect_setups(model::Plan& plan, const std::vector<draft::SetupDraft>& setups) {
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
  for (std::size_t i = 0; i < setups.size(); ++i) {
    plan.setups.push_back(
        {setups[i].setup, std::string(control.work_offsets[i]), setups[i].security_z_mm, setups[i].holding});
  }
  return {};
}

/// Each executed step gets a name of its own that every file format carries.
void name_steps(model::Plan& plan) {
  const std::vector<std::string> ids = model::step_ids(plan);
  for (std::size_t i = 0; i < ids.size(); ++i) {
    auto* e = plan.model.get<model::Executable>(plan.steps[i].step);
    if (e != nullptr && !e->persistent_id) e->persistent_id = ids[i];
  }
}

std::optional<draft::Mill> mill_of(const model::Cutter& c) {
  if (!model::has(c.cutter_class, model::CutterTrait::kEndMill)) return std::nullopt;
  return draft::Mill{c.cutting_diameter_mm, c.corner_radius_mm};
}

/// Which chain and cutter made each proposed step, so that what a check says of it can be traced back.
std::map<AnyRef, MadeStep> made_steps(const step::PlanSoFar& p) {
  std::map<AnyRef, MadeStep> out;
  for (const StepDraft& s : p.steps) {
    if (!s.proposed) continue;
    out[s.step] = {s.member,
                   s.chain,
                   s.in_chain,
                   s.cutter.id,
                   s.proposal.name,
                   mill_of(s.cutter),
                   p.plan.model.holds<model::FreeformFinishMilling>(s.operation),
                   step::cut_around(p, s)};
  }
  return out;
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

/// What a shop has to buy or load so that the unplanned features find their tools: reported all at once, and
/// given as rows of provenance, which every form of a plan keeps.
std::vector<model::Provenance> tell_needed(const model::Plan& plan,
                                           const std::vector<model::NeededTool>& needed, Job& job) {
  const auto kinds = model::needed_kinds(plan, needed);
  std::vector<model::Provenance> out;
  std::string all;
  for (std::size_t i = 0; i < kinds.size(); ++i) {
    out.push_back(model::provenance_of(kinds[i], i + 1));
    all += (all.empty() ? "" : "; ") + model::text_of(kinds[i]);
  }
  if (all.empty()) return out;
  job.report({.code = "PIP-TOOLS-NEEDED",
              .severity = Severity::kWarning,
              .message = "to plan all of this part you need: " + all,
              .file = plan.file_name,
              .hint = "the plan holds them as entries for a list of tools (--tools): capstan explain"});
  return out;
}

/// Writes what holds the piece into drafts and nouns; of a plan that says nothing of it, that nothing is
/// planned.
void put_held(model::Plan& plan, Drafts& drafts, workholding::Held held, const std::string& how) {
  const auto about = [](const model::Provenance& p) { return p.what == "workholding"; };
  if (held.note && std::none_of(plan.provenance.begin(), plan.provenance.end(), about))
    plan.provenance.push_back(*std::move(held.note));
  if (!held.planned) return;
  for (std::size_t i = 0; i < drafts.setups.size(); ++i)
    drafts.setups[i].holding = std::move(held.holdings[i]);
  for (std::size_t i = 0; i < drafts.setups.size(); ++i) {
    if (!drafts.setups[i].holding.solids.empty()) workholding::write_nouns(plan, drafts.setups, i, how);
  }
}

/// How many of the drafts a window counts as cut: those that have a result.
std::size_t cut_before(const Asked& asked, const Drafts& drafts) {
  return asked.policy.window ? std::min(asked.policy.window->first, drafts.steps.size()) : 0;
}

/// Of the steps before the window nothing is open: they are cut.
Status close_cut(const model::Plan& plan, Drafts& drafts, const Asked& asked) {
  const Window window = *asked.policy.window;
  std::vector<StepDraft>& steps = drafts.steps;
  if (steps.size() != window.first + window.count)
    return fail({.code = "PIP-NEXT",
                 .message = "of the first " + counted(window.first + window.count, "step", "steps") +
                            " only " + std::to_string(steps.size()) + " have an operation",
                 .file = plan.file_name,
                 .hint = "plan the operations before single steps are bound"});
  for (std::size_t i = 0; i < window.first; ++i) {
    const bool there = i < asked.recorded.steps.size();
    if (!there || asked.recorded.steps[i].step != steps[i].step || asked.recorded.steps[i].path == nullptr)
      return fail({.code = "PIP-NEXT",
                   .message = "step " + std::to_string(i + 1) + " '" + draft::name_of(plan.model, steps[i]) +
                              "' has no path, so that what it left is not known",
                   .file = plan.file_name,
                   .hint = "bring the plan that the steps before were bound in"});
    steps[i].open_tool = steps[i].open_technology = false;
  }
  return {};
}

/// What is cut was cut with the cutter that the plan had then.
void take_cut_cutters(Drafts& drafts, const Asked& asked) {
  for (std::size_t i = 0; i < cut_before(asked, drafts); ++i) {
    const std::string& id = asked.recorded.steps[i].cutter_id;
    for (const model::Cutter& c : asked.recorded.cutters)
      if (c.id == id) drafts.steps[i].cutter = c;
  }
}

/// The stages of one try that choose steps, tools and order; whether all of them came to their end.
Result<bool> choose_steps(model::Plan& plan, Drafts& drafts, const Required& required, const Asked& asked,
                          Tries& tries, Job& job) {
  poll();
  if (asked.policy.window) {
    if (auto ok = close_cut(plan, drafts, asked); !ok) return tl::unexpected(ok.error());
  } else {
    auto [proposed, learned] = propose_missing(plan, std::move(drafts), required, asked, job);
    tries.need(proposed.needed);
    if (tries.learn(std::move(learned))) return false;
    drafts = std::move(proposed);
  }
  poll();
  drafts = select_open_tools(plan, std::move(drafts), required, asked, job);
  if (asked.policy.window) take_cut_cutters(drafts, asked);
  tries.need(drafts.needed);
  if (tries.learn(leave_what_rests(plan, drafts))) return false;
  poll();
  auto ordered = order_steps(plan, std::move(drafts), required, asked, job);
  if (!ordered) return tl::unexpected(ordered.error());
  if (tries.learn(std::move(ordered->second))) return false;
  poll();
  drafts = std::move(ordered->first);
  auto held = hold_workpieces(plan, drafts, asked, job);
  if (!held) return tl::unexpected(held.error());
  put_held(plan, drafts, *std::move(held), asked.inputs.workholding);
  given::raise_security_planes(plan, drafts.setups, drafts.steps, job);
  return true;
}

/// Writes material, machine and raw piece, and who named them; other provenance is recorded anew in this run.
void put_workpiece(model::Plan& plan, Resolved resolved, const Inputs& inputs) {
  plan.material = std::move(resolved.material);
  plan.machine = inputs.machine;
  plan.stock = std::move(resolved.raw);
  plan.provenance = inputs.provenance;
  plan.provenance.push_back(std::move(resolved.margin.said));
  if (inputs.stock) piece::state_raw_piece(plan.model, plan.stock.box);
}

/// One try. Nothing when something failed: `tries` has learned what, and the plan is to be made again.
Result<std::optional<model::Plan>> bind_once(model::Plan plan, const Inputs& inputs, const Policy& policy,
                                             double earning_per_min, Tries& tries, Job& job) {
  const std::optional<model::Plan> again;
  draft::Recorded recorded{
      std::exchange(plan.cutters, {}), std::exchange(plan.steps, {}), plan.machine, plan.material, {}};
  for (const auto& s : plan.setups) recorded.holdings.emplace_back(s.setup, s.holding);
  plan.setups.clear();
  plan.unplanned.clear();
  model::named_by_caller(plan, inputs.material_name && !inputs.material_of_plan,
                         (inputs.stock || inputs.stock_allowance_mm) && !inputs.stock_of_plan);
  const auto wrong = model::unreadable(plan);
  const auto corners = model::corner_rests(plan);
  const auto not_made = unreadable_of(plan, wrong);

  auto resolved = resolve_workpiece(plan, inputs, job);
  if (!resolved) return tl::unexpected(resolved.error());
  const mechanics::MarginPolicy margin = resolved->margin.policy;
  put_workpiece(plan, *std::move(resolved), inputs);
  const Asked asked{inputs, policy, tries.bans, recorded, not_made, margin, tries.thrift};
  piece::report_outside(plan, job);
  poll();
  const std::size_t most = policy.window ? policy.window->first + policy.window->count : given::kAllSteps;
  if (policy.reopen < Reopen::kOperations) {
    const std::size_t cut = policy.window ? policy.window->first : 0;
    if (auto ok = given::open_beyond_edits(plan, inputs.edits, inputs.library, cut, job); !ok)
      return tl::unexpected(ok.error());
  }
  auto listed = given::list_steps(plan, policy.reopen, not_made, grown_mm(inputs), job, most);
  if (!listed) return tl::unexpected(listed.error());
  piece::keep_corner_rests(plan, corners, listed->steps);
  poll();
  const auto required = take_requirements(plan, asked, job);
  if (!required) return tl::unexpected(required.error());
  if (const piece::Demands& d = required->demands; d.general)
    plan.provenance.push_back({"general tolerance", d.general->text, d.general_from});
  poll();
  Drafts drafts{std::move(listed->setups), std::move(listed->steps), {}};
  if (policy.bind >= Bind::kStrategy) {
    const auto chosen = choose_steps(plan, drafts, *required, asked, tries, job);
    if (!chosen) return tl::unexpected(chosen.error());
    if (!*chosen) return again;
  }
  for (StepDraft& s : drafts.steps)
    s.limits = model::limits_of(inputs.edits, draft::edit_names(plan.model, s));
  const piece::Piece piece{plan, required->shapes, grown_mm(inputs)};
  const step::Wishes wishes{inputs.objective,   earning_per_min, margin.deviations, inputs.constant_feeds,
                            inputs.cases.get(), inputs.library,  edits_of(inputs)};
  const step::PlanSoFar so_far{plan, drafts.setups, drafts.steps, piece, required->demands, recorded, wishes};
  if (policy.bind == Bind::kAll) {
    given::carry_tools(plan.model, drafts.steps);
    auto made = make_paths(plan, drafts.steps, so_far, drafts.used, cut_before(asked, drafts), tries,
                           options_of(inputs), job);
    if (!made) return tl::unexpected(made.error());
    if (tries.learn(*std::move(made))) return again;
    given::join_paths(plan, drafts.setups);
  }

  poll();
  if (policy.bind == Bind::kAll || policy.bind == Bind::kTools) {
    collect_cutters(plan, drafts.steps, policy);
    given::tell_loading(plan, inputs.library, job);
    given::tell_assumed_materials(plan, job);
  }
  if (policy.bind == Bind::kAll) {
    step::tell_edges(plan, inputs.cases.get(), job);
    given::state_machine_needs(plan);
    piece::settle_corner_rests(plan, required->shapes, grown_mm(inputs), drafts.steps, job);
    piece::tell_corners(piece, drafts.steps, job);
  }
  if (policy.bind != Bind::kAll && policy.bind != Bind::kNone) leave_open(plan, drafts.steps, policy.bind);
  if (auto ok = collect_setups(plan, drafts.setups); !ok) return tl::unexpected(ok.error());
  plan.unplanned = with_what_rests(plan, drafts.setups);
  name_steps(plan);
  for (model::Provenance& row : tell_needed(plan, tries.needed, job))
    plan.provenance.push_back(std::move(row));
  tries.made = made_steps(so_far);
  // A value chosen in place of an unreadable one does not make that readable.
  for (const auto& u : wrong) model::set_unreadable(plan, u.key.object, u.key.attribute, u.why);
  return std::optional<model::Plan>(std::move(plan));
}

/// Tries until nothing fails. Each failed try bans a chain or leaves a feature out for good, so there are at
/// most as many tries as chains and features. The diagnostics are those of the last try.
Result<model::Plan> bind_settled(const model::Plan& plan, const Inputs& inputs, const Policy& policy,
                                 double earning_per_min, Tries& tries, Job& job) {
  tries.cuts = {};  // another earning, other answers
  auto before = job.take_diagnostics();
  for (;;) {
    auto out = stoppable(
        job,
        [&] {
          auto once = bind_once(plan, inputs, policy, earning_per_min, tries, job);
          poll();  // one that was stopped in its last moment is no plan either
          return once;
        },
        [&]() -> Result<std::optional<model::Plan>> { return tl::unexpected(stopped_planning(plan)); });
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

Diagnostic stopped_planning(const model::Plan& plan) {
  return {.code = "PIP-STOPPED",
          .message = "planning was stopped before its end, so that there is no plan",
          .file = plan.file_name};
}

void tell_altered_cases(const Inputs& inputs, Job& job) {
  if (!inputs.cases) return;
  for (Diagnostic& d : inputs.cases->take_faults()) job.report(std::move(d));
}

Result<model::Plan> bind_within(const model::Plan& plan, const Inputs& inputs, const Policy& policy,
                                Tries& tries, Job& job) {
  if (!tries.memo) tries.memo = inputs.memo ? inputs.memo : std::make_shared<memo::Memo>();
  if (inputs.objective != Objective::kProfit) return bind_settled(plan, inputs, policy, 0.0, tries, job);
  if (!inputs.revenue) {
    return fail({.code = "PIP-REVENUE",
                 .message = "planning for most profit needs the revenue of a piece (--revenue)",
                 .expected = "its price less its material, in the currency of the machine's cost per hour"});
  }
  // Open decisions have no time, and so no profit: the plan is made for least cost.
  if (policy.bind != Bind::kAll) return bind_settled(plan, inputs, policy, 0.0, tries, job);
  const auto plan_for = [&](double earning_per_min, Job& trial) {
    return bind_settled(plan, inputs, policy, earning_per_min, tries, trial);
  };
  return stoppable(
      job,
      [&] {
        auto most = most_profit(*inputs.revenue, plan_for, job);
        poll();
        return most;
      },
      [&]() -> Result<model::Plan> { return tl::unexpected(stopped_planning(plan)); });
}

Result<model::Plan> bind(model::Plan plan, const Inputs& inputs, const Policy& policy, Job& job) {
  if (const std::string beyond = model::beyond_range(plan); !beyond.empty())
    return fail({.code = "PIP-RANGE",
                 .message = beyond,
                 .file = plan.file_name,
                 .hint = "correct it in the file; lengths are in mm unless it says otherwise"});
  Tries tries;
  auto out = bind_within(plan, inputs, policy, tries, job);
  if (out) tell_tries(tries, job);
  tell_altered_cases(inputs, job);
  return out;
}

}  // namespace capstan::pipeline
