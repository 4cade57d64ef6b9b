#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "planner/ground/geometry/profile.h"
#include "planner/ground/geometry/vec.h"
#include "planner/model/plan/cutter_path.h"
#include "planner/physics/stock/height_map.h"

namespace capstan::stock {

/// A piece of a move of the cutter's tip: straight, or an arc of at most a half turn in the XY plane.
struct Track {
  geometry::Vec3 from, to;
  bool arc = false;
  geometry::Vec2 centre;  ///< of the arc
  bool clockwise = false;
  double ceiling_mm = 1e300;  ///< no material under the track is higher (z); saves time only
};

/// Removal of a sweep, in the section frame of the track: X across (negative left of the feed), Y along the
/// axis from the lowest tip height of the track.
struct Tally {
  static constexpr std::size_t kBins = 64;  ///< across the cutter's diameter
  double removed_mm3 = 0.0;
  double sum_x = 0.0, sum_y = 0.0;            ///< of removed volume times X, Y; mm4
  double left_mm = 1e300, right_mm = -1e300;  ///< X range of what was touched, whole cells, within the radius
  /// Heights above the map's floor between which material was touched, per bin of X; low > high: none.
  std::array<float, kBins> low{}, high{};
  Tally() {
    low.fill(1e30F);
    high.fill(-1e30F);
  }
};

/// Takes away what the cutter passes through while its tip follows the track: the exact lower envelope of the
/// rotating outline over the track, not a row of stamps; for level arcs too. A rising or falling arc is taken
/// as chords within a twentieth of a cell.
///
/// `behind_is_cut`  the cutter was at track.from before, with the same profile and no material added since:
///                  cells behind it are skipped. Saves time only.
/// `heading`        feed direction that X is measured against on a vertical track; any length but 0.
/// Needs            a profile whose height does not fall and is convex in r (as geometry/profile.h says).
/// Units            mm. No allocation.
/// Accuracy         level tracks are computed in single precision from the track: heights are good to about
///                  1e-6 of the cutter's diameter; the same on every processor.
void sweep(HeightMap& map, const geometry::CutterProfile& profile, const Track& track, bool behind_is_cut,
           geometry::Vec2 heading, Tally& tally);

/// How deep the cutter has been where it stands upright. Moves straight up and down above that take nothing,
/// whatever is left in cells that are coarse for the cutter.
class Upright {
 public:
  /// Whether move i only goes where the cutter has been since it came to this place. Asked of each entry of
  /// the path once, in order; entry 0 is where it comes.
  [[nodiscard]] bool goes_back(const model::CutterPath& path, std::size_t i);

 private:
  double lowest_mm_ = 0.0;
};

/// Cuts move i of the path; returns the removed volume, mm3. Dwells and entry 0 cut at the tool's position.
double cut(HeightMap& map, const geometry::CutterProfile& profile, const model::CutterPath& path,
           std::size_t i);
/// Cuts the whole path, rapids included, but for moves on which the cutter goes back (Upright); mm3.
double cut(HeightMap& map, const geometry::CutterProfile& profile, const model::CutterPath& path);

/// Height of the swept surface over a cell beside a straight sloping track: the least of
/// z(u) + profile(distance) over the track, +inf out of reach.
/// `along` and `across` place the cell against the track's start, horizontal; `length` and `rise` are the
/// track's.
[[nodiscard]] double swept_height(const geometry::CutterProfile& profile, double along, double across,
                                  double length, double rise);

}  // namespace capstan::stock
