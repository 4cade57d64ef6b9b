#pragma once

#include <optional>

#include "planner/ground/geometry/profile.h"
#include "planner/physics/stock/height_map.h"

namespace capstan::engagement {

/// The round of a ball or bull nose: about a circle of radius `centre_mm` around the axis.
struct RoundNose {
  double cutter_mm = 0.0;  ///< radius of the cutter
  double round_mm = 0.0;   ///< radius of the ball or corner
  double centre_mm = 0.0;  ///< 0: a ball
};
/// Nothing for an outline that is not a ball's or a bull nose's.
[[nodiscard]] std::optional<RoundNose> round_nose(const geometry::CutterProfile& profile);

/// The thickest chip of a round nose over its feed per tooth: the largest component along the feed of the
/// normal of the cutter's surface where material of the map stands over that surface,
///
///     h = fz (f . n)        n = (sin k cos a, sin k sin a, -cos k), k from the axis
///
/// On a slope that the cutter follows this is the chip of the layer that it takes, as on a level floor: up
/// hill the contact lies high on the round, but the feed runs along the surface.
///
/// Frame     that of the map; `tip` is the lowest point of the cutter, `feed` of length 1. Nothing stands
/// over
///           `ceiling_mm` there, which saves time only.
/// `known`   a share that is had already, 0 .. 1: the larger of both is said. Saves time only.
/// Range     0 .. 1; 0 where nothing stands in the way.
/// Accuracy  cells count when their middles do: the truth may be larger by a cell over the round's radius,
///           which the caller adds.
/// Source    derived: chip thickness is the feed's component normal to the edge's surface (Altintas,
///           Manufacturing Automation, 2nd ed., section 2.7, for a level feed: fz sin a sin k).
[[nodiscard]] double chip_over_feed(const stock::HeightMap& map, const RoundNose& nose, geometry::Vec3 tip,
                                    geometry::Vec3 feed, double ceiling_mm = 1e300, double known = 0.0);

}  // namespace capstan::engagement
