#pragma once

#include <string_view>

namespace capstan::exchange {

/// Whether a ratio attribute's value is beyond what a ratio can be, and whether percent must be meant then.
[[nodiscard]] bool beyond_ratio(std::string_view attribute, double value);
[[nodiscard]] bool is_percent(std::string_view attribute, double value);

}  // namespace capstan::exchange
