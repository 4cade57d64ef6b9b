#pragma once

#include <cstddef>
#include <vector>

#include "planner/ground/geometry/vec.h"
#include "planner/ground/vocabulary/move_kind.h"

namespace capstan::model {

/// What the cutter's reference point (its tip on the axis) does in one workingstep: columns, one entry per
/// move; move i runs from point i-1 to point i, entry 0 is the start and has no move. Arcs are kept as arcs.
///
/// Frame  the set-up's (the work offset's), z along the tool axis, away from the work.
/// Units  mm.
/// Shape  all columns have size() entries; cx, cy hold an arc's centre (absolute), 0 elsewhere.
/// Arcs   the swept angle is in (0, 2 pi]; equal start and end in XY is a full turn.
struct CutterPath {
  std::vector<double> x, y, z;
  std::vector<double> cx, cy;
  std::vector<MoveKind> kind;
  std::vector<MoveRole> role;

  [[nodiscard]] std::size_t size() const { return x.size(); }
  [[nodiscard]] geometry::Vec3 point(std::size_t i) const { return {x[i], y[i], z[i]}; }
  void start(geometry::Vec3 p);
  void line(geometry::Vec3 to, MoveRole why);
  void rapid(geometry::Vec3 to, MoveRole why = MoveRole::kLink);
  void arc(geometry::Vec3 to, geometry::Vec2 centre, bool clockwise, MoveRole why);
  void dwell();  ///< at the last point
  friend bool operator==(const CutterPath&, const CutterPath&) = default;
};

/// Angle swept by the arc of move i, rad, in (0, 2 pi]. Needs an arc.
[[nodiscard]] double arc_sweep(const CutterPath& path, std::size_t i);
/// Length of move i, mm (helix included); 0 for a dwell and for entry 0.
[[nodiscard]] double move_length(const CutterPath& path, std::size_t i);
/// The point of move i at fraction t in [0, 1] of its length.
[[nodiscard]] geometry::Vec3 point_on_move(const CutterPath& path, std::size_t i, double t);
/// Box of all points, extrema of arcs included.
[[nodiscard]] geometry::Box3 bounds(const CutterPath& path);

/// Feed and speed along a path: one entry per move, parallel to the CutterPath.
struct FeedSchedule {
  std::vector<double> feed_mm_min;  ///< ignored for rapids
  std::vector<double>
      spindle_rpm;              ///< positive: clockwise (M3); negative: counter-clockwise (M4); 0: stopped
  std::vector<double> dwell_s;  ///< of kDwell moves
  friend bool operator==(const FeedSchedule&, const FeedSchedule&) = default;
};

/// The cross-section parameters of AP238 (4.2.379.4) along a path, sampled by arc length: columns.
/// Section perpendicular to the feed, X across (left of the feed is negative), Y along the axis, from the
/// tool centre. Empty where the tool does not cut.
struct SectionSeries {
  std::vector<std::uint32_t> move;  ///< which move the sample lies on
  std::vector<double> at_mm;        ///< arc length from the start of that move
  std::vector<double> ad_max_mm, rd_max_mm, x_max_ofs_mm, y_max_ofs_mm, csa_mm2, x_cg_ofs_mm, y_cg_ofs_mm;
  std::vector<double> removed_mm3;  ///< since the sample before
  [[nodiscard]] std::size_t size() const { return move.size(); }
  friend bool operator==(const SectionSeries&, const SectionSeries&) = default;
};

}  // namespace capstan::model
