#pragma once

#include "planner/model/plan/decision/decision.h"

namespace capstan::model {

/// Whether planning took a decision, and neither a file nor the operator. A value without an entry in the
/// ledger (null) is given.
[[nodiscard]] inline bool by_planning(const Decision* d) {
  return d != nullptr && d->binder != Binder::kGiven && d->binder != Binder::kOperator;
}

}  // namespace capstan::model
