#pragma once

#include <vector>

#include "planner/model/plan/cutter/cutter.h"

namespace capstan::model::outline {

/// An outline that a class of cutter has: whether it is a cutter's, by its class and by the sizes that it
/// states; and the outline, mm. What none of them describes is a flat end with rounded corners.
struct Outline {
  bool (*describes)(const Cutter& c);
  geometry::CutterProfile (*of)(const Cutter& c);
  /// The radius of its rounded end, mm, by which it is loaded and by which its speed is counted; null: that
  /// of its corners.
  double (*end_radius_mm)(const Cutter& c) = nullptr;
  /// How far its flank leans outwards from the axis, rad, by which it is loaded and bends; null: it stands
  /// upright.
  double (*flank_lean_rad)(const Cutter& c) = nullptr;
};

/// Of the files of this folder, each NAME_outline(), by their names. At most one describes a cutter.
[[nodiscard]] std::vector<Outline> outlines();

}  // namespace capstan::model::outline
