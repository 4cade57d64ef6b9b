#include <algorithm>
#include <cmath>
#include <optional>

#include "planner/making/given/edits/edited_steps.h"
#include "planner/making/given/edits/operator_edits.h"
#include "planner/making/step/path/job_of.h"
#include "planner/making/step/record/record.h"
#include "planner/model/plan/decision/by_planning.h"
#include "planner/model/plan/decision/reopen_all.h"
#include "planner/model/plan/edit/restrictions.h"

// What the file or an earlier planning chose against the operator's limits and prohibitions is open again.

namespace capstan::given {
namespace {

using draft::StepDraft;
using model::AnyRef;
using model::Edit;
using model::EditKind;
using model::StepNames;

bool is_pinned(const model::Ledger& ledger, AnyRef object, std::string_view attribute) {
  const auto* d = object.set() ? ledger.find(object, attribute) : nullptr;
  return d != nullptr && d->pinned && d->state == model::DecisionState::kBound;
}

}  // namespace

Status open_beyond_edits(model::Plan& plan, const std::vector<Edit>& edits,
                         const std::vector<model::Cutter>& library, std::size_t cut, Job& job) {
  const bool any = std::any_of(edits.begin(), edits.end(), [](const Edit& e) {
    return e.kind == EditKind::kLimit || e.kind == EditKind::kForbid;
  });
  if (!any) return {};
  const auto kept = [&](const std::string& what, const std::string& why) {
    return fail({.code = "EDIT-KEPT",
                 .message = what + " is the file's, against " + why,
                 .file = plan.file_name,
                 .hint = "re-open the operations (--reopen operations), or take the edit back"});
  };
  for (const StepDraft& s : edited_steps(plan, cut)) {
    const StepNames names = draft::edit_names(plan.model, s);
    const std::string what = called(plan.model, s);
    if (const auto no = model::barred_operation(edits, names, s.operation.type))
      return kept("the operation of " + what, no->why);
    if (const auto no = model::barred_strategy(edits, names, strategy_word(plan.model, s.operation)))
      return kept("the strategy of " + what, no->why);
    const auto cutter = cutter_of(plan, s.operation, library);
    if (const auto no = cutter ? model::barred(edits, names, *cutter) : std::nullopt) {
      if (is_pinned(plan.ledger, s.operation, kToolAttribute))
        return fail(conflict(
            plan, what + ": its tool '" + cutter->id + "' is pinned (" +
                      plan.ledger.reason(plan.ledger.find(s.operation, kToolAttribute)->reason).text +
                      "), against " + no->why));
      if (step::has_given_path(plan, s))
        return kept("the path of " + what + " with '" + cutter->id + "'", no->why);
      model::reopen_all(plan.ledger, {{s.operation, kToolAttribute}});
      job.warn("EDIT-OPENED", what + ": its tool is chosen anew: " + no->why);
    }
    const model::EditLimits limits = model::limits_of(edits, names);
    if (!limits.any()) continue;
    const auto given = step::given_technology(plan.model, s.operation, cutter.value_or(model::Cutter{}));
    const auto beyond = [](const std::optional<double>& value, const std::optional<double>& most) {
      return value && most && std::abs(*value) > *most;
    };
    const auto open = [&](AnyRef object, const char* attribute, const std::string& by) -> Status {
      if (is_pinned(plan.ledger, object, attribute))
        return fail(conflict(plan, what + ": its " + attribute + " is pinned, against " + by));
      const auto* d = plan.ledger.find(object, attribute);
      if (d != nullptr && d->state == model::DecisionState::kOpen) return {};
      const std::string said = what + ": its " + attribute + " is chosen anew: " + by;
      // What a file gives is changed openly; what planning chose is its own to change.
      model::by_planning(d) ? job.note("EDIT-OPENED", said, "") : job.warn("EDIT-OPENED", said);
      model::reopen_all(plan.ledger, {{object, attribute}});
      return {};
    };
    if (beyond(given.rpm, limits.speed_rpm)) {
      if (auto ok = open(step::own_technology(plan, s.operation), "spindle", limits.speed_by); !ok) return ok;
    }
    if (beyond(given.feed_mm_min, limits.feed_mm_min)) {
      if (auto ok = open(step::own_technology(plan, s.operation), "feedrate", limits.feed_by); !ok) return ok;
    }
  }
  return {};
}

}  // namespace capstan::given
