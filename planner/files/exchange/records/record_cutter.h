#pragma once

#include "planner/files/exchange/records/records.h"

// The record of a cutter: its sizes, its presets, its holder, and its line in a tool table.

namespace capstan::exchange {

void describe(RecordFields& f, model::Cutter& c);

}  // namespace capstan::exchange
