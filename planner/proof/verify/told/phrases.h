#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace capstan::verify {

/// A word in capitals, a sign, or a number.
struct Phrase {
  std::string word;  ///< empty: a number
  double number = 0.0;
};

/// What a text says, however a control's programs write it: capitals or not, 30 or 30., ; or , and without
/// what such programs cannot hold (brackets, quotes, percent signs, characters that are not ASCII). A + or -
/// counts where it begins a word or a number, a colon always.
[[nodiscard]] std::vector<Phrase> phrases_of(std::string_view text);

/// Whether `part` stands in `whole` from there on; numbers within `unit` count as equal.
[[nodiscard]] bool stands_at(const std::vector<Phrase>& part, const std::vector<Phrase>& whole,
                             std::size_t from, double unit);

}  // namespace capstan::verify
