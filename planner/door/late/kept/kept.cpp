#include "planner/door/late/kept/kept.h"

#include <algorithm>
#include <array>
#include <string>
#include <string_view>
#include <utility>

#include "planner/door/late/kept/other_material.h"
#include "planner/door/pipeline/cases/corrected_card.h"
#include "planner/making/given/machine_needs.h"
#include "planner/making/given/tool_material.h"
#include "planner/model/nouns/all.h"
#include "planner/model/nouns/arena/walk.h"
#include "planner/model/plan/assumed_tool_material.h"
#include "planner/model/plan/cutter/cutter_fields.h"
#include "planner/model/plan/decision/contradicted.h"
#include "planner/model/plan/decision/edited.h"
#include "planner/model/plan/decision/unreadable.h"
#include "planner/model/plan/field_differences.h"
#include "planner/model/plan/resources/by_cases.h"
#include "planner/model/plan/resources/machine_fields.h"

// A tool that was set anew is the commonest change at a machine, and the one that plans nothing: its length
// goes into the tool table, its holder may be nearer to the piece. What the check says of the plan with it is
// all there is to know.

namespace capstan::late {
namespace {

using model::AnyRef;
using model::Plan;

/// Choices that a plan was made with, as rows of its provenance.
constexpr std::array<std::string_view, 10> kChoices = {
    "material", "stock", "general-tolerance", "workholding", "feeds", "assume",
    "batch",    "edges", "revenue",           "cases"};

const model::Provenance* row(const std::vector<model::Provenance>& rows, std::string_view what) {
  const auto at = std::find_if(rows.begin(), rows.end(), [&](const auto& p) { return p.what == what; });
  return at == rows.end() ? nullptr : &*at;
}

/// Whether each choice that is made now is that of the plan.
bool chosen_alike(const Plan& plan, const pipeline::Inputs& in) {
  for (const model::Provenance& p : in.provenance) {
    if (std::find(kChoices.begin(), kChoices.end(), p.what) == kChoices.end()) continue;
    const model::Provenance* then = row(plan.provenance, p.what);
    if (then == nullptr || then->value != p.value) return false;
  }
  return !in.margin && (!in.stock || in.stock_of_plan) && !in.stock_allowance_mm;
}

/// Whether machine and material are those that the steps were planned for.
bool made_for(const Plan& plan, const pipeline::Inputs& in,
              const std::optional<model::WorkMaterial>& material) {
  if (plan.machine.id != in.machine.id || !model::told_differences(plan.machine, in.machine).empty())
    return false;
  return other_material(plan, material).empty();
}

/// Whether the plan's card has of cases what these cases say of it now: nothing where there are none. They
/// are read where the plan's record does not name them, or names others.
bool by_the_same_cases(const Plan& plan, const pipeline::Inputs& in) {
  if (!in.cases) return !model::corrected_by_cases(plan.material);
  const model::Provenance* then = row(plan.provenance, pipeline::kCardByCases);
  if (then != nullptr && !then->value.empty() &&
      then->value == pipeline::state_of_card(*in.cases, plan.material, plan.machine.id))
    return true;
  return pipeline::corrected_card(*in.cases, plan.material, plan.machine.id).card == plan.material;
}

bool edited(const Job& job) {
  return std::any_of(job.diagnostics().begin(), job.diagnostics().end(), [](const Diagnostic& d) {
    return model::reported_edit_of(d) != model::ReportedEdit::kNothing;
  });
}

/// Whether every enabled workingstep, or each of the plan's where it is a part, has its tool, path, feed and
/// results, and nothing is open.
bool bound_to_its_end(const Plan& plan, bool part) {
  if (plan.steps.empty() || !plan.unplanned.empty() || plan.stock.box.empty()) return false;
  for (const model::StepResult& s : plan.steps)
    if (s.path == nullptr || s.schedule == nullptr) return false;
  std::vector<AnyRef> all;
  if (part) {
    for (const model::StepResult& s : plan.steps) all.push_back(s.step);
  } else {
    const std::vector<AnyRef> roots = {plan.project};
    all = model::reachable(plan.model, roots);
  }
  for (const AnyRef r : all) {
    const auto* ws = plan.model.get<model::MachiningWorkingstep>(r);
    const auto* e = plan.model.get<model::Executable>(r);
    if (ws == nullptr || !e->enabled.value_or(true)) continue;
    const auto of_it = [&](const model::StepResult& s) { return AnyRef(s.step) == r; };
    if (std::none_of(plan.steps.begin(), plan.steps.end(), of_it)) return false;
    const auto* op = plan.model.get<model::MachiningOperation>(ws->its_operation);
    if (op == nullptr || !plan.model.holds<model::MachiningTool>(op->its_tool)) return false;
    for (const auto& [object, attribute] : {std::pair<AnyRef, const char*>{r, "its_operation"},
                                            {ws->its_operation, "its_tool"},
                                            {ws->its_operation, "its_toolpath"},
                                            {ws->its_operation, "axial_cutting_depth"},
                                            {ws->its_operation, "radial_cutting_depth"},
                                            {op->its_technology, "feedrate"},
                                            {op->its_technology, "spindle"}}) {
      if (object.set() && plan.ledger.is_open(object, attribute)) return false;
    }
  }
  return true;
}

/// The loaded tool in place of the planned one; false where it is another, or would not reach.
bool take_loaded(const pipeline::Inputs& in, model::Cutter& c) {
  const auto at = std::find_if(in.library.begin(), in.library.end(),
                               [&](const model::Cutter& l) { return l.loaded && l.id == c.id; });
  if (at == in.library.end()) return false;
  const std::string other =
      model::told_differences(*at, c,
                              {"pocket", "loaded", "table_line", "functional_length_mm", "stick_out_mm",
                               "usable_length_mm", "sources", "life_used_min"});
  if (!other.empty()) return false;
  const bool reached = c.stick_out_mm >= c.maximum_depth_of_cut_mm;
  if (reached && at->stick_out_mm < at->maximum_depth_of_cut_mm) return false;
  c = *at;
  return true;
}

/// Leaves the cutters that the plan's steps use.
void drop_other_cutters(Plan& plan) {
  std::erase_if(plan.cutters, [&](const model::Cutter& c) {
    return std::none_of(plan.steps.begin(), plan.steps.end(),
                        [&](const model::StepResult& s) { return s.cutter_id == c.id; });
  });
}

/// Nouns say the same of pockets as the cutters.
void state_pockets(Plan& plan) {
  for (const model::StepResult& s : plan.steps) {
    const model::Cutter* c = model::find_cutter(plan, s.cutter_id);
    const auto* ws = plan.model.get<model::MachiningWorkingstep>(s.step);
    const auto* op = ws == nullptr ? nullptr : plan.model.get<model::MachiningOperation>(ws->its_operation);
    const auto* tool = op == nullptr ? nullptr : plan.model.get<model::MachiningTool>(op->its_tool);
    auto* usage = tool == nullptr ? nullptr : plan.model.get<model::ToolUsage>(tool->its_usage);
    if (c != nullptr && usage != nullptr) usage->its_position = std::to_string(c->pocket);
  }
}

}  // namespace

std::optional<Plan> as_it_is(const Plan& plan, const pipeline::Inputs& inputs,
                             const std::optional<model::WorkMaterial>& material,
                             std::optional<pipeline::Window> window, Job& job) {
  if (edited(job) || !model::unreadable(plan).empty() || !model::contradictions(plan).empty() ||
      !made_for(plan, inputs, material) || !chosen_alike(plan, inputs) || !by_the_same_cases(plan, inputs))
    return std::nullopt;
  if (window && plan.steps.size() < window->first + window->count) return std::nullopt;
  Plan out = plan;
  if (window) {
    const auto from = plan.steps.begin() + static_cast<std::ptrdiff_t>(window->first);
    out.steps.assign(from, from + static_cast<std::ptrdiff_t>(window->count));
    drop_other_cutters(out);
  }
  if (!bound_to_its_end(out, window.has_value())) return std::nullopt;
  for (model::Cutter& c : out.cutters)
    if (!take_loaded(inputs, c)) return std::nullopt;
  std::stable_sort(out.cutters.begin(), out.cutters.end(),
                   [](const auto& a, const auto& b) { return a.pocket < b.pocket; });
  state_pockets(out);
  if (const model::Provenance* tools = row(inputs.provenance, "tools")) {
    std::erase_if(out.provenance, [](const auto& p) { return p.what == "tools"; });
    out.provenance.push_back(*tools);
  }
  out.cutters = given::loaded_of(out, inputs.library, job);
  for (const auto& a : model::assumed_tool_materials(out)) {  // told anew
    const model::Provenance row = model::provenance_of(a);
    std::erase_if(out.provenance, [&](const auto& p) { return p.what == row.what; });
  }
  for (model::Provenance& row : given::assumed_materials_of(out, job))
    out.provenance.push_back(std::move(row));
  return out;
}

}  // namespace capstan::late
