#pragma once

#include <cstdint>
#include <string_view>

namespace capstan::model {

/// What kind of removal a feature is, whatever noun it came from.
enum class ShapeKind : std::uint8_t {
  kFace,          ///< planar_face: everything above a plane, within an area
  kPocket,        ///< closed_pocket, open_pocket: an area with walls, to a depth; islands stay
  kSlot,          ///< slot: a profile swept along a path
  kStep,          ///< step: a corner of the part taken away, open on two sides or more
  kHole,          ///< round_hole and what compounds are made of
  kOutside,       ///< general_outside_profile, shape profiles, boss: the outside of a contour, to a depth
  kChamfer,       ///< chamfer along an edge
  kEdgeRound,     ///< edge_round along an edge
  kThread,        ///< thread in (or on) another feature
  kSphericalCap,  ///< a dome that stays, or a dish
  kRoundedEnd,    ///< the rounded end of a part
  kFreeform,      ///< region: a surface
  kToolpath,      ///< toolpath_feature: nothing but paths
};
[[nodiscard]] std::string_view to_text(ShapeKind k);

}  // namespace capstan::model
