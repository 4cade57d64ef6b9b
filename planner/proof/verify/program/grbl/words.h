#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace capstan::verify::grbl {

struct Word {
  char letter = ' ';  ///< upper case
  double value = 0.0;
};

/// One line taken apart.
struct Line {
  std::vector<Word> words;
  std::vector<std::string> comments;
  std::size_t length = 0;  ///< characters that Grbl keeps of it
  bool skips = false;      ///< a / stands in it, which Grbl passes over
  bool no_number = false;  ///< the fault is that a word has no number
  std::string fault;       ///< why the rest was not read; empty when all was
};

[[nodiscard]] Line split_line(std::string_view text);

}  // namespace capstan::verify::grbl
