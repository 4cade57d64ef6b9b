#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "tests/removal/simulation/point.h"

namespace capstan::testing::removal {

/// Above everything: where a tool is after a retract in machine coordinates.
inline constexpr double kFarAbove = 1e4;

/// One motion of the tip, in the coordinates of its set-up.
struct Motion {
  bool rapid = false;
  Point from, to;
  bool arc = false;
  double centre_x = 0.0, centre_y = 0.0;
  double sweep_rad = 0.0;  ///< of an arc; negative clockwise
  int tool = 0;            ///< in the spindle
  int setup = 1;           ///< as the marker says, from 1
  std::size_t step = 0;    ///< index into Motions::steps; 0 before the first marker
};

struct MarkedStep {
  std::string id;  ///< as the marker has it
  int tool = 0;    ///< as the marker says
};

struct Motions {
  int status = -1;  ///< of the interpreter
  std::string fault;
  std::vector<MarkedStep> steps;  ///< the first is a dummy: before all markers
  std::vector<Motion> moves;
};

/// What LinuxCNC's interpreter makes of a program. Tool lengths are those of the table: a program that takes
/// the length of another tool than that in the spindle comes out displaced by the difference.
[[nodiscard]] Motions read_motions(const std::string& program, const std::string& tool_table);

}  // namespace capstan::testing::removal
