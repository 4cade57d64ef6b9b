#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace capstan::tooling {

/// A text in capital letters without accents, and where each character of it stands in the text: "gehärtet"
/// is "GEHAERTET", "N/mm²" is "N/MM2". What else is no letter, digit or sign of ASCII is a blank.
struct FoldedText {
  std::string text;
  std::vector<std::size_t> at;  ///< one more than `text` has: the last is the text's end
};
[[nodiscard]] FoldedText folded(std::string_view text);

}  // namespace capstan::tooling
