#pragma once

#include <string>

#include "planner/making/toolpath/link/descent.h"
#include "planner/making/toolpath/path_job.h"
#include "planner/making/toolpath/region/area/track.h"

namespace capstan::toolpath {

/// Writes the moves of one workingstep and keeps the columns together. Rapids happen at the security plane
/// and the retract plane only, and up from the work; what goes down below the retract plane goes at feed.
class PathWriter {
 public:
  explicit PathWriter(const PathJob& task);

  [[nodiscard]] bool begun() const { return out_.path.size() > 0; }
  [[nodiscard]] geometry::Vec3 at() const { return out_.path.point(out_.path.size() - 1); }
  /// The moves so far.
  [[nodiscard]] const model::CutterPath& path() const { return out_.path; }
  /// Lowest height of rapids.
  [[nodiscard]] double rapid_z_mm() const { return rapid_z_; }

  /// To the retract plane above p: from the security plane at first, by rapids at the retract plane later.
  void over(geometry::Vec2 p);
  /// Down to z through air, at feed; then, below `material_z`, as a plunge.
  void descend(double z_mm, double material_z_mm);
  void line(geometry::Vec3 to, model::MoveRole why);
  void arc(geometry::Vec3 to, geometry::Vec2 centre, bool clockwise, model::MoveRole why);
  /// The whole track at one height; its start is where the cutter is.
  void follow(const Track& t, double z_mm, model::MoveRole why);
  /// The track while the height falls to z, by each piece in the share that the descent gives it.
  void follow_down(const Track& t, double z_mm, const Descent& descent, model::MoveRole why);
  void rapid_up(double z_mm);
  void dwell(double seconds);
  /// To the retract plane, straight up.
  void retract();
  /// Factors of the moves that come from now on.
  void factors(double feed, double speed);

  /// Ends at the security plane.
  [[nodiscard]] GeneratedPath finish();

 private:
  void fill();

  GeneratedPath out_;
  double security_z_, rapid_z_;
  double feed_ = 1.0, speed_ = 1.0, pending_dwell_ = 0.0;
};

}  // namespace capstan::toolpath
