#pragma once

#include <string>
#include <string_view>

namespace capstan {

/// ASCII letters in lower case, all other bytes as they are.
[[nodiscard]] std::string lower_text(std::string_view text);

/// The text as it stands in XML and HTML, in attributes too: with & < > " as entities.
[[nodiscard]] std::string xml_escaped(std::string_view text);

/// A length with its unit: mm_text(1.5) == "1.5 mm". At most `decimals` decimals.
[[nodiscard]] std::string mm_text(double value, int decimals = 3);

/// An angle in degrees with its unit: deg_text(pi / 4) == "45 deg". At most `decimals` decimals.
[[nodiscard]] std::string deg_text(double rad, int decimals = 1);

}  // namespace capstan
