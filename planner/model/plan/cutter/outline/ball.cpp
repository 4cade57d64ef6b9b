#include "planner/model/plan/cutter/outline/outline.h"

namespace capstan::model::outline {

Outline ball_outline() {
  return {[](const Cutter& c) { return has(c.cutter_class, CutterTrait::kBall); },
          [](const Cutter& c) {
            return geometry::ball_profile(c.cutting_diameter_mm, c.maximum_depth_of_cut_mm);
          },
          [](const Cutter& c) { return 0.5 * c.cutting_diameter_mm; }};
}

}  // namespace capstan::model::outline
