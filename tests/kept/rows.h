#pragma once

#include <string>
#include <vector>

#include "tests/kept/measure.h"

namespace capstan::kept {

/// The pieces of work that are kept fast. `capstan` is the command, `examples` the folder of shipped parts,
/// `scratch` one that may be written. `smoke` leaves out those that take seconds.
[[nodiscard]] std::vector<Row> rows(const std::string& capstan, const std::string& examples,
                                    const std::string& scratch, bool smoke);

}  // namespace capstan::kept
