#pragma once

#include <functional>
#include <optional>

#include "planner/door/pipeline/paths/cuts.h"
#include "planner/door/pipeline/paths/progress.h"
#include "planner/door/pipeline/paths/stocks.h"
#include "planner/door/pipeline/work.h"

// Which of a step's cutters comes first; only planner/door/pipeline/*.cpp include this.

namespace capstan::pipeline {

/// Roughing: of the cutters that fit, the one that takes the volume away soonest, tool change included.
void rank_by_time(Work& w, StepDraft& step, Stocks& stocks, const Progress& progress, Cuts& cuts);

/// Cuts under an overhang, where the whole depth of a head and the passes that it needs say more than the
/// volume: the cutter whose path takes the least time, tool change included. `seconds` tells that of a
/// candidate; nothing where it has no path within the limits.
void rank_by_path(Work& w, StepDraft& step, const std::function<std::optional<double>(std::size_t)>& seconds);

/// A cutter further down the list does what the first could not: into the nouns and the ledger.
void take_cutter(Work& w, StepDraft& step, const model::Candidate& c);

}  // namespace capstan::pipeline
