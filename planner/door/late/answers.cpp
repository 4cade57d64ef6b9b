#include "planner/door/late/answers.h"

#include <string>

#include "planner/ground/base/number.h"
#include "planner/model/nouns/all.h"
#include "planner/model/nouns/arena/walk.h"
#include "planner/model/plan/corner_rest.h"
#include "planner/model/plan/decision/by_planning.h"
#include "planner/model/plan/order/step_ids.h"

namespace capstan::late {
namespace {

constexpr double kSameRadiusMm = 1e-6;

}  // namespace

Status only_loaded(const model::Plan& plan, const std::vector<model::Cutter>& magazine,
                   const std::vector<given::OutOfUse>& out_of_use) {
  for (const model::StepResult& step : plan.steps) {
    const model::Cutter* cutter = model::find_cutter(plan, step.cutter_id);
    const model::Cutter* there = cutter == nullptr ? nullptr : given::loaded_like(magazine, *cutter);
    const std::string unmeasured = cutter == nullptr ? "" : model::offset_fault(*cutter);
    if (there != nullptr && there->pocket == cutter->pocket && unmeasured.empty()) continue;
    std::string why = "is not in the tool table";
    if (cutter != nullptr && there == nullptr) why = given::out_of_use(out_of_use, *cutter).value_or(why);
    if (!unmeasured.empty())
      why = "has no length that can be used: " + unmeasured;
    else if (there != nullptr)
      why = "is T" + std::to_string(there->pocket) + " in the tool table and T" +
            std::to_string(cutter->pocket) + " in the plan";
    return fail(
        {.code = "LATE-TOOL",
         .message = "the tool '" + step.cutter_id + "' of step '" + model::step_id(plan, step) + "' " + why,
         .file = plan.file_name,
         .path = model::step_id(plan, step),
         .hint = "load it, or plan the step anew without its toolpath"});
  }
  return {};
}

Status nothing_open(const model::Plan& plan) {
  if (plan.unplanned.empty()) return {};
  return fail({.code = "LATE-OPEN",
               .message = "planning leaves " + counted(plan.unplanned.size(), "thing", "things") +
                          " open, first: " + plan.unplanned.front().reason,
               .file = plan.file_name,
               .hint = "load what is missing, or plan anew"});
}

Status no_more_rest(const model::Plan& brought, const model::Plan& made) {
  for (const model::CornerRest& rest : model::corner_rests(made)) {
    const auto agreed = model::corner_rest_of(brought, rest.feature);
    if (agreed && rest.radius_mm <= agreed->radius_mm + kSameRadiusMm) continue;
    return fail(
        {.code = "LATE-REST",
         .message = "with the loaded tools the inside corners of '" + rest.feature +
                    "' would keep a radius of " + trimmed(rest.radius_mm, 3) + " mm in place of " +
                    trimmed(agreed ? agreed->radius_mm : rest.stated_mm, 3) + " mm",
         .file = made.file_name,
         .path = rest.feature,
         .hint = "load a mill for these corners, or plan the part anew where the rest can be agreed to"});
  }
  return {};
}

bool planning_chose_all(const model::Plan& plan) {
  const auto chosen = [&](model::AnyRef object, const char* attribute) {
    return model::by_planning(plan.ledger.find(object, attribute));
  };
  for (const auto& [key, decision] : plan.ledger.entries()) {
    if (decision.pinned) return false;
  }
  const std::vector<model::AnyRef> roots = {plan.project};
  for (const model::AnyRef r : model::reachable(plan.model, roots)) {
    const auto* step = plan.model.get<model::MachiningWorkingstep>(r);
    if (step == nullptr) continue;
    const auto* op = plan.model.get<model::MachiningOperation>(step->its_operation);
    if (op == nullptr || !chosen(r, "its_operation")) return false;
    if (op->its_toolpath.set() && !chosen(step->its_operation, "its_toolpath")) return false;
  }
  return true;
}

}  // namespace capstan::late
