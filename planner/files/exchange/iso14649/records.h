#pragma once

#include <cstdint>
#include <functional>
#include <string>

#include "planner/files/exchange/iso14649/reading.h"

namespace capstan::exchange {

/// Restores what user-defined header entities say (planner/files/exchange/records/records.h). A decision
/// whose value was edited since is dropped (and thereby *given*), with a note; unknown user-defined entities
/// are noted and dropped.
void read_records(Reading& reading);

/// The header entities for the plan, one per line, in a stable order. `number_of` gives an object's instance
/// number, 0 when it is not written; hashes are taken from `written`, the model as the file will hold it.
[[nodiscard]] std::string write_records(const model::Plan& plan, const model::Model& written,
                                        const std::function<std::uint64_t(model::AnyRef)>& number_of);

}  // namespace capstan::exchange
