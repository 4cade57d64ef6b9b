#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace capstan {

/// ASCII letters in lower case, all other bytes as they are.
[[nodiscard]] std::string lower_text(std::string_view text);

/// Length of the well-formed character of UTF-8 (RFC 3629) at a place of a text; 0: there is none.
[[nodiscard]] std::size_t utf8_length(std::string_view text, std::size_t at);
[[nodiscard]] bool is_utf8(std::string_view text);
/// The text with U+FFFD for each byte that is no UTF-8; of a longer one what is before the character that
/// byte `most` is of.
[[nodiscard]] std::string utf8_text(std::string_view text, std::size_t most = std::string_view::npos);

/// The text as it stands in XML and HTML, in attributes too: with & < > " as entities.
[[nodiscard]] std::string xml_escaped(std::string_view text);
/// Any bytes as `xml_escaped`, with what XML does not take replaced: control characters by blanks, bytes that
/// are no UTF-8 by U+FFFD, as are U+FFFE and U+FFFF (XML 1.0, 2.2).
[[nodiscard]] std::string xml_text(std::string_view text);

/// A length with its unit: mm_text(1.5) == "1.5 mm". At most `decimals` decimals.
[[nodiscard]] std::string mm_text(double value, int decimals = 3);

/// An angle in degrees with its unit: deg_text(pi / 4) == "45 deg". At most `decimals` decimals.
[[nodiscard]] std::string deg_text(double rad, int decimals = 1);

}  // namespace capstan
