#include <algorithm>
#include <map>
#include <string>
#include <utility>

#include "planner/door/pipeline/checked.h"
#include "planner/making/given/edits/operator_edits.h"
#include "planner/model/plan/edit/held.h"
#include "planner/model/plan/edit/provenance.h"

// The operator's edits: planned as if there were only the restrictions, then what is set is set, and what
// depends on it is planned anew. So what no edit names stays as it was.

namespace capstan::pipeline {
namespace {

/// An error at a step whose values an edit holds names the edit beside the limit.
void name_edits(Checked& c) {
  const auto held = model::held_steps(c.plan);
  for (model::Finding& f : c.findings) model::name_edits(held, f);
  for (model::Unplanned& u : c.plan.unplanned) {
    std::string words;
    for (const model::AnyRef r : c.plan.model.all(model::TypeId::kMachiningWorkingstep)) {
      const auto* ws = c.plan.model.get<model::MachiningWorkingstep>(r);
      if (model::AnyRef(ws->its_feature) != u.feature || !words.empty()) continue;
      words = model::edits_of_step(c.plan, r);
    }
    if (!words.empty()) u.reason += "; held by " + words;
  }
}

void keep_rows(model::Plan& plan, const std::vector<model::Edit>& edits) {
  std::erase_if(plan.provenance, model::is_edit);
  for (const model::Edit& e : edits) plan.provenance.push_back(model::provenance_of(e));
}

/// Of the first planning, what the second does not say and does not overtake: it is not about a step that an
/// edit holds.
void tell_first(const std::vector<Diagnostic>& first, const model::Plan& plan, Job& job) {
  std::vector<Diagnostic> second = job.take_diagnostics();
  const auto held = model::held_steps(plan);
  for (const Diagnostic& d : first) {
    const bool again = std::find(second.begin(), second.end(), d) != second.end();
    const bool overtaken = std::any_of(held.begin(), held.end(), [&](const auto& h) {
      return d.message.find("'" + h.first + "'") != std::string::npos;
    });
    if (!again && !overtaken) job.report(d);
  }
  for (Diagnostic& d : second) job.report(std::move(d));
}

/// An order may name a step that was planned, and that just this order made impossible.
Diagnostic with_replaced(Diagnostic d, const std::vector<model::Edit>& edits,
                         const std::vector<std::pair<std::string, std::string>>& replaced) {
  if (d.code != "EDIT-NOTHING") return d;
  for (const model::Edit& e : edits) {
    if (e.kind != model::EditKind::kOrder || !d.message.starts_with(model::words_of(e))) continue;
    for (const auto& [name, why] : replaced) {
      if (!model::names(e.where, name) && !model::names(e.before, name)) continue;
      d.message += "; the step '" + name + "' was planned, and is no longer, because " + why;
      d.hint = "leave the order out, or turn it round";
      return d;
    }
  }
  return d;
}

}  // namespace

Result<Checked> bind_edited(const model::Plan& plan, const Inputs& inputs, const Policy& policy, Job& job,
                            const Anew& anew) {
  auto out = bind_anew(plan, inputs, policy, job, anew);
  if (!out) return out;
  if (!policy.window) {
    model::Plan edited = out->plan;
    auto taken = given::take_edits(edited, inputs.edits, inputs.library, inputs.machine,
                                   model::edits_are_all(inputs.provenance), job);
    if (!taken) return tl::unexpected(with_replaced(taken.error(), inputs.edits, out->replaced));
    if (taken->opened && policy.bind == Bind::kAll) {
      const std::vector<Diagnostic> first = job.take_diagnostics();
      Policy again = policy;
      again.reopen = Reopen::kNothing;
      out = bind_anew(edited, inputs, again, job, anew);
      if (!out) return out;
      tell_first(first, out->plan, job);
    } else {
      out->plan = std::move(edited);
      out->part = nullptr;
    }
    keep_rows(out->plan, taken->edits);
  }
  for (model::Finding& f : given::broken_edits(out->plan, inputs.edits))
    out->findings.push_back(std::move(f));
  name_edits(*out);
  return out;
}

}  // namespace capstan::pipeline
