#pragma once

#include <vector>

#include "planner/model/plan/decision/decision.h"

namespace capstan::model {

/// As `Ledger::reopen` of each key, in time that grows with the ledger and not with its square.
void reopen_all(Ledger& ledger, const std::vector<DecisionKey>& keys);

}  // namespace capstan::model
