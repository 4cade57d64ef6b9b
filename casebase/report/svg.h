#pragma once

#include <string>
#include <string_view>

/// What the pictures of the case base share.
namespace capstan::casebase {

/// A text element at (x, y), its text escaped; `more`: further attributes.
[[nodiscard]] std::string svg_words(double x, double y, std::string_view text, std::string_view more = {});
/// The head of a picture of this size on white, and its closing tag is "</svg>\n".
[[nodiscard]] std::string svg_head(double width, double height);

}  // namespace capstan::casebase
