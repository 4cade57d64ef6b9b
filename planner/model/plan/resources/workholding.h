#pragma once

#include <string>
#include <vector>

#include "planner/ground/geometry/vec.h"

namespace capstan::model {

/// An upright prism that stands on the table while a set-up is cut: a jaw, a clamp's finger, a plate.
///
/// Frame   the set-up's, mm. `outline` is closed, counter-clockwise, without its first point repeated.
struct FixtureSolid {
  std::string id;    ///< "vise.fixed_jaw", "clamp 1"
  std::string kind;  ///< "jaw", "soft_jaw", "clamp", "plate", "body", "stop"
  std::vector<geometry::Vec2> outline;
  double bottom_mm = 0.0, top_mm = 0.0;
  bool presses = false;  ///< it holds the piece: where it touches must stay uncut
  friend bool operator==(const FixtureSolid&, const FixtureSolid&) = default;
};

/// How the workpiece is held in one set-up, as geometry. Without solids nobody has said how.
struct Workholding {
  std::string id;  ///< of the library's fixture; empty: none stated
  std::string description, source;
  std::vector<FixtureSolid> solids;
  geometry::Vec3 pickup;         ///< the datum that the work offset is taken from, set-up frame
  std::string pickup_text;       ///< "lower left corner of the raw piece against the fixed jaw, Z at its top"
  double clearance_mm = 0.0;     ///< kept between tools and solids
  double holding_force_n = 0.0;  ///< against sliding; 0 unknown
  friend bool operator==(const Workholding&, const Workholding&) = default;
};

}  // namespace capstan::model
