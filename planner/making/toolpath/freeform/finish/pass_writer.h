#pragma once

#include <vector>

#include "planner/ground/base/job.h"
#include "planner/ground/geometry/region.h"
#include "planner/making/toolpath/freeform/finish/waterline.h"
#include "planner/making/toolpath/freeform/freeform.h"
#include "planner/making/toolpath/freeform/surface_line.h"

namespace capstan::toolpath::freeform {

/// A piece of a pass, in the frame of a hatch.
struct Piece {
  double v = 0.0;
  Run run;  ///< towards greater u
};

/// Joins passes to one path: along the surface where the next begins near by and no link comes nearer than
/// the cutter's radius to what is to be avoided, else over the security plane. Asked to stop, it adds no
/// more.
class PassWriter {
 public:
  PassWriter(const FreeformJob& task, const DropCutter& drop, const MillEnd& cutter, double spacing_mm,
             const Job& job);

  /// From here on passes keep as far from the surface as this job says.
  void keep(const FreeformJob& task);
  void add(const Run& run);
  /// Each piece after the one from which it is reached along the surface; where none is, the first. By v.
  void add_nearest_first(const std::vector<Piece>& pieces, geometry::Vec2 v_axis);
  /// Each way after one on the level above it from which it is reached along the surface, and so down a wall;
  /// where none is, the highest. None before those that lie above it within reach; none is turned round.
  void add_levels(std::vector<Level> levels);
  /// Links may be as long as this; entries are near the surface, beside higher walls too.
  void link_within(double reach_mm);
  [[nodiscard]] bool empty() const { return path_.size() == 0; }
  /// Lifts the cutter. Needs a pass.
  [[nodiscard]] model::CutterPath finished();
  /// Way at feed, and an entry counted as so much of it: what two orders of the same passes are compared by.
  [[nodiscard]] double way_mm() const;

 private:
  [[nodiscard]] geometry::Vec3 up(geometry::Vec3 p) const { return {p.x, p.y, task_.security_z_mm}; }
  [[nodiscard]] geometry::Vec3 here() const { return path_.point(path_.size() - 1); }
  void enter(geometry::Vec3 p);
  void cut_to(geometry::Vec3 p);
  bool slide_to(geometry::Vec3 to);
  [[nodiscard]] bool meets_what_is_avoided(geometry::Vec2 a, geometry::Vec2 b) const;

  const FreeformJob& task_;
  const Job& job_;
  geometry::Region avoid_;  ///< grown by the radius
  Follower follow_;
  double spacing_mm_, reach_mm_;
  bool near_ = false;
  model::CutterPath path_;
};

}  // namespace capstan::toolpath::freeform
