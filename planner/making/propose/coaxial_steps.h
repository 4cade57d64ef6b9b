#pragma once

#include <cstddef>
#include <vector>

#include "planner/ground/base/job.h"
#include "planner/making/draft/draft.h"
#include "planner/model/plan/plan.h"
#include "planner/model/plan/proposal.h"

namespace capstan::propose {

/// Of two holes on one axis, as indices of their steps, the first the narrower: it is opened first, and both
/// before either is reamed or bored, for nothing is roughed around a hole that has its size, and no edge is
/// cut on it. A thread comes when its hole has it.
void members_in_order(std::vector<draft::StepDraft>& steps, const std::vector<std::size_t>& first,
                      const std::vector<std::size_t>& second);

/// Step `at` of a chain, starting from the hole of the drill that was chosen before it, if the requirement
/// left its size open; of rest machining, with the diameter that was chosen for the step before.
[[nodiscard]] model::ProposedStep as_opened(const std::vector<model::ProposedStep>& chain, std::size_t at,
                                            const std::vector<model::Selection>& chosen);

/// Reports holes with an operation that makes a thread although no feature states one: re-opened, they
/// stay plain.
void warn_of_lost_threads(const model::Plan& plan, Job& job);

}  // namespace capstan::propose
