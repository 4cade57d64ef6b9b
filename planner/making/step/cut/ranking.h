#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "planner/making/step/cut/cuts.h"
#include "planner/making/step/path/progress.h"
#include "planner/making/step/path/stocks.h"
#include "planner/making/step/plan_so_far.h"

// Which of a step's cutters comes first.

namespace capstan::step {

/// Roughing: of the cutters that fit, the one that takes the volume away soonest, tool change included.
/// `step` is one of `steps`, `used` are the cutters in use, `plan` is that of `p`; the choice goes into
/// drafts, nouns and ledger.
void rank_by_time(model::Plan& plan, const PlanSoFar& p, std::vector<draft::StepDraft>& steps,
                  draft::StepDraft& step, const std::vector<std::string>& used, Stocks& stocks,
                  const Progress& progress, Cuts& cuts);

/// Cuts under an overhang, where the whole depth of a head and the passes that it needs say more than the
/// volume: the cutter whose path takes the least time, tool change included. `seconds` tells that of a
/// candidate; nothing where it has no path within the limits.
void rank_by_path(model::Plan& plan, std::vector<draft::StepDraft>& steps, draft::StepDraft& step,
                  const std::vector<std::string>& used,
                  const std::function<std::optional<double>(std::size_t)>& seconds);

/// A cutter further down the list does what the first could not: into the nouns and the ledger.
void take_cutter(model::Plan& plan, std::vector<draft::StepDraft>& steps, draft::StepDraft& step,
                 const model::Candidate& c);

}  // namespace capstan::step
