#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace capstan::testing {

/// One motion of a list of canonical machining functions, with the state it happens in.
struct CanonMove {
  enum class Kind { kTraverse, kFeed, kArc };
  Kind kind = Kind::kTraverse;
  double from_x = 0.0, from_y = 0.0, from_z = 0.0;
  double x = 0.0, y = 0.0, z = 0.0;  ///< end, mm
  double cx = 0.0, cy = 0.0;         ///< centre of an arc
  double sweep = 0.0;                ///< of an arc, rad; negative clockwise seen from +Z
  double feed_mm_min = 0.0;          ///< 0: none was set so far
  double rpm = 0.0;                  ///< negative counter-clockwise; 0 stopped
  bool flood = false;
  std::string tool;  ///< as named by the change
  std::string step;  ///< id of the marker before it, as written there; empty without markers
  long line = 0;     ///< of the list, from 1
};

/// What an interpreter made of a program: NIST's `.can` lists, and the output of LinuxCNC's rs274, which
/// call the same functions (NISTIR 6556, "The NIST RS274NGC Interpreter", canonical machining functions).
struct CanonProgram {
  std::vector<CanonMove> moves;
  std::vector<std::string> tools;  ///< in the order they are called
  bool ended = false;
};

[[nodiscard]] CanonProgram read_canon(std::string_view text);

/// Moves with what getting to and from a path is made of left out: traverses to `height_mm` or above, and
/// straight down from there. Consecutive arcs about one centre become one; motion without length goes.
[[nodiscard]] std::vector<CanonMove> motion_below(const std::vector<CanonMove>& moves, double height_mm);

}  // namespace capstan::testing
