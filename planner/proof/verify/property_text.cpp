#include <array>
#include <utility>

#include "planner/proof/verify/verify.h"

namespace capstan::verify {

std::string_view property_text(int number) {
  static constexpr std::array<std::pair<int, std::string_view>, 38> kTexts = {{
      {1, "All numbers are finite."},
      {2, "One length unit, stated once and never switched."},
      {3, "The work offset is explicit and defined."},
      {4, "Every tool exists in the library and in the magazine."},
      {5, "Loaded tool, length offset and radius offset are the same."},
      {6, "The tool table's unit is proven against a known length."},
      {7, "Tools are changed only retracted and with the spindle off."},
      {8, "Length compensation is active before the tool descends below clearance."},
      {9,
       "The volume swept by each rapid clears stock, part and fixtures, also when the axes do not arrive "
       "together."},
      {10, "No rapid descends into or onto material."},
      {11, "No gouge beyond tolerance."},
      {12, "Holder and shank clear stock and fixtures."},
      {13, "Axial contact stays within the flute length, reach within the stick-out."},
      {14, "No plunge with a tool that does not cut to centre; ramp angle and helix diameter are legal."},
      {15, "The spindle turns in the right direction before contact and while the tool is in the material."},
      {16, "Spindle speed is within the limits of machine and tool, cutting speed within the material's."},
      {17, "Torque and power are within the spindle's curve at that speed."},
      {18, "Every feed is above zero and within the limits of machine and tool."},
      {20, "Depth and width of cut are within the tool's limits."},
      {21, "The tool bends no further than a cut bears, and what the plan says of it keeps the tolerance."},
      {22, "Axis travel is respected, extrema of arcs included."},
      {23, "Both radii of an arc agree after rounding."},
      {24, "No accidental full or zero-length arc."},
      {25,
       "Cutter compensation: a lead-in longer than the radius, concave radii no smaller than the tool's, "
       "cancelled afterwards."},
      {26, "Cycles: peck above zero, R above the bottom, cancelled afterwards."},
      {27, "The full modal state is stated at each step's start, so that a restart is safe."},
      {28, "Precedence: faces first, roughing before finishing, drilling before what needs a hole."},
      {29, "Coolant as required."},
      {30,
       "The tool life that is left lasts for the cutting time, sister tools counted; no edge is burnt in its "
       "step."},
      {31, "Clamps are untouched, and the part stays held."},
      {32, "A clean end: retracted, spindle off, end mark."},
      {33, "The emitted text parses back to the plan's numbers."},
      {34, "Every feature is planned, or reported unplanned with the reason."},
      {35, "Every step with a cutter cuts, or follows a finished surface."},
      {36,
       "Of a planned feature nothing stays beyond its tolerance and the allowance that its last step "
       "states."},
      {37,
       "Planned features lie within the raw piece and open to above, and drilled holes run into neither "
       "its sides nor each other."},
      {38, "Features are read alike by the planner and by the check's own reading of the file."},
      {0, ""},
  }};
  for (const auto& [n, text] : kTexts) {
    if (n == number) return text;
  }
  return {};
}

}  // namespace capstan::verify
