#include <cmath>

#include "planner/model/plan/cutter/outline/outline.h"

// Cutters that are widest at the top: a tapered end mill by the angle of its flank, a face mill by its lead
// angle (ISO 13399: DC is measured at the tip, DCX = DC + 2 APMX tan PSIR). From a flat tip, whatever its
// corner or its inserts' rounding: what it cuts besides lies below the real cutter's.

namespace capstan::model::outline {
namespace {

double taper_of(const Cutter& c) {
  return c.cutter_class == CutterClass::kTaperedEndmill ? c.taper_angle_rad : 0.0;
}

double lean_of(const Cutter& c) {
  if (c.cutter_class == CutterClass::kTaperedEndmill) return taper_of(c);
  return c.cutter_class == CutterClass::kFacemill && c.maximum_depth_of_cut_mm > 0.0 ? c.lead_angle_rad : 0.0;
}

}  // namespace

Outline widening_outline() {
  return {[](const Cutter& c) { return lean_of(c) > 0.0; },
          [](const Cutter& c) {
            const double high = c.maximum_depth_of_cut_mm, lean = lean_of(c);
            const double top = c.cutting_diameter_mm + 2.0 * high * std::tan(lean);
            return geometry::cone_profile(top, 2.0 * lean, high, c.cutting_diameter_mm);
          },
          nullptr, &taper_of};
}

}  // namespace capstan::model::outline
