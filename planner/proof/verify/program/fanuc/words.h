#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace capstan::verify::fanuc {

struct Word {
  char letter = ' ';
  double value = 0.0;
  bool point = false;  ///< written with a decimal point
};

/// One block taken apart.
struct Line {
  std::vector<Word> words;
  std::vector<std::string> comments;
  std::size_t length = 0;  ///< characters without comments and the line's end
  bool percent = false;    ///< the end of the tape
  bool skipped = false;    ///< "/": passed over where the operator says so
  std::string fault;       ///< why the rest was not read; empty when all was
  bool unverifiable = false, no_number = false;
};

/// Reuses `out`'s storage.
void split_line(std::string_view text, Line& out);

}  // namespace capstan::verify::fanuc
