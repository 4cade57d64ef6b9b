#pragma once

#include <string>
#include <utility>
#include <vector>

#include "planner/files/exchange/records/records.h"

// The record of the material, with its force coefficients and life laws.

namespace capstan::exchange {

using Sources = std::vector<std::pair<std::string, std::string>>;

void describe(RecordFields& f, model::WorkMaterial& m);
/// Where values come from, in any record.
void describe_sources(RecordFields& f, Sources& sources);

}  // namespace capstan::exchange
