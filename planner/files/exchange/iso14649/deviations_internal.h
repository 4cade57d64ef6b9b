#pragma once

#include <string>
#include <string_view>

#include "planner/files/exchange/iso14649/reading.h"

namespace capstan::exchange::deviations {

/// Puts the value into the ledger as repaired or suspicious, and warns.
void note(Reading& r, model::AnyRef at, std::string_view attribute, bool repaired, const std::string& code,
          const std::string& why);
/// The attribute as the file spells it.
[[nodiscard]] std::string in_file(const Reading& r, model::AnyRef at, std::string_view attribute);

/// Speeds and feeds of operations against their tools.
void check_technology(Reading& r);

}  // namespace capstan::exchange::deviations
