#pragma once

#include <optional>
#include <vector>

#include "planner/making/toolpath/freeform/freeform.h"
#include "planner/making/toolpath/freeform/hatch.h"
#include "planner/making/toolpath/freeform/rough/level_contour.h"
#include "planner/making/toolpath/freeform/rough/material.h"
#include "planner/making/toolpath/freeform/rough/reach.h"

namespace capstan::toolpath::freeform {

/// Terraces that the cutter may go straight down through where it ramps elsewhere: the step to the level
/// above and what that level left there. Default, unsourced.
inline constexpr double kStraightTerraces = 2.0;

/// Leads the cutter into the material of a level and between its passes, and cuts `rest` as it moves `path`.
///
/// Needs  what it is made of to outlive it. `z` is the height of the tip at the level; places given to it are
///        free there.
class WaysIn {
 public:
  WaysIn(const FreeformJob& task, const Hatch& hatch, const Reach& reach, const DropGrid& grid,
         Material& rest, model::CutterPath& path)
      : task_(task),
        hatch_(hatch),
        reach_(reach),
        grid_(grid),
        rest_(rest),
        path_(path),
        radius_(reach.cutter.radius()) {}

  /// `above_mm`: a level that was cleared before, from which ramps may begin. `raised`: this level stands on
  /// the one before.
  void begin_level(double above_mm, bool raised);
  /// The ends of passes, of this level and of those below it that it stands on.
  std::vector<geometry::Vec2> ends;

  /// From the security plane to the beginning of a pass, on its way from `u` to `far`; false: no way.
  [[nodiscard]] bool enter(double u, double far, double v, double z);
  /// Whether that is possible without cutting into the solid.
  [[nodiscard]] bool is_open(double u, double far, double v, double z) const;
  /// To a point on a border: from here, or from the nearest pass's end with a free way to it.
  [[nodiscard]] bool approach(geometry::Vec2 p, double z);
  /// Down into the solid along a closed border, within the ramp angle; false where it is too short for that.
  [[nodiscard]] bool ramp_along(const std::vector<geometry::Vec2>& line, double z);

  void line(geometry::Vec3 to, model::MoveRole why);
  void lift();  ///< to the security plane
  /// After a pass: the cutter stands in what it cut.
  void stay_down() { down_ = true; }
  [[nodiscard]] bool is_down() const { return down_; }
  [[nodiscard]] geometry::Vec3 here() const { return path_.point(path_.size() - 1); }
  [[nodiscard]] geometry::Vec3 at(double u, double v, double z) const {
    const geometry::Vec2 p = hatch_.place(u, v);
    return {p.x, p.y, z};
  }

 private:
  [[nodiscard]] double ramp_angle() const;
  /// In air, or where this cutter takes nothing, its corner or ball beside what stands higher.
  [[nodiscard]] bool is_clear(geometry::Vec2 p, double z) const;
  /// The nearest place within a diameter where the cutter is in air and has a free way to p.
  [[nodiscard]] std::optional<geometry::Vec2> air_near(geometry::Vec2 p, double z) const;
  /// The nearest place in air, within a diameter and a half before a pass from u to `far`, that has a free
  /// way to its beginning: beside the piece, or where this level is cleared.
  [[nodiscard]] std::optional<double> air_before(double u, double far, double v, double z) const;
  void ramp(double u, double end, double v, double top, double z, int turns);
  /// To p from above: low over what stands where that way is free, else over the security plane, fast to the
  /// clearance above `material`; at feed through the air there, then as a plunge. `was_there`: no deeper than
  /// before.
  void come_down(geometry::Vec3 p, double material, bool was_there = false);
  [[nodiscard]] bool is_raw(double material) const;
  /// Up, and at feed through the air above what stands on the way to p; false where that is longer than over
  /// the security plane, or something is to be avoided there.
  bool link_low(geometry::Vec3 p);

  const FreeformJob& task_;
  const Hatch& hatch_;
  const Reach& reach_;
  const DropGrid& grid_;
  Material& rest_;
  model::CutterPath& path_;
  double radius_;
  double above_ = 1e300;
  bool raised_ = false;
  bool down_ = false;
};

}  // namespace capstan::toolpath::freeform
