#include <algorithm>
#include <cmath>
#include <numbers>

#include "planner/ground/base/number.h"
#include "planner/ground/vocabulary/thread_mill.h"
#include "planner/making/toolpath/defaults.h"
#include "planner/making/toolpath/hole/hole_paths.h"
#include "planner/making/toolpath/link/path_writer.h"
#include "planner/making/toolpath/refuse.h"
#include "planner/making/toolpath/region/patterns.h"
#include "planner/model/plan/cutter/ramp.h"

namespace capstan::toolpath {

using geometry::Vec2;
using geometry::Vec3;
using model::MoveRole;

namespace {

constexpr int kMostTurns = 10'000;

double helix_radius(const PathJob& task) {
  return 0.5 * (task.shape.diameter.middle() - task.cutter.cutting_diameter_mm) - task.allowance_side_mm;
}

/// Half turns around the centre, from the side at +x r to the other and back.
void half_turn(PathWriter& w, Vec2 c, double r, bool to_right, double z, bool cw, MoveRole why) {
  w.arc({c.x + (to_right ? r : -r), c.y, z}, c, cw, why);
}

/// Whether the middle of the cutter, which cuts badly or not at all, goes down in the hole that is there: all
/// the way through, or one that goes on below a shoulder.
bool middle_in_air(const PathJob& task) {
  const double reached = helix_radius(task) + model::kMiddleOfRadius * 0.5 * task.cutter.cutting_diameter_mm;
  return reached <= 0.5 * (task.shape.through ? task.previous_diameter_mm.value_or(0.0) : task.hole_below_mm);
}

}  // namespace

bool helix_suits(const PathJob& task) {
  const double r = helix_radius(task);
  const double flat = 0.5 * task.cutter.cutting_diameter_mm - task.cutter.corner_radius_mm;
  const double open = 0.5 * task.previous_diameter_mm.value_or(0.0);
  const double core = std::max(r - std::max(flat, 0.25 * task.cutter.cutting_diameter_mm), 0.0);
  // Into material no wider than the cutter, so that no core is left, and no steeper than it may ramp.
  const bool may_enter =
      task.cutter.maximum_ramp_angle_rad > 0.0 && r <= 0.5 * task.cutter.cutting_diameter_mm + 1e-9;
  return r > 0.0 && core <= open + 1e-9 && (middle_in_air(task) || may_enter) &&
         task.shape.bottom_diameter_mm >= task.shape.diameter.nominal_mm - 1e-6;
}

Result<GeneratedPath> helix_path(const PathJob& task, Job&) {
  const double r = helix_radius(task);
  if (!(r > 0.0)) {
    return fail({.code = "TPA-NO-FIT",
                 .message = "the cutter " + task.cutter.id + " does not fit into " + task.shape.name,
                 .path = task.shape.name,
                 .hint = "a diameter below " +
                         trimmed(task.shape.diameter.middle() - 2.0 * task.allowance_side_mm, 3) +
                         " mm would"});
  }
  const auto o = task.feature_in_setup.origin;
  double end = o.z - task.cutting_depth_mm.value_or(task.shape.depth_mm) + task.allowance_bottom_mm;
  if (task.shape.through) end -= task.break_through_mm + task.cutter.corner_radius_mm;
  const double gap = std::min(1.0, task.clearance_mm);
  const double top = task.start_z_mm + gap;
  if (end >= task.start_z_mm) return refuse(task, kNothingToCut, "there is nothing to cut");
  double angle = usual_ramp_rad(task);
  if (task.approach.kind == Approach::Kind::kHelix && task.approach.angle_rad > 0.0)
    angle = std::min(task.approach.angle_rad, task.cutter.maximum_ramp_angle_rad);
  // Where the cutter's middle goes down in the hole that is there, only its flank and rim cut, and the pitch
  // is the axial depth; but a blind hole ends in the cone of the drill that made it, which the cutter's end
  // has to take away.
  const bool open = middle_in_air(task);
  double pitch = open ? 1e300 : 2.0 * std::numbers::pi * r * std::tan(angle);
  if (task.axial_depth_mm > 0.0) pitch = std::min(pitch, task.axial_depth_mm);
  pitch = std::min(pitch, top - end);
  const double turns = std::ceil((top - end) / pitch - 1e-9);
  if (!(turns > 0.0) || turns > kMostTurns)
    return refuse(task, "TPA-ENTRY",
                  "the cutter's ramp angle of " + trimmed(angle * 180.0 / std::numbers::pi, 4) +
                      " degrees takes more than " + std::to_string(kMostTurns) +
                      " turns; take a cutter that ramps steeper");
  const bool cw = walls_on_right(task) == false;
  PathWriter w(task);
  const Vec2 c = xy(o);
  const bool room = r > 0.0 && task.previous_diameter_mm.value_or(0.0) >= task.cutter.cutting_diameter_mm;
  w.over(room ? c : Vec2{c.x + r, c.y});
  w.descend(top, top);
  if (room) w.arc({c.x + r, c.y, top}, {c.x + 0.5 * r, c.y}, cw, MoveRole::kApproach);
  const int n = 2 * static_cast<int>(turns);
  for (int i = 1; i <= n; ++i)
    half_turn(w, c, r, i % 2 == 0, i == n ? end : top - (top - end) * i / n, cw,
              open ? MoveRole::kCut : MoveRole::kRamp);
  half_turn(w, c, r, false, end, cw, MoveRole::kCut);
  half_turn(w, c, r, true, end, cw, MoveRole::kCut);
  w.arc({c.x, c.y, end}, {c.x + 0.5 * r, c.y}, cw, MoveRole::kCut);  // off the wall, to the middle
  GeneratedPath out = w.finish();
  out.levels_z_mm = {end};
  return out;
}

Result<GeneratedPath> thread_mill_path(const PathJob& task, Job&) {
  const auto& s = task.shape;
  const double pitch = s.thread_pitch_mm;
  const double r = 0.5 * (s.thread_major_mm - task.cutter.cutting_diameter_mm);
  if (!model::mills_threads(task.cutter.cutter_class))
    return refuse(task, "TPA-TOOL",
                  "thread milling needs a thread mill; cutter " + task.cutter.id + " is none");
  if (!(pitch > 0.0) || !(s.thread_major_mm > 0.0))
    return refuse(task, "TPA-DEPTH", "pitch or diameter of the thread is missing in the file; state it");
  if (task.cutter.thread_pitch_mm > 0.0 && std::abs(task.cutter.thread_pitch_mm - pitch) > 1e-4)
    return refuse(task, "TPA-TOOL",
                  "the thread mill's pitch of " + trimmed(task.cutter.thread_pitch_mm, 3) +
                      " mm is not the thread's " + trimmed(pitch, 3) + " mm");
  // The core hole must let the cutter in.
  if (!(r > 0.0) || task.cutter.cutting_diameter_mm > s.diameter.nominal_mm - 1e-3)
    return refuse(task, "TPA-NO-FIT",
                  "the thread mill of " + trimmed(task.cutter.cutting_diameter_mm, 3) +
                      " mm is too wide for the core hole of " + trimmed(s.diameter.nominal_mm, 3) +
                      " mm and the thread of " + trimmed(s.thread_major_mm, 3) + " mm; take a narrower one");
  const double depth =
      task.cutting_depth_mm.value_or(s.thread_depth_mm > 0.0 ? s.thread_depth_mm : s.depth_mm);
  const auto o = task.feature_in_setup.origin;
  const Vec2 c = xy(o);
  // Rows of teeth over the whole thread need one turn; a single row as many as there are pitches.
  const bool full_form = task.cutter.maximum_depth_of_cut_mm >= depth;
  const int turns = full_form ? 1 : static_cast<int>(std::ceil(depth / pitch - 1e-9));
  if (turns > kMostTurns)
    return refuse(task, "TPA-DEPTH",
                  "the thread of " + trimmed(depth, 3) + " mm with a pitch of " + trimmed(pitch, 4) +
                      " mm has " + std::to_string(turns) + " turns, more than " + std::to_string(kMostTurns));
  // A right-hand cutter climbs counter-clockwise inside; a right-hand thread then rises.
  const bool cw = !walls_on_right(task);
  const bool up = cw == s.thread_left_hand;
  const double low = o.z - depth;
  const double first = up ? low : low + turns * pitch;
  const double sign = up ? 1.0 : -1.0;
  // Half-circles of lead take half a pitch each.
  const double lead = 0.5 * pitch;
  if (!s.through && (up ? first - lead : first + turns * pitch * sign - lead) < o.z - s.depth_mm - 1e-9)
    return refuse(task, "TPA-DEPTH",
                  "the lead of the helix would go below the hole's bottom: thread depth at most " +
                      trimmed(s.depth_mm - lead, 3) + " mm");
  PathWriter w(task);
  w.over(c);
  const double z0 = first - sign * lead;
  w.descend(z0, z0);
  w.arc({c.x + r, c.y, first}, {c.x + 0.5 * r, c.y}, cw, MoveRole::kCut);
  double z = first;
  for (int i = 0; i < turns; ++i) {
    half_turn(w, c, r, false, z += sign * 0.5 * pitch, cw, MoveRole::kCut);
    half_turn(w, c, r, true, z += sign * 0.5 * pitch, cw, MoveRole::kCut);
  }
  w.arc({c.x, c.y, z + sign * lead}, {c.x + 0.5 * r, c.y}, cw, MoveRole::kCut);
  GeneratedPath out = w.finish();
  out.levels_z_mm = {low};
  return out;
}

}  // namespace capstan::toolpath
