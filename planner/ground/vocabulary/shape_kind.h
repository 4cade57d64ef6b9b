#pragma once

#include <cstdint>
#include <span>
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
inline constexpr ShapeKind kLastShapeKind = ShapeKind::kToolpath;

/// What is true of every feature of a kind.
///
///     round       round about its frame's z axis: its size is a diameter
///     walled      walls stand on both sides of the cutter
///     outwards    the cutter may come from outside the raw piece, and its area has no outer wall
///     edge        lies along an edge of other features
///     floor       takes a depth of material: what lies on its floor comes after it
///     islands     material may stay standing in its area
///     rim         the edge round its area is broken by a cone that runs along it
///     clears      takes away its area times its depth
///     below_top   lies below the part's top: material above it is in the way
///     beyond      the cutter passes over the bounds of its area
enum class ShapeTrait : std::uint16_t {
  kRound = 1U << 0U,
  kWalled = 1U << 1U,
  kOutwards = 1U << 2U,
  kEdge = 1U << 3U,
  kFloor = 1U << 4U,
  kIslands = 1U << 5U,
  kRim = 1U << 6U,
  kClears = 1U << 7U,
  kBelowTop = 1U << 8U,
  kBeyond = 1U << 9U,
};

struct ShapeKindRow {
  ShapeKind value;
  std::string_view name;
  std::uint16_t traits;
};

/// In the order of the enumeration.
[[nodiscard]] std::span<const ShapeKindRow> shape_kinds();
[[nodiscard]] bool has(ShapeKind k, ShapeTrait t);
[[nodiscard]] std::string_view to_text(ShapeKind k);

}  // namespace capstan::model
