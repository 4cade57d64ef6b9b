#include <cmath>
#include <set>

#include "planner/base/number.h"
#include "planner/model/nouns/all.h"
#include "planner/model/walk.h"
#include "planner/pipeline/shop.h"
#include "tooling/nouns/nouns.h"

// What is in the magazine against what the plan wants.

namespace capstan::pipeline {
namespace {

using model::AnyRef;
using model::Cutter;

constexpr double kSameDiameter = 0.001;  // mm; a tool table's diameter is measured to a micrometre at best

const Cutter* loaded_like(const std::vector<Cutter>& library, const Cutter& wanted) {
  const Cutter* found = nullptr;
  for (const Cutter& c : library) {
    if (c.pocket <= 0) continue;
    if (c.id == wanted.id) return &c;
    const bool same = c.cutter_class == wanted.cutter_class &&
                      std::abs(c.cutting_diameter_mm - wanted.cutting_diameter_mm) <= kSameDiameter &&
                      std::abs(c.corner_radius_mm - wanted.corner_radius_mm) <= kSameDiameter;
    if (same && (found == nullptr || c.pocket < found->pocket)) found = &c;
  }
  return found;
}

}  // namespace

Result<std::vector<std::string>> match_loaded(model::Plan& plan, Inputs& inputs, Job& job) {
  std::vector<std::string> reopened;
  std::vector<Cutter> merged;
  std::set<std::string> seen;
  const std::vector<AnyRef> roots = {plan.project};
  for (const AnyRef r : model::reachable(plan.model, roots)) {
    const auto* op = plan.model.get<model::MachiningOperation>(r);
    if (op == nullptr || !plan.model.holds<model::MachiningTool>(op->its_tool)) continue;
    if (tooling::is_requirement(plan.model, op->its_tool)) continue;
    const auto wanted = tooling::cutter_from_nouns(plan.model, op->its_tool, job, plan.cutters);
    if (!wanted) return tl::unexpected(wanted.error());
    if (const Cutter* there = loaded_like(inputs.library, *wanted)) {
      if (!seen.insert(wanted->id).second) continue;
      Cutter c = *wanted;
      c.pocket = there->pocket;
      if (there->functional_length_mm > 0.0) c.functional_length_mm = there->functional_length_mm;
      merged.push_back(std::move(c));
      continue;
    }
    plan.ledger.reopen({r, "its_tool"});
    reopened.push_back("operation '" + op->its_id.value_or("") + "': tool '" + wanted->id + "' (" +
                       std::string(model::to_text(wanted->cutter_class)) + " " +
                       trimmed(wanted->cutting_diameter_mm, 3) + " mm) is not in the magazine; re-opened");
  }
  // Loaded cutters that the plan did not name stay as the table describes them; a name counts once.
  for (const Cutter& c : inputs.library) {
    bool taken = false;
    for (const Cutter& m : merged) taken = taken || m.pocket == c.pocket;
    if (!taken) merged.push_back(c);
  }
  inputs.library = std::move(merged);
  return reopened;
}

}  // namespace capstan::pipeline
