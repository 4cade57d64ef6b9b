#include "planner/door/late/kept/other_material.h"

#include "planner/door/pipeline/stages.h"
#include "planner/ground/base/job.h"
#include "planner/model/nouns/all.h"
#include "planner/model/plan/decision/by_planning.h"
#include "planner/model/plan/field_differences.h"
#include "planner/model/plan/resources/by_cases.h"
#include "planner/model/plan/resources/material_fields.h"

// A speed is chosen for a material. In a harder one the edge lasts a minute where it was meant to last a
// quarter of an hour, and no limit of force or power need say so.

namespace capstan::late {

std::optional<model::WorkMaterial> material_now(const model::Plan& plan, const pipeline::Inputs& inputs) {
  Job unsaid;
  auto now = pipeline::material_of(plan, inputs, unsaid);
  return now ? std::optional(*std::move(now)) : std::nullopt;
}

std::string other_material(const model::Plan& plan, const std::optional<model::WorkMaterial>& now) {
  if (!now) return {};
  const model::WorkMaterial then = model::without_cases(plan.material);
  if (now->id != then.id) return "the work is of " + now->id + ", the plan was made for " + then.id;
  const std::string differ = model::told_differences(*now, then);
  return differ.empty() ? std::string()
                        : "the card of " + then.id + " is another than the plan was made by (" + differ + ")";
}

std::vector<model::DecisionKey> planned_speeds(const model::Plan& plan, const std::set<model::AnyRef>& cut) {
  std::vector<model::DecisionKey> out;
  std::set<model::AnyRef> seen;
  for (const model::AnyRef at : plan.model.all_below(model::TypeId::kMachiningOperation)) {
    const auto* op = plan.model.get<model::MachiningOperation>(at);
    if (op == nullptr || cut.contains(at) || !op->its_technology.set()) continue;
    if (!seen.insert(op->its_technology).second) continue;
    for (const char* const name : {"spindle", "cutspeed", "feedrate", "feedrate_per_tooth"}) {
      const model::Decision* d = plan.ledger.find(op->its_technology, name);
      if (model::by_planning(d) && !d->pinned) out.push_back({op->its_technology, name});
    }
  }
  return out;
}

}  // namespace capstan::late
