#pragma once

#include <optional>
#include <vector>

#include "planner/ground/base/result.h"
#include "planner/model/plan/cutter/cutter.h"
#include "planner/model/plan/cutter_path.h"
#include "planner/physics/stock/height_map.h"

namespace capstan::engagement {

/// How the cutter is engaged over one sample's step: what force models ask for.
struct Engagement {
  double ap_mm = 0.0;      ///< axial depth: largest height of contact in any column along the axis
  double ae_mm = 0.0;      ///< radial width across the feed; a plunge: width of the contact seen from above
  double entry_rad = 0.0;  ///< where a clockwise-turning tooth meets and leaves material, measured in the
  double exit_rad = 0.0;   ///< turning sense from the left of the feed (0) over its front (pi/2) to its right
                           ///< (pi); taken at the full radius. Plunge: 0 and 2 pi.
  double arc_rad =
      0.0;  ///< angle of contact: exit - entry less what lies free between, as beside a thin wall
  double csa_mm2 = 0.0;  ///< removed volume per length of path
  double removed_mm3 = 0.0;
  double step_mm = 0.0;  ///< length of path that the sample represents, up to its point
  bool plunge = false;   ///< the move goes straight along the axis
  /// Of a ball or bull nose on a straight move: its thickest chip over the feed per tooth (front.h), a cell's
  /// doubt included; 0: not measured.
  double chip_over_feed = 0.0;
  friend bool operator==(const Engagement&, const Engagement&) = default;
};

struct Options {
  /// Path length between samples, mm; 0: a fortieth of the diameter, but at least two cells.
  double step_mm = 0.0;
};

/// Height of a head behind which the body is thinner, mm: nothing over it is cut. None: the flanks go up.
[[nodiscard]] std::optional<double> head_height(const model::Cutter& c);

/// Two parallel series, and what a checker wants to know of the whole path.
struct Measurement {
  model::SectionSeries sections;
  std::vector<Engagement> engagement;
  double removed_mm3 = 0.0;         ///< at feed
  double rapid_removed_mm3 = 0.0;   ///< by rapids: more than nothing is a collision
  double highest_contact_mm = 0.0;  ///< above the tip, at feed: to be held against the cutting length
  /// To what length along the path it is known where contact begins and ends: a cell is cut when its middle
  /// is met. 0: exactly.
  double known_to_mm = 0.0;
};

/// The area of a height map that `measure` looks at along a path; heights are 0. It reaches beyond the disc's
/// own way, since whether an arc meets anything is judged by a band or a disc about it.
[[nodiscard]] geometry::Box3 looked_at(const model::CutterPath& path, double radius_mm);

/// Measures the cut along a path and takes what it cuts from the stock.
///
/// One sample is made at the end of each step; its numbers are those of the step (means over it, for depths
/// the extreme). The volume that a step removes, projected along the feed, is the contact section: CSA is
/// removed volume over length, its centre of gravity that of the removed volume. This is exact for any
/// rotating outline and any stock in the limit of small steps. On a plunge the section is the contact area
/// seen along the axis; X is then measured across the last horizontal feed.
///
/// ADmax and RDmax are the greatest extents of contact along Y and across X; Ymaxofs and Xmaxofs are the
/// middles of those extents. Steps in air give no sample, but one empty sample closes each cut.
/// On a plunge ADmax is the height of the contact (a cone's length, the step's advance for a flat tip).
///
/// Angles are those of the X extremes of contact, whatever the depth, at the full radius. Where contact lies
/// at several depths they span all of it: entry is the first, exit the last. Contact in separate arcs (a wall
/// or the air between) has entry and exit outermost and an arc_rad less than their difference.
///
/// Frame    path and stock in the set-up's.
/// Units    mm.
/// Fails    ENG-PROFILE for a cutter without diameter or with an invalid outline; ENG-NUMBER if a coordinate
///          is not finite or farther than a hundred metres; ENG-UNDERCUT for T-slot, dovetail and back
///          cutters, and for side and thread mills with material above their head: a height map cannot hold
///          such a cut. The stock is then unchanged.
/// Accuracy cells of D/100: README.md. Angles: those of X known to a cell or, for an even layer, to that of
/// CSA. Source   AP238 edition 2, 4.2.379.4; CSA and centre derived by the divergence theorem.
[[nodiscard]] Result<Measurement> measure(const model::CutterPath& path, const model::Cutter& cutter,
                                          stock::HeightMap& stock, const Options& options = {});

}  // namespace capstan::engagement
