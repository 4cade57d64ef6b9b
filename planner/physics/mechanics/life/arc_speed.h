#pragma once

#include <string_view>

#include "planner/ground/vocabulary/cutter_class.h"

/// Cutting speed by how long an edge is in the cut.
namespace capstan::mechanics {

/// Width of cut from which a table's speed holds as it is, over the diameter: an edge is in the cut for a
/// quarter of its turn or more.
inline constexpr double kWholeSpeedWidth = 0.5;

/// How much faster than a table's speed an edge may be where the cut is narrow, for the same life: it heats
/// up for a shorter part of its turn and cools for a longer one.
///
///     width / diameter    5 %    10 %   15 %   20 %   25 %    30 %    40 %    50 % and more
///     groups P, M, K, H   1.48   1.35   1.27   1.22   1.19    1.16    1.11    1.00
///     group S             1.48   1.35   1.27   1.22   1.189   1.136   1.057   1.00
///
/// Linear between; below 5 % as at 5 %. 1 in ISO 513 group N and in plastics, where not the heat of the edge
/// bounds the speed, in a material without a group, and for high-speed steel, for the sources are of carbide.
///
/// Needs   a width above 0; else 1.
/// Source  P, M, K: Dormer Pramet, milling catalogue 2021-22, p. 114, correction factors of solid carbide
///         mills, 2 shoulder milling, x.v. Widia's trochoidal brochure, p. 7, gives as much or more, of no
///         group of its own: 1.1 at 40 %, 1.2 at 30 %, 1.3 at 20 %, 1.4 at 10 %, 2.5 at 5 %.
///         H and titanium: Tungaloy, general catalogue 2020-2021, p. 1084 (solid end mills; from 40 %, 10 to
///         40 %, 5 to 10 %): hardened steel 25, 50, 60 m/min, titanium alloys 35, 50, 60 m/min in the middle,
///         where carbon steel has 160, 185, 225: both rise more than carbon steel does, which Dormer Pramet's
///         factors are of. S: titanium moreover no more than Tatar, Sjoeberg and Andersson, Heliyon 6 (2020)
///         e04217: Ti6Al4V, coated carbide, 10 to 70 %, life as vc^-4 ae^-1, so that at the same life
///         speed / table = (50 % / width)^(1/4). Nickel alloys: of Widia's general factors alone.
[[nodiscard]] double speed_by_arc(double width_mm, double diameter_mm, model::Substrate substrate,
                                  std::string_view iso_group);

}  // namespace capstan::mechanics
