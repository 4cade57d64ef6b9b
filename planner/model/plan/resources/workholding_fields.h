#pragma once

#include "planner/model/plan/fields.h"
#include "planner/model/plan/resources/workholding.h"

// The fields of how a workpiece is held. A new one is a member and a row here.

namespace capstan::model {

// clang-format off
template <>
inline constexpr auto kFields<geometry::Vec2> = std::tuple{
    field("x", &geometry::Vec2::x, Unit::kLength).record("x"),
    field("y", &geometry::Vec2::y, Unit::kLength).record("y"),
};
template <>
inline constexpr auto kFields<geometry::Vec3> = std::tuple{
    field("x", &geometry::Vec3::x, Unit::kLength).record("x"),
    field("y", &geometry::Vec3::y, Unit::kLength).record("y"),
    field("z", &geometry::Vec3::z, Unit::kLength).record("z"),
};
template <>
inline constexpr auto kRecordParts<FixtureSolid> = std::array<RecordPart, 2>{};
template <>
inline constexpr auto kFields<FixtureSolid> = std::tuple{
    field("id", &FixtureSolid::id).record("id"),
    field("kind", &FixtureSolid::kind).record("kind"),
    field("outline", &FixtureSolid::outline).record("corner", 1),
    field("bottom_mm", &FixtureSolid::bottom_mm, Unit::kLength).record("bottom"),
    field("top_mm", &FixtureSolid::top_mm, Unit::kLength).record("top"),
    field("presses", &FixtureSolid::presses).record("presses"),
};

/// The pieces of a holding's record, in order: one group, and the solids.
enum HoldingPart : std::size_t { kHoldingNames, kHoldingPickupText, kHoldingPickup, kHoldingSolids, kHoldingParts };
template <>
inline constexpr auto kRecordParts<Workholding> = [] {
  std::array<RecordPart, kHoldingParts> out{};
  out[kHoldingNames] = {.opens = true};
  out[kHoldingPickup] = {.closes = true};
  return out;
}();
template <>
inline constexpr auto kFields<Workholding> = std::tuple{
    field("id", &Workholding::id).record("fixture", kHoldingNames),
    field("description", &Workholding::description).record("fixture description", kHoldingNames),
    field("source", &Workholding::source).record("fixture source", kHoldingNames),
    field("solids", &Workholding::solids).record("solid", kHoldingSolids),
    field("pickup", &Workholding::pickup).record("pickup", kHoldingPickup),
    field("pickup_text", &Workholding::pickup_text).record("pickup", kHoldingPickupText),
    field("clearance_mm", &Workholding::clearance_mm, Unit::kLength).record("clearance", kHoldingPickup),
    field("holding_force_n", &Workholding::holding_force_n).record("holding force [N]", kHoldingPickup),
};
// clang-format on

static_assert(has_row_per_member<FixtureSolid>() && has_row_per_member<Workholding>(),
              "a field of the workholding has no row in workholding_fields.h, or two");

}  // namespace capstan::model
