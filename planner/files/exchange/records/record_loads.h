#pragma once

#include "planner/files/exchange/records/records.h"
#include "planner/model/plan/plan.h"

/// Fields of a step's loads and limits, described once for writing and for reading.
namespace capstan::exchange {

void describe(RecordFields& f, model::StepLoads& l);
void describe(RecordFields& f, model::ActiveConstraint& c);
void describe(RecordFields& f, model::LimitAlongPath& l);
void describe(RecordFields& f, model::ExceededLimit& l);

}  // namespace capstan::exchange
