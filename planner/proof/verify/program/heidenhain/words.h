#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace capstan::verify::heidenhain {

/// One block of a program in conversational language, taken apart at its blanks: "L", "X+10", "R0", "FMAX".
struct Line {
  std::vector<std::string> words;  ///< without number and comments; those of all its lines
  std::vector<std::string> comments;
  std::optional<long> number;  ///< of the block
  std::size_t length = 0;      ///< characters of its longest line, without comment
  bool skipped = false;        ///< "/": passed over where the operator says so
  bool structure = false;      ///< "* - ...": a heading
  bool goes_on = false;        ///< a ~ at the end: the next line belongs to it
  std::string fault;           ///< why the rest was not read; empty when all was
};

/// Adds one line of the text to `out`, which is empty or goes on.
void add_line(std::string_view text, Line& out);

/// The number behind `letters` of a word, "X+10.5" behind "X"; nothing where the word begins otherwise or no
/// number follows.
[[nodiscard]] std::optional<double> number_behind(std::string_view word, std::string_view letters);

}  // namespace capstan::verify::heidenhain
