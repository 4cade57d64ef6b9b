#include <algorithm>
#include <cmath>

#include "planner/ground/base/number.h"
#include "planner/making/toolpath/defaults.h"
#include "planner/making/toolpath/region/form/undercut.h"
#include "planner/making/toolpath/region/patterns.h"
#include "planner/making/toolpath/region/region_paths.h"
#include "planner/making/toolpath/section/section_path.h"

namespace capstan::toolpath {

using geometry::Region;
using geometry::Vec2;
using model::CutterClass;
using model::MoveRole;

namespace {

/// By how much a flat tip may stand out of a vee's flanks where no tolerance says more, mm; default,
/// unsourced.
constexpr double kSharpVee = 0.05;

/// Whether the cutter's form makes the slot's section in one pass along the spine.
Status check_form(const PathJob& task) {
  const auto& s = task.shape;
  const auto& c = task.cutter;
  const auto refuse = [&](const std::string& what) {
    return fail({.code = "TPA-TOOL", .message = s.name + ": " + what, .path = s.name});
  };
  if (s.slot_angle_rad > 0.0) {
    if (s.slot_bottom_radius_mm > 0.0) return refuse("no form cutter is known for a vee with a rounded tip");
    if (std::abs(c.point_angle_rad - s.slot_angle_rad) > 1e-3)
      return refuse("a vee of " + trimmed(s.slot_angle_rad * 180.0 / M_PI, 2) +
                    " degrees needs a cutter with that point angle");
    // At the bottom of a sharp vee, a flat tip's corners cut into the flanks by at most half its width.
    const double off = 0.5 * c.tip_diameter_mm;
    const double most = s.width.given ? std::max(kSharpVee, 0.25 * s.width.width()) : kSharpVee;
    if (off > most)
      return refuse("the cutter's flat tip of " + trimmed(c.tip_diameter_mm, 3) +
                    " mm would cut into the flanks of a sharp vee; at most " + trimmed(2.0 * most, 3) +
                    " mm would do");
    return {};
  }
  if (s.slot_bottom_radius_mm > 0.0) {
    if (c.cutter_class != CutterClass::kBallEndmill ||
        std::abs(0.5 * c.cutting_diameter_mm - s.slot_bottom_radius_mm) > kSameSize)
      return refuse("a rounded U needs a ball end mill of " + trimmed(2.0 * s.slot_bottom_radius_mm, 3) +
                    " mm");
    return {};
  }
  return refuse("its section needs a T-slot or dovetail cutter");
}

/// The spine as the cutter's centre runs it: out into the air at open ends, short of flat closed ends.
SlotRun run_of(const PathJob& task, const WorkArea& w) {
  SlotRun e;
  for (const Vec2 p : task.shape.spine)
    e.line.push_back(xy(task.feature_in_setup.to_parent({p.x, p.y, 0.0})));
  if (norm(e.line.front() - e.line.back()) < 1e-6) return e;
  const double half = 0.5 * std::max(task.shape.width.nominal_mm, 0.1);
  const double radius = 0.5 * task.cutter.cutting_diameter_mm;
  const Inside reach(w.reach);
  const Inside material(w.material);
  for (const bool last : {false, true}) {
    Vec2& end = last ? e.line.back() : e.line.front();
    const Vec2 before = last ? e.line[e.line.size() - 2] : e.line[1];
    const Vec2 out = (1.0 / norm(end - before)) * (end - before);
    if (reach.contains(end + (half + 1.0) * out)) {
      (last ? e.open_last : e.open_first) = true;
      end = end + (radius + 1.0) * out;
      for (int i = 0; i < 50 && !material.clear_of(end, radius + 0.2); ++i) end = end + 0.5 * radius * out;
    } else if (!reach.contains(end + 0.5 * half * out)) {
      const double length = norm(end - before);
      end = end - std::min(radius, length) * out;
    }
  }
  return e;
}

}  // namespace

Result<GeneratedPath> slot_path(const PathJob& task, Job& job) {
  const auto& s = task.shape;
  const auto w = work_area(task);
  if (!w) return tl::unexpected(w.error());
  const double d = task.cutter.cutting_diameter_mm;
  const bool form = !s.slot_profile.empty();
  const bool end_mill = model::has(task.cutter.cutter_class, model::CutterTrait::kEndMill);
  const auto u = undercut_of(s);
  if (u && end_mill) return slot_path(neck_of(task, *u), job);
  if (u && model::has(task.cutter.cutter_class, model::CutterTrait::kSlotForm)) {
    if (s.spine.size() < 2 || norm(s.spine.front() - s.spine.back()) < 1e-6) {
      return fail({.code = "TPA-ENTRY",
                   .message = s.name + ": no open end, and cutter " + task.cutter.id + " (" + trimmed(d, 3) +
                              " mm) does not pass the mouth of " + trimmed(2.0 * u->mouth_mm, 3) +
                              " mm; open an end of the slot",
                   .path = s.name});
    }
    return undercut_path(task, *u, run_of(task, *w));
  }
  if (form) {
    if (auto ok = check_form(task); !ok) {
      if (model::has(task.cutter.cutter_class, model::CutterTrait::kLayers)) return form_slot_path(task, job);
      return tl::unexpected(ok.error());
    }
  } else {
    const double largest =
        s.width.nominal_mm + std::max(0.0, s.width.upper_mm) - 2.0 * task.allowance_side_mm;
    if (d > largest + 0.001) {
      return fail({.code = "TPA-NO-FIT",
                   .message = "the cutter " + task.cutter.id + " of " + trimmed(d, 3) +
                              " mm does not fit into " + s.name,
                   .path = s.name,
                   .hint = "a diameter of at most " + trimmed(largest, 3) + " mm would"});
    }
    if (d < largest - kSameSize && task.strategy != model::StrategyKind::kCenterMilling)
      return area_path(task, job);
  }
  if (s.spine.size() < 2) {
    return fail({.code = "TPA-UNSUPPORTED", .message = s.name + " has no course to follow", .path = s.name});
  }
  const SlotRun run = run_of(task, *w);
  const bool closed = norm(run.line.front() - run.line.back()) < 1e-6;
  std::vector<Vec2> line = run.line;
  // Begin at an open end when there is one.
  if (!run.open_first && run.open_last) std::reverse(line.begin(), line.end());
  const bool from_air = run.open_first || run.open_last;
  Track track = track_of_line(line);
  track.closed = closed;
  PathWriter writer(task);
  LevelCutter c(task, *w, writer, job);
  const double end = w->bottom_z_mm + task.allowance_bottom_mm;
  const bool single = task.multiple_passes.has_value() && !*task.multiple_passes;
  const auto heights =
      levels(*w, task.start_z_mm, end, single ? 0.0 : task.axial_depth_mm, task.allowance_bottom_mm);
  if (heights.empty()) {
    return fail({.code = kNothingToCut,
                 .message = s.name + " has nothing to cut below " + trimmed(task.start_z_mm, 3) + " mm",
                 .path = s.name});
  }
  double from = task.start_z_mm;
  bool at_end = false;
  for (const double z : heights) {
    const bool both = run.open_first && run.open_last;
    Track t = at_end && (both || !from_air) ? reversed(track) : track;
    Level level(task, *w, z, from, 0.0);
    level.centres = geometry::stroke(points_of(track, 0.001), 0.01, true);
    level.inside = Inside(level.centres);
    level.air.clear();
    if (from_air) {
      if (at_end && both) {
        writer.line({t.start.x, t.start.y, z}, MoveRole::kApproach);
      } else {
        writer.over(t.start);
        writer.descend(z, z);
      }
    } else {
      auto in = c.enter(level, t, nullptr);
      if (!in) return tl::unexpected(in.error());
      t = *in;
    }
    writer.follow(t, z, MoveRole::kCut);
    if (!from_air && !closed) {
      // The ramp left a slope behind the start: the whole length once more is cut by the pass itself.
      at_end = !at_end;
    } else {
      at_end = both && !at_end;
    }
    from = z;
  }
  GeneratedPath out = writer.finish();
  out.levels_z_mm = heights;
  return out;
}

}  // namespace capstan::toolpath
