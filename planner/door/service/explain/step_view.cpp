#include "planner/door/service/explain/step_view.h"

#include <algorithm>
#include <charconv>
#include <map>
#include <set>

#include "planner/door/service/explain/values.h"
#include "planner/ground/base/number.h"
#include "planner/model/nouns/arena/reached.h"
#include "planner/model/nouns/arena/walk.h"
#include "planner/model/plan/decision/by_planning.h"
#include "planner/model/plan/order/step_ids.h"

namespace capstan::service {

using model::AnyRef;
using model::Model;
using model::TypeId;

namespace {

constexpr std::size_t kParts = 200;  // objects of one step

// These are explained as steps, features and pieces of their own.
bool stands_apart(TypeId t) {
  return model::is_a(t, TypeId::kExecutable) || model::is_a(t, TypeId::kManufacturingFeature) ||
         model::is_a(t, TypeId::kWorkpiece) || model::is_a(t, TypeId::kToolpathList) ||
         model::is_a(t, TypeId::kKeptInstance);
}

/// The step, its operation, and breadth first whatever they refer to.
std::vector<StepPart> parts_of(const Model& m, AnyRef step, AnyRef operation) {
  std::vector<StepPart> out = {{"workingstep", step}};
  if (operation.set()) out.push_back({"operation", operation});
  for (std::size_t i = 1; i < out.size() && out.size() < kParts; ++i) {
    const StepPart from = out[i];
    for (const auto& a : model::noun_type(from.object.type).attributes) {
      if (a.storage != model::Storage::kRef) continue;
      const AnyRef to = model::value_of<AnyRef>(a, m.object(from.object));
      const bool known = std::any_of(out.begin(), out.end(), [&](const auto& p) { return p.object == to; });
      if (!to.set() || known || stands_apart(to.type)) continue;
      const std::string name(a.name);
      out.push_back({i == 1 ? name : from.role + "/" + name, to});
    }
  }
  return out;
}

bool is_recognised(const model::Plan& plan, AnyRef object) {
  const auto& entries = plan.ledger.entries();
  for (auto it = entries.lower_bound({object, {}}); it != entries.end() && it->first.object == object; ++it) {
    if (it->second.binder == model::Binder::kRecognition) return true;
  }
  return false;
}

/// The feature and its sizes, where recognition bound them in a CAD part: nothing else tells of these.
void add_recognised(const model::Plan& plan, AnyRef feature, std::vector<StepPart>& parts) {
  if (!feature.set()) return;
  if (is_recognised(plan, feature)) parts.push_back({"feature", feature});
  for (const auto& a : model::noun_type(feature.type).attributes) {
    if (a.storage != model::Storage::kRef) continue;
    const AnyRef to = model::value_of<AnyRef>(a, plan.model.object(feature));
    if (to.set() && is_recognised(plan, to)) parts.push_back({"feature/" + std::string(a.name), to});
  }
}

StepView view_of(const model::Plan& plan, AnyRef step) {
  StepView v;
  v.step = step;
  if (const auto* ws = plan.model.get<model::MachiningWorkingstep>(step)) {
    v.feature = ws->its_feature;
    v.operation = ws->its_operation;
  }
  v.parts = parts_of(plan.model, step, v.operation);
  add_recognised(plan, v.feature, v.parts);
  return v;
}

/// True if planning proposed the step and took it out again, as one with nothing to cut: no workplan has it.
bool taken_out(const model::Plan& plan, AnyRef step, const std::set<AnyRef>& reached) {
  return !reached.contains(step) && model::by_planning(plan.ledger.find(step, "its_operation"));
}

}  // namespace

std::vector<StepView> views_of(const model::Plan& plan) {
  std::vector<StepView> out;
  const auto ids = model::step_ids(plan);
  for (std::size_t i = 0; i < plan.steps.size(); ++i) {
    StepView v = view_of(plan, plan.steps[i].step);
    v.result = &plan.steps[i];
    v.number = i + 1;
    v.id = ids[i];
    out.push_back(std::move(v));
  }
  std::map<std::string, int> used;
  for (const StepView& v : out) ++used[v.id];
  const std::vector<AnyRef> roots = {plan.project};
  const auto list = model::reached_of(plan.model, roots, TypeId::kWorkingstep);
  const std::set<AnyRef> reached(list.begin(), list.end());
  for (const AnyRef at : plan.model.all_below(TypeId::kWorkingstep)) {
    const bool planned = std::any_of(plan.steps.begin(), plan.steps.end(),
                                     [&](const model::StepResult& s) { return s.step == at; });
    if (planned || taken_out(plan, at, reached)) continue;
    StepView v = view_of(plan, at);
    const auto& e = plan.model.at<model::Executable>(at);
    v.id = e.persistent_id ? *e.persistent_id : e.its_id.value_or("");
    if (const int n = ++used[v.id]; n > 1) v.id += "~" + std::to_string(n);
    out.push_back(std::move(v));
  }
  return out;
}

Result<StepView> find_step(const model::Plan& plan, std::string_view wanted) {
  std::string names;
  std::size_t number = 0;
  const auto [end, ec] = std::from_chars(wanted.data(), wanted.data() + wanted.size(), number);
  const bool is_number = ec == std::errc() && end == wanted.data() + wanted.size();
  const auto views = views_of(plan);
  for (const StepView& v : views) {
    if (v.id == wanted) return v;
  }
  for (const StepView& v : views) {
    const auto& own = plan.model.at<model::Executable>(v.step).its_id;
    if (own && *own == wanted) return v;
    if (is_number && number != 0 && v.number == number) return v;
    if (!names.empty()) names += ", ";
    names += "'" + v.id + "'";
  }
  return fail({.code = "EXP-STEP",
               .message = "there is no workingstep '" + std::string(wanted) + "'",
               .file = plan.file_name,
               .expected = views.empty() ? "nothing: the plan has no workingsteps" : names});
}

std::string binder_text(const model::Plan& plan, const model::Decision* d) {
  if (d == nullptr) return "given in the file";
  if (d->state == model::DecisionState::kOpen) return "open";
  std::string out = d->binder == model::Binder::kGiven ? "given in the file"
                                                       : "bound by " + std::string(model::to_text(d->binder));
  (void)plan;
  std::replace(out.begin(), out.end(), '_', ' ');
  return d->pinned ? out + ", pinned" : out;
}

std::string cutter_text(const model::Plan& plan, std::string_view cutter_id) {
  const model::Cutter* c = model::find_cutter(plan, cutter_id);
  if (c == nullptr) return cutter_id.empty() ? "-" : std::string(cutter_id);
  std::string kind(model::to_text(c->cutter_class));
  std::replace(kind.begin(), kind.end(), '_', ' ');
  return trimmed(c->cutting_diameter_mm, 3) + " mm " + kind;
}

std::vector<model::DecisionKey> open_decisions(const model::Plan& plan) {
  std::vector<AnyRef> roots = {plan.project};
  for (const TypeId t : {TypeId::kExecutable, TypeId::kManufacturingFeature}) {
    const auto all = plan.model.all_below(t);
    roots.insert(roots.end(), all.begin(), all.end());
  }
  const auto list = model::reachable(plan.model, roots);
  const std::set<AnyRef> reached(list.begin(), list.end());
  std::vector<model::DecisionKey> out;
  for (const auto& [key, d] : plan.ledger.entries()) {
    if (d.state == model::DecisionState::kOpen && reached.contains(key.object)) out.push_back(key);
  }
  return out;
}

}  // namespace capstan::service
