#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace capstan::controls::gcode {

/// A comment's text in as many lines as the control's longest asks for: plain ASCII, no parentheses, broken
/// at blanks, lines behind the first indented.
[[nodiscard]] std::vector<std::string> comment_lines(std::string_view text, std::size_t longest_line);

/// The text, or as many of its words as fit with "..." behind them.
[[nodiscard]] std::string shortened(const std::string& text, std::size_t longest);

/// Plain ASCII without control characters and parentheses; others become `?` (one per character).
[[nodiscard]] std::string plain_text(std::string_view text);

/// Text that can stand in a comment, between quotes: what is not plain ASCII, and " % ( ) ; are
/// percent-encoded as in a URL. A text too long for a line is replaced by its hash.
[[nodiscard]] std::string marker_text(std::string_view text);

}  // namespace capstan::controls::gcode
