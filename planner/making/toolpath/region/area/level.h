#pragma once

#include <optional>
#include <vector>

#include "planner/making/toolpath/link/path_writer.h"
#include "planner/making/toolpath/region/area/inside.h"
#include "planner/making/toolpath/region/area/rings.h"
#include "planner/making/toolpath/region/area/work_area.h"

namespace capstan::toolpath {

/// One height of a 2.5D pattern.
struct Level {
  Level(const PathJob& task, const WorkArea& w, double tip_z, double material_z, double allowance);

  double z_mm;          ///< of the tip
  double from_mm;       ///< top of the material at this level
  double above_mm;      ///< of the level before; above `from_mm` where an earlier step has cleared this one
  double allowance_mm;  ///< left on the walls
  geometry::Region centres;         ///< where the cutter's centre may be
  Inside inside;                    ///< the same, larger by kInsideSlack
  Inside material;                  ///< outline of what is not air
  std::optional<Inside> cleared;    ///< finishing: centres at which nothing was left to cut
  std::vector<geometry::Vec2> air;  ///< centres at which the cutter touches no material, if any
};
/// Rings lie on the boundary of the centres; tests of inclusion use a region this much larger, mm.
inline constexpr double kInsideSlack = 0.002;

/// Radii of the helix by which a cutter may go down, mm.
struct HelixRadii {
  double least = 0.0;  ///< default, unsourced; larger where the edges do not reach the centre
  double usual = 0.0;
  double most = 0.0;  ///< beyond, a core stays that nothing cuts
};
[[nodiscard]] HelixRadii helix_radii(const model::Cutter& c);

/// State and moves that the patterns share: the writer, the job, links between passes, ways into the
/// material.
class LevelCutter {
 public:
  LevelCutter(const PathJob& task, const WorkArea& area, PathWriter& writer, Job& job);

  /// Brings the cutter onto the track at the level's height, by the best legal way: from outside, along a
  /// helix or through the bore of one that went deeper, along a ramp on the track, or straight down. Returns
  /// the track turned so that it begins where the cutter is. `leaf`: the area inside the track, for a helix.
  /// A ramp along a closed track goes down through several levels, as a helix does, by no more than a level a
  /// round; the track is cut down to the lowest of them, and is `slotted` after that.
  /// Fails  TPA-ENTRY.
  Result<Track> enter(const Level& level, const Track& track, const geometry::Region* leaf);
  /// How long the way down through the level's material is, mm: along a helix or ramp, else straight.
  [[nodiscard]] double way_down_mm(const Level& level) const;
  /// Whether a ramp along this closed track went down to the level or deeper, and all the way round it there.
  [[nodiscard]] bool slotted(const Level& level, const Track& track) const;
  /// To a place that is cleared down to the level already, and down to it.
  void go_cleared(const Level& level, geometry::Vec2 p);
  /// Rings of a level; walls are mostly upright, so that the level before had the same, which are kept.
  const std::vector<Ring>& rings_of(const geometry::Region& centres, double apart_mm, double cover_mm);
  /// Follows a track on the level. Where the whole cutter is beside the raw piece, by kAirBeyond at least (a
  /// raw piece may be larger than stated), on longer ways than its diameter, nothing is cut: the move is a
  /// link, and left out where the track ends so. Returns whether it went to the track's end.
  bool follow(const Level& level, const Track& track);
  /// A straight cut on the level to p when it stays within the centres.
  bool cut_to(const Level& level, geometry::Vec2 p);

  const PathJob& task;
  const WorkArea& area;
  PathWriter& writer;
  Job& job;
  double radius_mm;
  double step_mm;  ///< between passes
  std::vector<Diagnostic> said;
  /// Heights that are roughed, from above: a helix goes down to as many of them as it may. Empty: to its own.
  std::vector<double> floors;

  /// Warns once.
  void warn(const std::string& code, const std::string& message);
  /// Reports a deviation from the request that needs no action.
  void note(const std::string& code, const std::string& message);

 private:
  void tell(Severity severity, const std::string& code, const std::string& message);
  void go_above(const Level& level, geometry::Vec2 p);
  std::optional<Track> from_outside(const Level& level, const Track& track);
  std::optional<Track> by_helix(const Level& level, const Track& track, const geometry::Region& leaf);
  std::optional<Track> by_bore(const Level& level, const Track& track, geometry::Vec2 middle);
  /// Lowest of `floors` down to which a helix of this radius stays within the centres.
  [[nodiscard]] double bore_floor(const Level& level, geometry::Vec2 middle, double radius) const;
  /// The same of a ramp along a track of the level.
  [[nodiscard]] double slot_floor(const Level& level) const;
  /// Whether one way in may go from the level's material down to z: chips come out, the cutter reaches.
  [[nodiscard]] bool may_go_down_to(const Level& level, double z) const;
  std::optional<Track> by_ramp(const Level& level, const Track& track);
  /// Of a ramp round a closed track down to `floor`, no round of which cuts deeper than a level.
  [[nodiscard]] Descent round_by_round(const Level& level, const Track& track, double angle_rad,
                                       double floor) const;
  [[nodiscard]] double steepest() const;  ///< ramp that is asked for and allowed, rad; 0: none
  [[nodiscard]] double ramp_angle();      ///< the same, to be cut: says so where less is allowed than asked
  /// Height of the cutter's end over the level's material where it begins to ramp.
  [[nodiscard]] double gap(const Level& level) const;

  struct Bore {
    geometry::Vec2 middle;
    double z_mm;
  };
  std::vector<Bore> bores_;  ///< made by helices
  struct Slot {
    Track track;
    double z_mm;
  };
  std::vector<Slot> slots_;  ///< made by ramps along closed tracks, below the level they began at
  geometry::Region ringed_;  ///< what `rings_` are of
  double ringed_apart_mm_ = 0.0, ringed_cover_mm_ = 0.0;
  std::vector<Ring> rings_;
};

/// The stepover that the job asks for, mm: radial depth, else overlap, else half the diameter.
[[nodiscard]] double stepover_of(const PathJob& task);

}  // namespace capstan::toolpath
