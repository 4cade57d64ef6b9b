#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace capstan::casebase::retain {

/// Which lines of a program belong to which workingstep, by the markers `(CAPSTAN STEP id="..." ... tool=..)`
/// that Capstan's programs carry, in comments of any control.
struct ProgramMark {
  long line = 0;   ///< of the marker, from 1: the step reaches to the next marker
  std::string id;  ///< of the workingstep, as the plan has it; "fnv1a:..." for one too long for a line
  long n = 0;      ///< the step's place in the plan, from 1; 0: not said
  int tool = 0;    ///< 0: not said
};
struct ProgramMarks {
  std::vector<ProgramMark> marks;  ///< by rising line
  long lines = 0;
  /// The step of a line; nullptr before the first marker.
  [[nodiscard]] const ProgramMark* at(long line) const;
  /// The last line of the step that begins at mark `i`.
  [[nodiscard]] long last_line(std::size_t i) const;
};

/// Reads the markers of a program's text. A program without any gives none.
[[nodiscard]] ProgramMarks program_marks(std::string_view program);

}  // namespace capstan::casebase::retain
