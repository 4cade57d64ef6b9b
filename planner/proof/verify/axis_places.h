#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "planner/proof/verify/verify.h"

namespace capstan::verify {

/// Where the axes of a running machine may be, and where its work offsets lie. Machine coordinates, mm.
struct AxisPlaces {
  struct Range {
    std::size_t axis = 0;  ///< of Machine::axes
    double least_mm = 0.0, most_mm = 0.0;
  };
  struct Offset {
    std::string name;  ///< "G54", as the program names it; empty: of whichever it names and no other has
    geometry::Vec3 at_mm;
  };
  std::vector<Range> ranges;
  std::vector<Offset> offsets;
};

/// The moves of a program, rapids and those in machine coordinates among them, that take an axis out of its
/// range: of each step and axis the farthest (CHK-PLACE-X, …), property 22. X and Y of a place are the work
/// offset's and the program's together; Z, that of the spindle's gage line, the tool's length as well. What
/// cannot be placed is an error, too: an offset that is not told, a length that does not count from the gage
/// line, a zero of Z that is set with each tool (`touches_off`), a coordinate that is not known; and a
/// program of which the reader does not follow all (CHK-PLACE, with line and code). Between two places that
/// are within all ranges a straight move is.
[[nodiscard]] std::vector<model::Finding> check_axis_places(const ProgramText& text, const model::Plan* plan,
                                                            const model::Machine& machine,
                                                            const std::vector<model::Cutter>& cutters,
                                                            const AxisPlaces& places);

}  // namespace capstan::verify
