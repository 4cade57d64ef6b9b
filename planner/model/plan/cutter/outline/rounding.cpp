#include "planner/model/plan/cutter/outline/outline.h"

// Mills that round an edge: a hollow quarter of a circle from the flat tip out to the diameter.

namespace capstan::model::outline {

Outline rounding_outline() {
  return {[](const Cutter& c) {
            return c.cutter_class == CutterClass::kCornerRoundingMill && c.corner_radius_mm > 0.0;
          },
          [](const Cutter& c) {
            return geometry::rounding_profile(c.cutting_diameter_mm, c.corner_radius_mm,
                                              c.maximum_depth_of_cut_mm);
          }};
}

}  // namespace capstan::model::outline
