#pragma once

#include "planner/files/exchange/records/records.h"

// The record of the material, with its force coefficients and life laws.

namespace capstan::exchange {

void describe(RecordFields& f, model::WorkMaterial& m);

}  // namespace capstan::exchange
