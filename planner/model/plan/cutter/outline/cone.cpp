#include "planner/model/plan/cutter/outline/outline.h"

// Drills, countersinks, chamfer mills: a cone up to the diameter, from a point or from a flat tip.

namespace capstan::model::outline {

Outline cone_outline() {
  return {[](const Cutter& c) { return has(c.cutter_class, CutterTrait::kCone) && c.point_angle_rad > 0.0; },
          [](const Cutter& c) {
            return geometry::cone_profile(c.cutting_diameter_mm, c.point_angle_rad, c.maximum_depth_of_cut_mm,
                                          c.tip_diameter_mm);
          }};
}

}  // namespace capstan::model::outline
