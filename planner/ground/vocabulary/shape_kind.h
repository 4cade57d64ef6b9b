#pragma once

#include <cstdint>
#include <span>
#include <string_view>

namespace capstan::model {

/// What kind of removal a feature is, whatever noun it came from. The rows are in shape_kinds.inc.
enum class ShapeKind : std::uint8_t {
#define CAPSTAN_SHAPE_KIND(Kind, name, traits) k##Kind,
#include "planner/ground/vocabulary/shape_kinds.inc"
#undef CAPSTAN_SHAPE_KIND
};

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
///     swept       a section along a spine: its floor is that of the section
///     surface     its floor is no plane: rules ask for the curvature of its surface
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
  kSwept = 1U << 10U,
  kSurface = 1U << 11U,
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
