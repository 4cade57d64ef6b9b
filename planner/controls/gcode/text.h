#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace capstan::controls::gcode {

/// The text of one comment line of a program: plain ASCII, no parentheses, cut off where it would make the
/// line longer than a control's.
[[nodiscard]] std::string comment_text(std::string_view text, std::size_t longest_line);

/// Plain ASCII without control characters and parentheses; others become `?` (one per character).
[[nodiscard]] std::string plain_text(std::string_view text);

/// Text that can stand in a comment, between quotes: what is not plain ASCII, and " % ( ) ; are
/// percent-encoded as in a URL. A text too long for a line is replaced by its hash.
[[nodiscard]] std::string marker_text(std::string_view text);

}  // namespace capstan::controls::gcode
