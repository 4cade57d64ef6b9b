#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "planner/ground/base/number.h"
#include "planner/ground/vocabulary/operation.h"
#include "planner/making/toolpath/hole/hole_paths.h"
#include "planner/making/toolpath/link/path_writer.h"
#include "planner/making/toolpath/refuse.h"

namespace capstan::toolpath {

using model::CutterClass;
using model::HoleBottom;
using model::MoveRole;
using model::TypeId;

namespace {

/// A stretch of the way down with its factors.
struct Stretch {
  double to_z = 0.0, feed = 1.0, speed = 1.0;
};

bool to_tip(const PathJob& task) {
  return task.operation == TypeId::kCenterDrilling ||
         model::has(task.cutter.cutter_class, model::CutterTrait::kMarks);
}

/// Height of the tip at the bottom.
Result<double> bottom_z(const PathJob& task) {
  const auto& s = task.shape;
  const double top = task.feature_in_setup.origin.z;
  const double tip = model::tip_length(task.cutter);
  if (to_tip(task)) {
    if (!task.cutting_depth_mm) return refuse(task, "TPA-DEPTH", "centre drilling needs a cutting depth");
    return top - *task.cutting_depth_mm;
  }
  if (task.operation == TypeId::kCounterSinking) {
    if (task.cutting_depth_mm) return top - *task.cutting_depth_mm;
    const double half = 0.5 * task.cutter.point_angle_rad;
    const double width = s.diameter.middle() - task.cutter.tip_diameter_mm;
    if (!(half > 0.0) || !(width > 0.0))
      return refuse(task, "TPA-TOOL",
                    "countersinking needs a conical cutter with a tip narrower than the sink");
    constexpr double kFootMm =
        0.01;  // a tip so much wider than the cone's foot cuts no step; default, unsourced
    if (s.bottom_diameter_mm > 0.0 && task.cutter.tip_diameter_mm > s.bottom_diameter_mm + kFootMm)
      return refuse(task, "TPA-NO-FIT",
                    "the flat tip of cutter " + task.cutter.id + ", " +
                        trimmed(task.cutter.tip_diameter_mm, 3) + " mm, is wider than the cone's foot, " +
                        trimmed(s.bottom_diameter_mm, 3) +
                        " mm; use a countersink with a narrower tip, or a chamfer mill");
    if (s.diameter.middle() > task.cutter.cutting_diameter_mm + 1e-6)
      return refuse(task, "TPA-NO-FIT",
                    "the countersink is " + trimmed(s.diameter.middle(), 3) + " mm wide, cutter " +
                        task.cutter.id + " " + trimmed(task.cutter.cutting_diameter_mm, 3) +
                        " mm; use a wider one");
    return top - 0.5 * width / std::tan(half);
  }
  const double depth = task.cutting_depth_mm.value_or(s.depth_mm);
  if (!(depth > 0.0))
    return refuse(task, "TPA-DEPTH", "the depth of the hole is missing in the file; state it");
  double z = top - depth;
  const bool reaches_bottom = depth >= s.depth_mm - 1e-6;
  if (s.through && reaches_bottom) {
    // The full diameter must pass through; the tip below it has no full diameter.
    z -= task.break_through_mm + (model::has(task.operation, model::OperationTrait::kEnlarges) ? 0.0 : tip);
  } else if (s.bottom == HoleBottom::kConical || !reaches_bottom) {
    z -= model::has(task.operation, model::OperationTrait::kEnlarges) ? 0.0 : tip;
    if (reaches_bottom) {
      // A steeper tip than the hole's own would go through its cone.
      const double cone = 0.5 * s.diameter.nominal_mm * std::tan(s.bottom_angle_rad);
      z = std::max(z, top - depth - std::max(cone, 0.0));
    }
  }
  return z;  // flat and spherical bottoms: the tip stops at the depth
}

/// Notes  TPA-REST where a drill that goes to a conical bottom is blunter than it: what stays there between
/// the two cones, below the full diameter's depth.
void tell_rest_under_point(const PathJob& task, double z, Job& job) {
  constexpr double kTellMm = 0.1;  // less is the rounding of drawn points, 118 as 120; default, unsourced
  const auto& s = task.shape;
  if (s.bottom != HoleBottom::kConical || task.cutter.cutter_class != CutterClass::kTwistDrill ||
      task.cutting_depth_mm.value_or(s.depth_mm) < s.depth_mm - 1e-6)
    return;
  const double r = 0.5 * s.diameter.nominal_mm;
  const double rest = z - (task.feature_in_setup.origin.z - s.depth_mm - r * std::tan(s.bottom_angle_rad));
  if (rest <= kTellMm) return;
  constexpr double kPi = std::numbers::pi;
  job.note("TPA-REST", about(task) + "rest material at the bottom: " + trimmed(rest, 2) + " mm high, " +
                           trimmed(kPi * r * r * rest / 3.0, 1) + " mm3, for the point of drill " +
                           task.cutter.id + ", " + trimmed(task.cutter.point_angle_rad * 180.0 / kPi, 1) +
                           " degrees, is blunter than the bottom's " +
                           trimmed(180.0 - 2.0 * s.bottom_angle_rad * 180.0 / kPi, 1) +
                           ", which has no tolerance; the full diameter is as deep as asked");
}

std::vector<Stretch> stretches(const PathJob& task, double end_z) {
  const DrillPhases p = task.phases.value_or(DrillPhases{});
  const double top = task.feature_in_setup.origin.z;
  const double tip = to_tip(task) || model::has(task.operation, model::OperationTrait::kEnlarges)
                         ? 0.0
                         : model::tip_length(task.cutter);
  std::vector<Stretch> out;
  double end_begins = end_z;
  if (p.depth_of_end_mm > 0.0)
    end_begins = p.end_counts_from_top ? top - p.depth_of_end_mm - tip : end_z + p.depth_of_end_mm;
  end_begins = std::max(end_begins, end_z);
  if (p.depth_of_start_mm > 0.0) {
    const double z = std::max({top - p.depth_of_start_mm - tip, end_begins, end_z});
    out.push_back({z, p.feed_at_start, p.speed_at_start});
  }
  if (end_begins > end_z + 1e-9) {
    out.push_back({end_begins, 1.0, 1.0});
    out.push_back({end_z, p.feed_at_end, p.speed_at_end});
  } else {
    out.push_back({end_z, 1.0, 1.0});
  }
  return out;
}

/// Down to z at the factors of the stretches that lie on the way.
void feed_down(PathWriter& w, const std::vector<Stretch>& all, double z) {
  const auto at = w.at();
  for (const Stretch& s : all) {
    if (w.at().z <= s.to_z + 1e-9 && s.to_z > z) continue;
    w.factors(s.feed, s.speed);
    w.line({at.x, at.y, std::max(s.to_z, z)}, MoveRole::kDrill);
    if (s.to_z <= z) break;
  }
}

void peck_down(PathWriter& w, const PathJob& task, const std::vector<Stretch>& all, double end_z) {
  const Peck& p = *task.peck;
  const auto at = w.at();
  double depth_z = std::max(end_z, task.start_z_mm - p.first_mm);
  constexpr double kAbove = 0.5;  // mm above the chips at the bottom when coming back; default, unsourced
  for (int i = 0; i < 100'000; ++i) {
    feed_down(w, all, depth_z);
    w.dwell(p.dwell_s);
    if (depth_z <= end_z + 1e-9) return;
    if (p.retract_mm > 0.0) {
      w.line({at.x, at.y, std::min(depth_z + p.retract_mm, w.rapid_z_mm())}, MoveRole::kLink);
    } else {
      w.retract();
      w.line({at.x, at.y, depth_z + std::min(kAbove, p.step_mm)}, MoveRole::kLink);
    }
    depth_z = std::max(end_z, depth_z - p.step_mm);
    if (depth_z - end_z < 0.05 * p.step_mm) depth_z = end_z;  // no crumb at the end
  }
}

/// Share of the speed at which a drill is drawn out. A gun drill leaves its guide as it went in: beyond the
/// hole nothing holds its long shank. Source: HEIDENHAIN cycle 241 (single-lip deep-hole drilling), which has
/// one speed for the way in and out (Q427) beside that of drilling (Q428).
double speed_on_retract(const PathJob& task) {
  const bool slow = task.cutter.cutter_class == CutterClass::kGunDrill && task.phases &&
                    task.phases->depth_of_start_mm > 0.0;
  return slow ? task.phases->speed_at_start : 1.0;
}

}  // namespace

Result<GeneratedPath> drill_path(const PathJob& task, Job& job) {
  if (task.operation == TypeId::kBackBoring)
    return refuse(task, "TPA-UNSUPPORTED", "back boring needs an oriented spindle; it has no path yet");
  const auto z = bottom_z(task);
  if (!z) return tl::unexpected(z.error());
  if (*z >= task.start_z_mm - 1e-9)
    return refuse(task, kNothingToCut,
                  "there is nothing to drill below " + trimmed(task.start_z_mm, 3) + " mm");
  if (task.peck && !(task.peck->first_mm > 0.0 && task.peck->step_mm > 0.0 && task.peck->retract_mm >= 0.0))
    return refuse(task, "TPA-DEPTH", "first_depth and depth_of_step of the step drilling must be above 0");
  if (task.operation == TypeId::kMultistepDrilling && !task.peck)
    return refuse(task, "TPA-DEPTH",
                  "first_depth and depth_of_step of the step drilling are missing; state them");
  tell_rest_under_point(task, *z, job);
  PathWriter w(task);
  const auto o = task.feature_in_setup.origin;
  w.over(xy(o));
  const auto all = stretches(task, *z);
  w.factors(all.front().feed, all.front().speed);
  w.descend(std::max(task.start_z_mm + task.clearance_mm, *z), task.start_z_mm + task.clearance_mm);
  if (task.peck) {
    peck_down(w, task, all, *z);
  } else {
    feed_down(w, all, *z);
  }
  w.dwell(task.dwell_s);
  const bool feed_out =
      task.feed_on_retract.has_value() || model::has(task.operation, model::OperationTrait::kEnlarges);
  if (task.spindle_stop_at_bottom) {
    w.factors(task.feed_on_retract.value_or(1.0), 0.0);
    if (task.operation == TypeId::kReaming)
      job.warn("TPA-GIVEN", about(task) +
                                "the reamer is drawn out with the spindle stopped, as given; let it turn, or "
                                "it scores the hole");
  } else {
    w.factors(task.feed_on_retract.value_or(1.0), speed_on_retract(task));
  }
  // A stopped boring bar comes out fast, everything else that enlarges at feed.
  const bool bar = task.operation == TypeId::kBoring && task.spindle_stop_at_bottom;
  if (feed_out && !(bar && !task.feed_on_retract)) w.line({o.x, o.y, w.rapid_z_mm()}, MoveRole::kRetract);
  GeneratedPath out = w.finish();
  out.levels_z_mm = {*z};
  return out;
}

Result<GeneratedPath> tap_path(const PathJob& task, Job&) {
  const auto& s = task.shape;
  if (task.cutter.cutter_class != CutterClass::kTap)
    return refuse(task, "TPA-TOOL", "tapping needs a tap; cutter " + task.cutter.id + " is none");
  const double pitch = s.thread_pitch_mm > 0.0 ? s.thread_pitch_mm : task.cutter.thread_pitch_mm;
  if (s.thread_pitch_mm > 0.0 && task.cutter.thread_pitch_mm > 0.0 &&
      std::abs(s.thread_pitch_mm - task.cutter.thread_pitch_mm) > 1e-4)
    return refuse(task, "TPA-TOOL",
                  "the tap's pitch of " + trimmed(task.cutter.thread_pitch_mm, 3) +
                      " mm is not the thread's " + trimmed(s.thread_pitch_mm, 3) + " mm");
  const double depth =
      task.cutting_depth_mm.value_or(s.thread_depth_mm > 0.0 ? s.thread_depth_mm : s.depth_mm);
  if (!(depth > 0.0) || !(pitch > 0.0))
    return refuse(task, "TPA-DEPTH", "depth or pitch of the thread is missing in the file; state it");
  const auto o = task.feature_in_setup.origin;
  double z = o.z - depth;
  if (s.through && depth >= s.depth_mm - 1e-6) z -= task.break_through_mm;
  PathWriter w(task);
  w.over(xy(o));
  // Room for the spindle to reach its speed in step with the feed: three pitches; default, unsourced.
  const double above = std::min(w.rapid_z_mm(), task.start_z_mm + std::max(task.clearance_mm, 3.0 * pitch));
  w.descend(above, above);
  w.line({o.x, o.y, z}, MoveRole::kTap);
  w.factors(1.0, -1.0);
  w.line({o.x, o.y, above}, MoveRole::kTap);
  w.factors(1.0, 1.0);
  GeneratedPath out = w.finish();
  out.levels_z_mm = {z};
  return out;
}

}  // namespace capstan::toolpath
