#include <string>

#include "planner/controls/siemens/siemens.h"
#include "planner/ground/base/number.h"

// Faces as CYCLE71. Its list, and what its parameters are: SINUMERIK 808D, programming and operating manual
// (milling), 07/2018, 6FC5398-4DP10-0BA7, 12.6.2, as a public copy of its pages has it; that 840D sl takes it
// as its own manual's cycles 11/2006 do, and how it runs: remembered, as
// tests/controls/siemens/golden/README.md says.

namespace capstan::controls::siemens {
namespace {

// _VARI, ones: roughing, down to the allowance; tens: back and forth along the abscissa or the ordinate.
constexpr const char *kRoughAlongX = "31", *kRoughAlongY = "41";

/// CYCLE71(_RTP, _RFP, _SDIS, _DP, _PA, _PO, _LENG, _WID, _STA, _MID, _MIDA, _FDP, _FALD, _FFP1, _VARI,
/// _FDP1). _STA is 0: what is along the abscissa of a rectangle that is turned need not be known. _FDP1 is 0:
/// the rectangle itself is wider than the face.
std::string face_text(const gcode::FaceCycle& c) {
  const auto n = [&](double v) { return trimmed(v, c.decimals) + ","; };
  const geometry::Vec2 size = c.hi - c.lo;
  return "CYCLE71(" + n(c.back_z) + n(c.reference_z) + n(c.start_z - c.reference_z) + n(c.floor_z) +
         n(c.lo.x) + n(c.lo.y) + n(size.x) + n(size.y) + "0," + n(c.level_mm) + n(c.over_mm) + n(c.out_mm) +
         n(c.bottom_mm) + trimmed(c.feed_mm_min, c.feed_decimals) + "," +
         (c.along_y ? kRoughAlongY : kRoughAlongX) + ",0)";
}

}  // namespace

constinit const gcode::FaceWords kFaces{.text = &face_text};

}  // namespace capstan::controls::siemens
