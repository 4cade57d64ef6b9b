#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace capstan::verify::linuxcnc {

struct Word {
  char letter = ' ';  ///< upper case
  double value = 0.0;
};

/// One line taken apart.
struct Line {
  std::vector<Word> words;
  std::vector<std::string> comments;
  std::string command;  ///< what LinuxCNC carries out of the line's comments, "ABORT"; empty: nothing
  bool percent = false, deleted = false, semicolon = false;
  std::string fault;          ///< why the rest was not read; empty when all was
  bool unverifiable = false;  ///< the fault is something this reader does not follow
  bool no_number = false;     ///< the fault is that a word has no number that LinuxCNC reads
};

/// Reuses `out`'s storage.
void split_line(std::string_view text, Line& out);

}  // namespace capstan::verify::linuxcnc
