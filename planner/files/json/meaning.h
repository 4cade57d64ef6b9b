#pragma once

#include <string_view>

namespace capstan::json {

/// What the schema says of a number by the name of its field: its unit, which names wear at their end
/// ("cutting_diameter_mm"), or words where it is a ratio, or has the unit of another field. Empty: the name
/// says nothing.
[[nodiscard]] std::string_view meaning_of(std::string_view name);

}  // namespace capstan::json
