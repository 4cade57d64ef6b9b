#include "planner/model/features/shape.h"

namespace capstan::model {

bool same_form(const FeatureShape& a, const FeatureShape& b) {
  if (a.kind != b.kind || a.depth_mm != b.depth_mm || a.depth_tolerance != b.depth_tolerance) return false;
  if (a.through != b.through || a.open != b.open || a.islands.size() != b.islands.size()) return false;
  const bool walls = a.corner_radius_mm == b.corner_radius_mm && a.bottom_radius_mm == b.bottom_radius_mm &&
                     a.slope_rad == b.slope_rad && a.width == b.width && a.slot_profile == b.slot_profile;
  const bool hole = a.diameter == b.diameter && a.bottom_diameter_mm == b.bottom_diameter_mm &&
                    a.bottom == b.bottom && a.bottom_angle_rad == b.bottom_angle_rad &&
                    a.bottom_hole_radius_mm == b.bottom_hole_radius_mm;
  const bool thread = a.thread_major_mm == b.thread_major_mm && a.thread_pitch_mm == b.thread_pitch_mm &&
                      a.thread_depth_mm == b.thread_depth_mm;
  return walls && hole && thread;
}

}  // namespace capstan::model
