#include <algorithm>
#include <cmath>
#include <optional>

#include "planner/ground/base/number.h"
#include "planner/making/given/edits/edited_steps.h"
#include "planner/making/given/edits/operator_edits.h"
#include "planner/model/plan/edit/deciding.h"
#include "planner/model/plan/edit/restrictions.h"
#include "planner/model/plan/order/step_ids.h"
#include "planner/model/plan/range/ranges.h"

// What of a whole plan breaks an edit.

namespace capstan::given {

using draft::StepDraft;
using model::Cutter;
using model::Edit;
using model::EditKind;
using model::EditOf;
using model::StepNames;

std::vector<model::Finding> broken_edits(const model::Plan& plan, const std::vector<Edit>& edits) {
  std::vector<model::Finding> out;
  std::vector<StepDraft> steps;
  for (const model::StepResult& r : plan.steps) {
    StepDraft s;
    s.step = r.step;
    if (const auto* ws = plan.model.get<model::MachiningWorkingstep>(r.step)) {
      s.feature = ws->its_feature;
      s.operation = ws->its_operation;
    }
    steps.push_back(std::move(s));
  }
  const auto broken = [&](std::size_t i, const std::string& what) {
    out.push_back({.code = "EDIT-BROKEN", .step = model::step_id(plan, plan.steps[i]), .message = what});
  };
  const auto above = [](double value, double most) { return value > most * (1.0 + 1e-9); };
  for (std::size_t i = 0; i < steps.size(); ++i) {
    const model::StepResult& r = plan.steps[i];
    const StepDraft& s = steps[i];
    if (!s.operation.set()) continue;
    const StepNames names = draft::edit_names(plan.model, s);
    if (const Cutter* c = model::find_cutter(plan, r.cutter_id)) {
      if (const auto no = model::barred(edits, names, *c))
        broken(i, "tool '" + c->id + "' against " + no->why);
    }
    if (const auto no = model::barred_operation(edits, names, s.operation.type))
      broken(i, "its operation is against " + no->why);
    if (const auto no = model::barred_strategy(edits, names, strategy_word(plan.model, s.operation)))
      broken(i, "its strategy is against " + no->why);
    const model::EditLimits limits = model::limits_of(edits, names);
    double feed = r.feed_mm_min, speed = std::abs(r.spindle_rpm);
    if (r.schedule != nullptr && r.path != nullptr) {
      for (std::size_t k = 0; k < r.path->size() && k < r.schedule->feed_mm_min.size(); ++k) {
        if (r.path->kind[k] != model::MoveKind::kRapid && r.path->kind[k] != model::MoveKind::kDwell)
          feed = std::max(feed, r.schedule->feed_mm_min[k]);
        if (k < r.schedule->spindle_rpm.size()) speed = std::max(speed, std::abs(r.schedule->spindle_rpm[k]));
      }
    }
    if (limits.feed_mm_min && above(feed, *limits.feed_mm_min))
      broken(i, "feed " + trimmed(feed, 1) + " mm/min against " + limits.feed_by);
    if (const Edit* set = model::deciding(edits, EditOf::kSpeed, names);
        set != nullptr && !set->value.empty() && std::abs(std::abs(r.spindle_rpm) - set->number) > 1e-3)
      broken(i, "speed " + trimmed(std::abs(r.spindle_rpm), 1) + " 1/min against " + model::words_of(*set));
    const Edit* deep = model::deciding(edits, EditOf::kDepth, names);
    if (deep != nullptr && !deep->value.empty() && depth_of(plan.model, s.operation) != nullptr) {
      const std::string cut = trimmed(r.axial_depth_mm, 3) + " mm";
      if (above(r.axial_depth_mm, deep->number))
        broken(i, "depth " + cut + " against " + model::words_of(*deep));
      // Above what its feature leaves a depth says nothing.
      if (above(deep->number, r.axial_depth_mm))
        out.push_back({.code = "EDIT-DEPTH",
                       .severity = Severity::kNote,
                       .step = model::step_id(plan, r),
                       .message = "its levels are " + cut +
                                  " deep, for there is no more to cut, and not the " +
                                  model::value_text(deep->number) + " mm of " + model::words_of(*deep)});
    }
    if (limits.speed_rpm && above(speed, *limits.speed_rpm))
      broken(i, "speed " + trimmed(speed, 1) + " 1/min against " + limits.speed_by);
  }
  for (const Edit& e : edits) {
    if (e.kind != EditKind::kOrder) continue;
    bool any_first = false, any_second = false;
    std::optional<std::size_t> later;
    for (std::size_t i = 0; i < steps.size(); ++i) {
      const StepNames n = draft::edit_names(plan.model, steps[i]);
      const bool first = model::names(e.where, n), second = model::names(e.before, n);
      any_first = any_first || (first && !second);
      any_second = any_second || (second && !first);
      if (second && !first && !later) later = i;
      if (first && !second && later) {
        broken(i, "it comes after '" + draft::name_of(plan.model, steps[*later]) + "', against " +
                      model::words_of(e));
        break;
      }
    }
    if (any_first && any_second) continue;
    std::string without;
    for (const model::Unplanned& u : plan.unplanned) {
      const auto name = draft::feature_name(plan.model, u.feature);
      if (!name.empty() && (model::names(e.where, name) || model::names(e.before, name)))
        without += (without.empty() ? "" : ", ") + ("'" + std::string(name) + "'");
    }
    out.push_back({.code = "EDIT-BROKEN",
                   .severity = Severity::kWarning,
                   .step = {},
                   .message = model::words_of(e) + " orders nothing: " +
                              (without.empty()
                                   ? "no planned step is named by one of its patterns and not by both; name "
                                     "those that come first, and those that come later, apart"
                                   : "it names " + without +
                                         ", which is not planned; leave the order out, or turn it round")});
  }
  return out;
}

}  // namespace capstan::given
