#pragma once

#include <string>
#include <string_view>

namespace capstan::controls {

/// One comment line of a program, `(text)` and a line end: plain ASCII, no nested parentheses, and short
/// enough for the interpreter's line of 255 characters.
[[nodiscard]] std::string comment_line(std::string_view text);

/// Plain ASCII without control characters and parentheses; others become `?` (one per character).
[[nodiscard]] std::string plain_text(std::string_view text);

}  // namespace capstan::controls
