#pragma once

#include "planner/files/exchange/records/records.h"

// The two records of the machine that a plan was made for: its names, and all that a check of the plan asks
// of it.

namespace capstan::exchange {

/// The machine without its id and description.
struct MachineData {
  model::Machine& machine;
};

/// Its id and description.
void describe(RecordFields& f, model::Machine& m);
void describe(RecordFields& f, MachineData m);

}  // namespace capstan::exchange
