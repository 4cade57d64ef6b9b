#pragma once

#include "planner/making/propose/choose.h"

// What was cut near a feature before speaks for one of its chains, or against one.

namespace capstan::propose {

/// The proposal with its chains in the order that near cases give them; without a case base as it is. First
/// those all of whose cuts went well before, at least casebase::kRepeats times each, then those of which
/// nothing is known, in the rules' order; last those with a cut that failed as often and is likelier to fail
/// than not. A chain that changed its place says so: the first in the reason of its steps, a failed one in
/// `rejected`, the rules' first choice by step::kFirstFailed. `feature`: as the workingsteps name it.
[[nodiscard]] model::Proposal by_cases(const Choice& choice, model::Proposal proposal, model::AnyRef feature,
                                       const model::FeatureShape& shape);

}  // namespace capstan::propose
