#include <algorithm>
#include <map>
#include <optional>
#include <utility>

#include "casebase/casebase.h"
#include "planner/door/pipeline/checked.h"
#include "planner/door/pipeline/profit.h"
#include "planner/door/pipeline/stages.h"
#include "planner/ground/base/number.h"
#include "planner/ground/base/stopping.h"
#include "planner/making/given/edits/operator_edits.h"
#include "planner/making/given/ends.h"
#include "planner/making/piece/corner_rests.h"
#include "planner/making/piece/workpiece.h"
#include "planner/making/step/path/surface_rest.h"
#include "planner/making/step/record/gone.h"
#include "planner/model/plan/decision/contradicted.h"
#include "planner/model/plan/decision/fresh_edits.h"
#include "planner/model/plan/decision/not_recognised.h"
#include "planner/model/plan/decision/unreadable.h"
#include "planner/model/plan/edit/provenance.h"
#include "planner/model/plan/range/positions.h"
#include "planner/model/plan/resources/by_cases.h"

namespace capstan::pipeline {
namespace {

using draft::StepDraft;

std::optional<draft::Mill> mill_of(const model::Cutter& c) {
  if (!model::has(c.cutter_class, model::CutterTrait::kEndMill)) return std::nullopt;
  return draft::Mill{c.cutting_diameter_mm, c.corner_radius_mm};
}

/// Which chain and cutter made each proposed step, so that what a check says of it can be traced back.
std::map<AnyRef, MadeStep> made_steps(const model::Plan& plan, const Drafts& drafts, const Required& required,
                                      const Asked& asked) {
  const piece::Piece piece{plan, required.shapes, grown_mm(asked.inputs)};
  const step::Wishes wishes = wishes_of(asked);
  const step::PlanSoFar p{plan, drafts.setups, drafts.steps, piece, required.demands, asked.recorded, wishes};
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
                   step::may_cut_nothing(p, s),
                   step::roughed_before(p, s) != nullptr};
  }
  return out;
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

/// The stages of one try that choose steps, tools and order. Nothing when one of them failed: `tries` has
/// learned what.
Result<std::optional<Drafted>> choose_steps(model::Plan plan, Drafts drafts, const Required& required,
                                            const Asked& asked, Tries& tries, Job& job) {
  const std::optional<Drafted> again;
  poll();
  Drafted now{std::move(plan), std::move(drafts)};
  if (asked.policy.window) {
    if (auto ok = close_cut(now.plan, now.drafts, asked); !ok) return tl::unexpected(ok.error());
  } else {
    now = propose_missing(std::move(now.plan), std::move(now.drafts), required, asked, job);
    tries.need(now.drafts.needed);
    if (tries.learn(std::move(now.learned))) return again;
  }
  poll();
  now = select_open_tools(std::move(now.plan), std::move(now.drafts), required, asked, job);
  if (asked.policy.window) take_cut_cutters(now.drafts, asked);
  tries.need(now.drafts.needed);
  if (tries.learn(leave_what_rests(now.plan, now.drafts))) return again;
  poll();
  auto ordered = order_steps(std::move(now.plan), std::move(now.drafts), required, asked, job);
  if (!ordered) return tl::unexpected(ordered.error());
  now = *std::move(ordered);
  if (tries.learn(std::move(now.learned))) return again;
  poll();
  auto held = hold_workpieces(now.plan, now.drafts, asked, job);
  if (!held) return tl::unexpected(held.error());
  put_held(now.plan, now.drafts, *std::move(held), asked.inputs.workholding);
  auto raised =
      given::raise_security_planes(std::move(now.plan), std::move(now.drafts.setups), now.drafts.steps, job);
  now.plan = std::move(raised.plan);
  now.drafts.setups = std::move(raised.setups);
  return std::optional<Drafted>(std::move(now));
}

/// Writes material, machine and raw piece, and who named them; other provenance is recorded anew in this run.
void put_workpiece(model::Plan& plan, Resolved resolved, const Inputs& inputs) {
  // A plan's own card may have what cases said when it was made: they say it anew, or it does not hold.
  plan.material = model::without_cases(std::move(resolved.material));
  plan.machine = inputs.machine;
  plan.stock = std::move(resolved.raw);
  plan.provenance = inputs.provenance;
  plan.provenance.push_back(std::move(resolved.margin.said));
  for (const model::Edit& e : inputs.edits) plan.provenance.push_back(model::provenance_of(e));
  if (inputs.stock) piece::state_raw_piece(plan.model, plan.stock.box);
}

/// Puts what measured cases say of the material's card into it, and tells it; also where the plan that is
/// planned anew had more of it (`before`: its card then).
void take_cases(model::Plan& plan, const casebase::CaseBase* cases, const model::WorkMaterial& before,
                Tries& tries, Job& job) {
  if (cases != nullptr) {
    if (!tries.card || tries.card->of != plan.material)
      tries.card = corrected_card(*cases, plan.material, plan.machine.id);
    plan.material = tries.card->card;
    plan.provenance.insert(plan.provenance.end(), tries.card->rows.begin(), tries.card->rows.end());
    for (const Diagnostic& d : tries.card->told) job.report(d);
  }
  if (model::corrected_by_cases(before) && !model::corrected_by_cases(plan.material))
    job.warn("CASE-MODEL",
             "the plan was made with what measured cases say of '" + before.id +
                 "', and they are not here: forces, margins and lives are the card's own again");
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
  auto not_made = unreadable_of(plan, wrong);
  not_made.merge(model::not_recognised(plan));

  auto resolved = resolve_workpiece(plan, inputs, job);
  if (!resolved) return tl::unexpected(resolved.error());
  const mechanics::MarginPolicy margin = resolved->margin.policy;
  put_workpiece(plan, *std::move(resolved), inputs);
  // Cutters of the plan have what its card said, and this may be another.
  if (auto ok = take_start_values(plan.material, recorded.cutters); !ok) return tl::unexpected(ok.error());
  take_cases(plan, inputs.cases.get(), recorded.material, tries, job);
  const Asked asked{.inputs = inputs,
                    .policy = policy,
                    .bans = tries.bans,
                    .recorded = recorded,
                    .unreadable = not_made,
                    .margin = margin,
                    .thrift = tries.thrift,
                    .smallest = tries.smallest,
                    .memo = tries.memo.get(),
                    .earning_per_min = earning_per_min};
  piece::StatedShapes stated = piece::stated_shapes(plan.model);
  piece::report_outside(plan, stated, job);
  poll();
  const std::size_t most = policy.window ? policy.window->first + policy.window->count : given::kAllSteps;
  if (policy.reopen < Reopen::kOperations) {
    const std::size_t cut = policy.window ? policy.window->first : 0;
    if (auto ok = given::open_beyond_edits(plan, inputs.edits, inputs.library, cut, job); !ok)
      return tl::unexpected(ok.error());
  }
  auto listed = given::list_steps(std::move(plan), policy.reopen, not_made, grown_mm(inputs), job, most);
  if (!listed) return tl::unexpected(listed.error());
  Drafted now{std::move(listed->plan), {std::move(listed->setups), std::move(listed->steps), {}}};
  for (model::Provenance& row : piece::kept_corner_rests(corners, now.drafts.steps))
    now.plan.provenance.push_back(std::move(row));
  poll();
  const auto required = take_requirements(now.plan, asked, std::move(stated), job);
  if (!required) return tl::unexpected(required.error());
  if (const piece::Demands& d = required->demands; d.general)
    now.plan.provenance.push_back({"general tolerance", d.general->text, d.general_from});
  poll();
  if (policy.bind >= Bind::kStrategy) {
    auto chosen = choose_steps(std::move(now.plan), std::move(now.drafts), *required, asked, tries, job);
    if (!chosen) return tl::unexpected(chosen.error());
    if (!*chosen) return again;
    now = **std::move(chosen);
  }
  for (StepDraft& s : now.drafts.steps)
    s.limits = model::limits_of(inputs.edits, draft::edit_names(now.plan.model, s));
  if (policy.bind == Bind::kAll) {
    now.drafts.steps = given::carry_tools(now.plan.model, std::move(now.drafts.steps));
    auto made =
        make_paths(std::move(now.plan), std::move(now.drafts), *required, asked, std::move(tries.cuts), job);
    if (!made) return tl::unexpected(made.error());
    tries.cuts = std::move(made->cuts);
    now = std::move(made->drafted);
    if (tries.learn(std::move(now.learned))) return again;
    now.plan.steps = given::joined_paths(now.plan, now.drafts.setups);
  }

  poll();
  auto closed = close_plan(std::move(now.plan), now.drafts, *required, asked, job);
  if (!closed) return tl::unexpected(closed.error());
  tries.made = made_steps(*closed, now.drafts, *required, asked);
  // A value chosen in place of an unreadable one does not make that readable.
  for (const auto& u : wrong) model::set_unreadable(*closed, u.key.object, u.key.attribute, u.why);
  model::settle_edits(closed->model, closed->ledger);
  return std::optional<model::Plan>(*std::move(closed));
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
  if (const std::string beyond = model::beyond_range(plan); !beyond.empty())
    return fail({.code = "PIP-RANGE",
                 .message = beyond,
                 .file = plan.file_name,
                 .hint = "correct it in the file; lengths are in mm unless it says otherwise"});
  if (!tries.memo) tries.memo = inputs.memo ? inputs.memo : std::make_shared<memo::Memo>();
  geometry::KeptOutlines of_this;
  const geometry::KeptOutlinesScope scope(inputs.outlines ? inputs.outlines.get() : &of_this);
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
  Tries tries;
  auto out = bind_within(plan, inputs, policy, tries, job);
  if (out) {
    tell_tries(tries, job);
    const auto anew = [&](const Inputs& with, Job& trial) {
      Tries of_these;
      of_these.memo = tries.memo;
      return bind_within(plan, with, policy, of_these, trial);
    };
    auto named = name_needed(*std::move(out), std::move(tries.needed), inputs, policy, anew, job);
    if (!named) return tl::unexpected(named.error());
    out = *std::move(named);
  }
  tell_altered_cases(inputs, job);
  return out;
}

}  // namespace capstan::pipeline
