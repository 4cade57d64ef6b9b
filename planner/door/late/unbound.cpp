#include "planner/door/late/unbound.h"

#include <algorithm>

#include "planner/making/given/listed_steps.h"
#include "planner/model/nouns/all.h"
#include "planner/model/nouns/arena/walk.h"
#include "planner/model/plan/decision/fresh_edits.h"
#include "planner/model/plan/order/step_ids.h"

namespace capstan::late {
namespace {

using model::AnyRef;

std::string numbers(std::size_t first, std::size_t count) {
  const std::string from = std::to_string(first + 1);
  return count == 1 ? "workingstep " + from : "workingsteps " + from + " to " + std::to_string(first + count);
}

}  // namespace

bool has_result(const model::Plan& plan, std::size_t k, const std::vector<AnyRef>& steps) {
  return k < plan.steps.size() && plan.steps[k].step == steps[k] && plan.steps[k].path != nullptr;
}

bool is_open(const model::Plan& plan, AnyRef step) {
  const auto* ws = plan.model.get<model::MachiningWorkingstep>(step);
  const auto* op = ws == nullptr ? nullptr : plan.model.get<model::MachiningOperation>(ws->its_operation);
  if (op == nullptr) return ws != nullptr;
  const auto open = [&](AnyRef object, const char* attribute) {
    return object.set() && plan.ledger.is_open(object, attribute);
  };
  return open(ws->its_operation, "its_tool") || open(ws->its_operation, "its_toolpath") ||
         open(op->its_technology, "feedrate") || open(op->its_technology, "spindle");
}

Status cut_as_bound(const model::Plan& plan, const Next& next, const pipeline::Window& window,
                    const std::vector<AnyRef>& steps) {
  const std::vector<model::DecisionKey> edited = model::fresh_edits(plan.ledger);
  if (edited.empty()) return {};
  // Without `from` an edited step that is open again would be bound once more by itself, behind it what was
  // bound already.
  std::size_t bound = window.first;
  for (std::size_t k = window.first; !next.from && k < steps.size() && has_result(plan, k, steps); ++k)
    bound = k + 1;
  for (std::size_t k = 0; k < std::min(bound, steps.size()); ++k) {
    // By its operation: its feature knows the operations of other steps.
    const auto* ws = plan.model.get<model::MachiningWorkingstep>(steps[k]);
    const std::vector<AnyRef> roots = {ws != nullptr ? AnyRef(ws->its_operation) : steps[k]};
    const std::vector<AnyRef> its = model::reachable(plan.model, roots);
    for (const model::DecisionKey& key : edited) {
      if (key.object != steps[k] && std::find(its.begin(), its.end(), key.object) == its.end()) continue;
      const auto* e = plan.model.get<model::Executable>(steps[k]);
      const std::string number = std::to_string(k + 1);
      return fail({.code = "LATE-EDITED",
                   .message = "workingstep " + number + " '" + (e == nullptr ? "" : e->its_id.value_or("")) +
                              "' was edited since it was bound: " + key.attribute + " of " +
                              std::string(model::noun_type(key.object.type).keyword) +
                              "; what it left is not what the plan says now",
                   .file = plan.file_name,
                   .expected = "the plan as it was bound",
                   .hint = "take the edit back, or bind that step anew (--from " + number + ")"});
    }
  }
  return {};
}

std::vector<AnyRef> unbound_steps(const model::Plan& plan) {
  const std::vector<AnyRef> steps = given::steps_in_order(plan);
  const std::size_t bound = plan.steps.size();
  if (bound == 0 || steps.size() <= bound) return {};
  for (std::size_t k = 0; k < bound; ++k) {
    if (plan.steps[k].step != steps[k]) return {};
  }
  std::vector<AnyRef> out(steps.begin() + static_cast<std::ptrdiff_t>(bound), steps.end());
  const bool open = std::all_of(out.begin(), out.end(), [&](AnyRef s) { return is_open(plan, s); });
  return open ? out : std::vector<AnyRef>{};
}

model::Finding not_bound(const model::Plan& plan, const std::vector<AnyRef>& steps) {
  constexpr std::size_t kMostNamed = 6;  // default, unsourced
  std::string names;
  for (std::size_t i = 0; i < std::min(steps.size(), kMostNamed); ++i) {
    const auto* e = plan.model.get<model::Executable>(steps[i]);
    names += (i == 0 ? "'" : ", '") + (e == nullptr ? std::string() : e->its_id.value_or("")) + "'";
  }
  if (steps.size() > kMostNamed) names += " and " + std::to_string(steps.size() - kMostNamed) + " more";
  model::Finding f;
  f.property = 34;
  f.code = "CHK-NOT-BOUND";
  f.severity = Severity::kNote;
  f.unproved = true;
  f.message =
      numbers(plan.steps.size(), steps.size()) + " (" + names + (steps.size() == 1 ? ") is" : ") are") +
      " not bound yet: nothing is said of what they make; bind them (capstan bind --next), then check";
  return f;
}

std::optional<PartOfPlan> part_of(const model::Plan& plan, const std::vector<std::string>& ids) {
  const std::vector<std::string> all = model::step_ids(plan);
  const auto at = ids.empty() ? all.end() : std::search(all.begin(), all.end(), ids.begin(), ids.end());
  if (at == all.end()) return std::nullopt;
  PartOfPlan out{plan, static_cast<std::size_t>(at - all.begin())};
  const auto first = plan.steps.begin() + static_cast<std::ptrdiff_t>(out.before);
  out.plan.steps.assign(first, first + static_cast<std::ptrdiff_t>(ids.size()));
  return out;
}

model::Finding taken_as_cut(const PartOfPlan& part) {
  model::Finding f;
  f.property = 33;
  f.code = "CHK-CUT-BEFORE";
  f.severity = Severity::kNote;
  f.message = "the program has " + numbers(part.before, part.plan.steps.size()) + " of the plan; " +
              numbers(0, part.before) + (part.before == 1 ? " is" : " are") +
              " taken as cut as the plan says";
  return f;
}

}  // namespace capstan::late
