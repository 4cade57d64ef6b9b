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

/// Ranks the cutters of a cut under an overhang and thread mills by the time of their paths, tool change
/// included. There the height of the head and the number of passes or turns matter more than the volume.
/// `seconds` gives the time of a candidate; nothing if it has no path within the limits.
void rank_by_path(model::Plan& plan, std::vector<draft::StepDraft>& steps, draft::StepDraft& step,
                  const std::vector<std::string>& used,
                  const std::function<std::optional<double>(std::size_t)>& seconds);

/// What a mill makes of a surface that it roughs.
struct Roughed {
  double seconds = 0.0;       ///< of its path
  double taken_mm3 = 0.0;     ///< what it removes
  double too_much_mm3 = 0.0;  ///< what it leaves where the next step would bite too deep
};
/// Ranks the mills that rough a surface by the time of their paths and of what they leave too much. `roughed`
/// tries a candidate; nothing if it has no path within the limits. `best` is called after the try of each
/// that is the best so far. Of the diameters down from that which comes first, one mill each is tried, with
/// the roundest corner, until one leaves next to nothing or takes longer than the one before; of a `rest`
/// also a ball of each. False: none takes anything.
[[nodiscard]] bool rank_by_rest(model::Plan& plan, std::vector<draft::StepDraft>& steps,
                                draft::StepDraft& step, const std::vector<std::string>& used, bool rest,
                                const std::function<std::optional<Roughed>(std::size_t)>& roughed,
                                const std::function<void()>& best);

/// Drops the cutters of a step for which the magazine has no pocket beside the tools of the other steps. One
/// pocket is the spindle itself, and tools are changed by hand.
void keep_in_magazine(const model::Machine& machine, const std::vector<draft::StepDraft>& steps,
                      draft::StepDraft& step);

/// Moves a step to a cutter further down the list, because the first one failed: into nouns and ledger.
void take_cutter(model::Plan& plan, std::vector<draft::StepDraft>& steps, draft::StepDraft& step,
                 const model::Candidate& c);

}  // namespace capstan::step
