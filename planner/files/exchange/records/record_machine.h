#pragma once

#include "planner/files/exchange/records/records.h"

// The record of the machine that a plan was made for: all that a check of the plan asks of it.

namespace capstan::exchange {

/// What the machine is beside its id and description.
struct MachineData {
  model::Machine& machine;
};

void describe(RecordFields& f, MachineData m);

}  // namespace capstan::exchange
