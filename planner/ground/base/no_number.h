#pragma once

#include <string>
#include <string_view>

namespace capstan {

/// Of a text that `parse_double` did not take, for a message: "'ab' is not a number", or "'1e999' is beyond
/// what a number can be (1.8e308 either way)"; a long text is cut short.
[[nodiscard]] std::string no_number(std::string_view text);

}  // namespace capstan
