#pragma once

#include <string_view>
#include <vector>

namespace capstan::verify::fanuc {

/// A line of a program in the order in which it is run, and its number, from 1.
struct RunLine {
  std::string_view text;
  long number = 0;
};

/// The lines of a text as they stand.
[[nodiscard]] std::vector<RunLine> lines_of(std::string_view text);

/// The lines of a text, each block that is `M98 P` alone replaced by the blocks of that subprogram of the
/// same text, from behind its O to before its M99; they have the number of the block that calls them.
/// Subprograms stand behind the block of M30. Left as it is, for the reader to say that it is not followed: a
/// call with other words, of a subprogram that the text does not have or has twice, or whose O is also before
/// that M30 (the program itself has it), or within one; and all where more than `most` lines come of it. Not
/// for a Haas: its M98 calls a program of the control's list, and M97 a block of the same text. Source  FANUC
/// B-63844EN/02, 13.3; Haas 96-8000, M97, M98.
[[nodiscard]] std::vector<RunLine> run_lines(std::string_view text, std::size_t most);

}  // namespace capstan::verify::fanuc
