#pragma once

#include "planner/files/exchange/conformance/faults.h"
#include "planner/files/exchange/conformance/population.h"

namespace capstan::exchange::conformance {

/// Compares the parameters of every instance with the slots of its layout.
void check_values(const Population& population, Faults& faults);

/// The required type in words: "a LENGTH_MEASURE (real)", "a list of 2 to 3 reals".
[[nodiscard]] std::string describe(const express::Type& type);

}  // namespace capstan::exchange::conformance
