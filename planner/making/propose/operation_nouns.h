#pragma once

#include <vector>

#include "casebase/record/case.h"
#include "planner/ground/base/job.h"
#include "planner/model/features/shape.h"
#include "planner/model/plan/plan.h"
#include "planner/model/plan/proposal.h"

namespace capstan::propose {

/// The nouns of a proposed step, bound in the ledger: workingstep, operation, strategy, tool, technology,
/// functions. Gives the new workingstep. Coolant that the machine lacks is replaced (PIP-CHANGED).
[[nodiscard]] model::Ref<model::MachiningWorkingstep> add_nouns(
    model::Plan& plan, const model::ProposedStep& step, const model::Candidate& tool,
    const model::FeatureShape& shape, std::vector<model::Rejected> rejected_chains,
    std::vector<model::Rejected> rejected_tools, Job& job);

/// What the step will be cut with on this machine.
[[nodiscard]] casebase::Coolant coolant_of(const model::Machine& machine, const model::ProposedStep& step);

}  // namespace capstan::propose
