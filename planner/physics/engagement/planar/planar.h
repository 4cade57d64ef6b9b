#pragma once

#include <string>

#include "planner/physics/engagement/engagement.h"
#include "planner/physics/stock/planar/planar_stock.h"

namespace capstan::engagement {

/// As `measure` with a height map (engagement.h), by geometry instead of cells: at each place of the path the
/// front half of the cutter's circle is intersected with the trails of earlier moves, and the result is
/// integrated along each step. Removes the cut from the stock.
///
/// Removed volume and CSA are integrals over the step, X and Y of the centre of gravity too; depths, widths
/// and angles are the extremes over it. A contact less than kSliver wide counts in volume, not in extents.
///
/// Frame     path and stock in the set-up's.
/// Units     mm.
/// Accuracy  level cuts of flat cutters: 1e-6 of D times ap; ramps and helices, and level cuts into floors
///           that those or points of drills left: 1e-3 of it, from their floors in strips; ramps over edges
///           of what stands under the tip: 3e-3 of the volume, from lines across it; plunges into material
///           that is cut already: 1e-3 of the cutter's area times the advance. Peak CSA and width of ramps
///           round a ring: 1e-3 of those that unbounded halving gives (tested; measured: 5e-4 at most). On
///           the rings that were tried no bound on halvings is reached; where one is, the section is what the
///           last halving tells.
/// Cost      by what lies near the cutter; see planner/physics/engagement/README.md.
/// Fails     ENG-PROFILE, ENG-NUMBER, ENG-UNDERCUT as there; ENG-NOT-PLANAR for a cutter that is not flat
///           below and does more than plunge, for one with a head (engagement.h), and on a stock that was
///           lost. Then nothing is cut.
[[nodiscard]] Result<Measurement> measure(const model::CutterPath& path, const model::Cutter& cutter,
                                          stock::PlanarStock& stock, const Options& options = {});

/// Contacts narrower than this are traces of rounding, mm.
inline constexpr double kSliver = 1e-3;

}  // namespace capstan::engagement
