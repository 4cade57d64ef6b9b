#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "planner/ground/base/number.h"
#include "planner/making/toolpath/defaults.h"
#include "planner/making/toolpath/refuse.h"
#include "planner/making/toolpath/region/form/undercut.h"
#include "planner/making/toolpath/region/patterns.h"
#include "planner/model/plan/clearances.h"

namespace capstan::toolpath {

using geometry::Vec2;
using model::CutterClass;
using model::MoveRole;

namespace {

constexpr double kSidePart = 0.1;     ///< of the diameter: most that a pass takes further; default, unsourced
constexpr double kSameAngle = 0.002;  ///< rad
constexpr int kMostPasses = 200;
/// Factor of the feed on the way back through a slot just cut: the head meets no material, but chips that
/// could not leave upwards. Default, unsourced.
constexpr double kBackFree = 4.0;

/// The cutter's head: what cuts under the mouth.
struct Head {
  double diameter_mm = 0.0, height_mm = 0.0, neck_mm = 0.0;
};

Result<Head> head_of(const PathJob& task, const Undercut& u) {
  const auto& c = task.cutter;
  Head h{c.cutting_diameter_mm, c.cutting_width_mm > 0.0 ? c.cutting_width_mm : c.maximum_depth_of_cut_mm,
         c.neck_diameter_mm > 0.0 ? c.neck_diameter_mm : c.shank_diameter_mm};
  if (!(h.height_mm > 0.0))
    return refuse(task, "TPA-TOOL",
                  "cutter " + c.id + ": the height of its head is missing; state its cutting width");
  if (u.flank_rad > 0.0) {
    if (c.cutter_class != CutterClass::kDovetailMill || std::abs(c.lead_angle_rad - u.flank_rad) > kSameAngle)
      return refuse(task, "TPA-TOOL",
                    "flanks that lean " + trimmed(u.flank_rad * 180.0 / std::numbers::pi, 2) +
                        " degrees need a dovetail cutter of that angle");
    if (h.height_mm < u.height_mm - kSameSize)
      return refuse(task, "TPA-NO-FIT",
                    "the cutter's head is " + trimmed(h.height_mm, 3) + " mm high, the flanks are " +
                        trimmed(u.height_mm, 3) + " mm");
    if (!(c.neck_diameter_mm > 0.0)) {
      h.neck_mm = h.diameter_mm - 2.0 * h.height_mm * std::tan(u.flank_rad);
      // The shank is in the mouth where the slot is deeper than the head is high.
      if (task.shape.depth_mm > h.height_mm + 1e-9) h.neck_mm = std::max(h.neck_mm, c.shank_diameter_mm);
    }
  } else {
    if (c.cutter_class != CutterClass::kTSlotMill)
      return refuse(task, "TPA-TOOL", "cutter " + c.id + " is no T-slot cutter; its section needs one");
    if (h.height_mm > u.height_mm + 0.005)
      return refuse(task, "TPA-NO-FIT",
                    "the cutter's head is " + trimmed(h.height_mm, 3) + " mm high, the slot's wide part is " +
                        trimmed(u.height_mm, 3) + " mm");
  }
  if (!(h.neck_mm > 0.0))
    return refuse(task, "TPA-TOOL",
                  "cutter " + c.id + ": its neck diameter is missing; state it (the mouth is " +
                      trimmed(2.0 * u.mouth_mm, 3) + " mm wide)");
  return h;
}

/// The line moved sideways (left positive), its corners mitred.
std::vector<Vec2> beside(const std::vector<Vec2>& line, double by) {
  std::vector<Vec2> out;
  for (std::size_t i = 0; i < line.size(); ++i) {
    const Vec2 a = i > 0 ? line[i] - line[i - 1] : line[1] - line[0];
    const Vec2 b = i + 1 < line.size() ? line[i + 1] - line[i] : a;
    const Vec2 u = (1.0 / norm(a)) * a;
    const Vec2 v = (1.0 / norm(b)) * b;
    const Vec2 n{-(u.y + v.y), u.x + v.x};
    const double l2 = dot(n, n);
    if (l2 < 1e-9) return {};  // it turns back on itself
    out.push_back(line[i] + (2.0 * by / l2) * n);
  }
  return out;
}

/// The thickest chip of a pass that takes a width from a wall, by the feed of a tooth: 2 sqrt(a (d - a)) / d
/// for a width a below half the diameter d.
double thickest_chip(const PathJob& task, double taken_mm) {
  const double d = task.cutter.cutting_diameter_mm;
  const double a = std::clamp(taken_mm, 1e-3, 0.5 * d);
  return 2.0 * std::sqrt(a * (d - a)) / d;
}

/// How many teeth are engaged at once, on the mean, in a cut that takes a width; one at least.
double teeth_in(const PathJob& task, double taken_mm) {
  const double d = task.cutter.cutting_diameter_mm;
  const double arc = std::acos(std::clamp(1.0 - 2.0 * taken_mm / d, -1.0, 1.0));
  return std::max(1.0, task.cutter.teeth * arc / (2.0 * std::numbers::pi));
}

/// By how much a pass may be quicker than one that takes the question's width (undercut_width_mm), so that
/// each tooth takes the same thickest chip, and with it the same force. That is the force of one tooth: as
/// such a pass is the narrower one, no more teeth are engaged at once.
double quicker(const PathJob& task, const Undercut& u, double taken_mm) {
  if (!task.left_on_side_mm) return 1.0;  // the question was a slot of the whole diameter
  return std::clamp(thickest_chip(task, undercut_width_mm(task, u)) / thickest_chip(task, taken_mm), 1.0,
                    kMostQuicker);
}

/// How much further aside each pass goes than the one before.
std::vector<double> taken_by(const std::vector<double>& sides) {
  std::vector<double> out;
  for (std::size_t i = 0; i < sides.size(); ++i) out.push_back(sides[i] - (i > 0 ? sides[i - 1] : 0.0));
  return out;
}

/// Share of the feed in pass i of those aside; the last one makes the walls.
double share_of_pass(const PathJob& task, const Undercut& u, const std::vector<double>& taken,
                     std::size_t i) {
  if (i + 1 == taken.size() && task.last_share) return *task.last_share;
  return quicker(task, u, taken[i]);
}

/// Begins at, or goes on to, the start of a pass at its height.
void go_to(PathWriter& writer, Vec2 p, double z) {
  if (writer.begun()) {
    writer.line({p.x, p.y, z}, MoveRole::kLink);
    return;
  }
  writer.over(p);
  writer.descend(z, z);
}

/// Open at both ends: to and fro, the middle first, then aside by turns.
Status cut_through(const PathJob& task, const Undercut& u, const std::vector<Vec2>& course,
                   const std::vector<double>& sides, const std::vector<double>& heights, PathWriter& writer) {
  const std::vector<double> taken = taken_by(sides);
  std::vector<std::pair<double, double>> passes = {{0.0, task.both_edges_share}};  // aside; share of the feed
  for (std::size_t i = 0; i < sides.size(); ++i) {
    const double share = share_of_pass(task, u, taken, i);
    passes.emplace_back(sides[i], share);
    passes.emplace_back(-sides[i], share);
  }
  const bool edges = task.left_on_side_mm.has_value();
  bool back = false;  // true: the cutter is at the far end
  for (const double z : heights) {
    for (const auto& [side, share] : passes) {
      writer.factors(edges ? share : 1.0, 1.0);
      const auto line = side == 0.0 ? course : beside(course, side);
      if (line.empty())
        return refuse(task, "TPA-UNSUPPORTED", "slots whose course turns back on itself are not planned");
      Track there = track_of_line(line);
      if (back) there = reversed(there);
      go_to(writer, there.start, z);
      writer.follow(there, z, MoveRole::kCut);
      back = !back;
    }
  }
  return {};
}

/// A pass aside to a closed end: along one wall, round the end, along the other.
struct Loop {
  Track in, end, out;
};

/// Closed at the far end: in along the middle and back, then in along the right side, round the end and out
/// along the left one, so that the walls are always on the right. Where the head's front meets the closed end
/// it cuts with all of its width instead of two edges: slower by as much.
Status cut_to_the_end(const PathJob& task, const Undercut& u, const WorkArea& w,
                      const std::vector<Vec2>& course, const std::vector<double>& sides,
                      const std::vector<double>& heights, PathWriter& writer) {
  const Vec2 end = course.back();
  const Vec2 along = end - course[course.size() - 2];
  const Vec2 beyond = end + (0.9 * u.mouth_mm / norm(along)) * along;
  const bool round = Inside(w.reach).contains(beyond);
  const Track middle = track_of_line(course);
  const double d = task.cutter.cutting_diameter_mm;
  const double edge = 0.5 * d - u.mouth_mm;
  const double front = std::min(length_of(middle), std::max(0.0, 0.5 * d - u.mouth_mm) + 1.0);
  const std::vector<double> taken = taken_by(sides);
  std::vector<Loop> loops;
  for (const double s : sides) {
    const auto right = beside(course, -s), left = beside(course, s);
    if (right.empty() || left.empty())
      return refuse(task, "TPA-UNSUPPORTED", "slots whose course turns back on itself are not planned");
    Loop loop{track_of_line(right), {}, reversed(track_of_line(left))};
    loop.end.start = right.back();
    loop.end.segments.push_back({left.back(), end, round ? Bend::kCcw : Bend::kStraight});
    if (!walls_on_right(task)) loop = {reversed(loop.out), reversed(loop.end), reversed(loop.in)};
    loops.push_back(std::move(loop));
  }
  for (const double z : heights) {
    go_to(writer, middle.start, z);
    if (edge > 0.0 && task.left_on_side_mm) {
      writer.factors(task.both_edges_share, 1.0);
      writer.follow(part_of(middle, 0.0, length_of(middle) - front), z, MoveRole::kCut);
      writer.factors(std::min(task.front_share, std::max(edge, side_step(task, d)) / d), 1.0);
      writer.follow(part_of(middle, length_of(middle) - front, length_of(middle)), z, MoveRole::kCut);
      writer.factors(1.0, 1.0);
    } else {
      writer.follow(middle, z, MoveRole::kCut);
    }
    writer.factors(kBackFree, 1.0);
    writer.follow(reversed(middle), z, MoveRole::kRetract);
    for (std::size_t i = 0; i < loops.size(); ++i) {
      const double along_walls = share_of_pass(task, u, taken, i);
      writer.factors(along_walls, 1.0);
      go_to(writer, loops[i].in.start, z);
      writer.follow(loops[i].in, z, MoveRole::kCut);
      // Round the end its front is in the material, where the chip is as thick as the feed, and all teeth of
      // the front half cut at once.
      const double asked = undercut_width_mm(task, u);
      const double more = teeth_in(task, d) / teeth_in(task, asked);
      const double round_it = std::min(task.front_share, thickest_chip(task, asked) / std::max(1.0, more));
      writer.factors(std::min(round_it, along_walls), 1.0);
      writer.follow(loops[i].end, z, MoveRole::kCut);
      writer.factors(along_walls, 1.0);
      writer.follow(loops[i].out, z, MoveRole::kCut);
    }
    writer.factors(1.0, 1.0);
  }
  return {};
}

}  // namespace

double side_step(const PathJob& task, double diameter_mm) {
  const double most = kSidePart * diameter_mm;
  return task.radial_depth_mm > 0.0 ? std::min(task.radial_depth_mm, most) : most;
}

double undercut_width_mm(const PathJob& task, const Undercut& u) {
  const double d = task.cutter.cutting_diameter_mm;
  if (!task.left_on_side_mm) return d;
  return std::clamp(0.5 * d - (u.mouth_mm - *task.left_on_side_mm), side_step(task, d), d);
}

double last_side_mm(const PathJob& task, const Undercut& u) {
  const double aside = u.widest_mm - task.allowance_side_mm - 0.5 * task.cutter.cutting_diameter_mm;
  return std::clamp(aside, 0.0, kLastSide);
}

std::optional<Undercut> undercut_of(const model::FeatureShape& s) {
  const auto& q = s.slot_profile;
  if (q.size() < 2) return std::nullopt;
  double widest = 0.0;
  for (const Vec2 p : q) widest = std::max(widest, p.y);
  if (widest <= q.back().y + 1e-6) return std::nullopt;
  Undercut u;
  u.mouth_mm = q.back().y;
  u.widest_mm = q.front().y;
  if (u.widest_mm < widest - 1e-6) return std::nullopt;  // wider above its floor than on it
  // Upright flanks under a flat overhang, or leaning ones.
  if (std::abs(q[1].y - q[0].y) < 1e-9 && q[1].x > 0.0 && q.size() > 2) {
    if (std::abs(q[2].x - q[1].x) > 1e-9 || std::abs(q[2].y - u.mouth_mm) > 1e-9) return std::nullopt;
    u.height_mm = q[1].x;
    return u;
  }
  if (!(q[1].x > 0.0) || std::abs(q[1].y - u.mouth_mm) > 1e-9) return std::nullopt;
  u.height_mm = q[1].x;
  u.flank_rad = std::atan((q[0].y - q[1].y) / q[1].x);
  return u;
}

PathJob neck_of(const PathJob& task, const Undercut& u) {
  PathJob neck = task;
  auto& s = neck.shape;
  s.slot_profile.clear();
  const double shift = u.mouth_mm - 0.5 * s.width.nominal_mm;
  s.width.nominal_mm = 2.0 * u.mouth_mm;
  if (std::abs(shift) > 1e-9) {
    s.area = geometry::offset_sharp(s.area, shift);
    s.reach = geometry::offset_sharp(s.reach, shift);
  }
  return neck;
}

Result<GeneratedPath> undercut_path(const PathJob& task, const Undercut& u, SlotRun run) {
  const auto& s = task.shape;
  const auto w = work_area(task);
  if (!w) return tl::unexpected(w.error());
  const auto head = head_of(task, u);
  if (!head) return tl::unexpected(head.error());
  const double radius = 0.5 * head->diameter_mm;
  const double aside = u.widest_mm - task.allowance_side_mm - radius;
  if (aside < -0.001) {
    return fail({.code = "TPA-NO-FIT",
                 .message = "the cutter " + task.cutter.id + " of " + trimmed(head->diameter_mm, 3) +
                            " mm does not fit into " + s.name,
                 .path = s.name,
                 .hint = "a diameter of at most " + trimmed(2.0 * (aside + radius), 3) + " mm would"});
  }
  const double room = u.mouth_mm - model::kNeckClearMm - 0.5 * head->neck_mm;
  if (std::max(aside, 0.0) > room + 1e-9)
    return refuse(task, "TPA-NO-FIT",
                  "to reach the sides the cutter moves " + trimmed(std::max(aside, 0.0), 3) +
                      " mm off the middle; its neck of " + trimmed(head->neck_mm, 3) + " mm leaves " +
                      trimmed(std::max(room, 0.0), 3) + " mm in the mouth");
  if (run.line.size() < 2 || (!run.open_first && !run.open_last)) {
    return refuse(task, "TPA-ENTRY",
                  "no open end, and cutter " + task.cutter.id + " (" +
                      trimmed(task.cutter.cutting_diameter_mm, 3) + " mm) does not pass the mouth of " +
                      trimmed(2.0 * u.mouth_mm, 3) + " mm; open an end of the slot");
  }
  if (!run.open_first) {
    std::reverse(run.line.begin(), run.line.end());
    std::swap(run.open_first, run.open_last);
  }
  // At open ends the whole head is clear of the material, for every pass.
  const Inside material(w->material);
  const double most_aside = std::max(aside, 0.0);
  for (const bool last : {false, true}) {
    if (last && !run.open_last) continue;
    Vec2& end = last ? run.line.back() : run.line.front();
    const Vec2 before = last ? run.line[run.line.size() - 2] : run.line[1];
    const Vec2 out = (1.0 / norm(end - before)) * (end - before);
    int steps = 0;
    while (!material.clear_of(end, radius + most_aside + kAirBeside)) {
      if (++steps > 400)
        return refuse(task, "TPA-ENTRY", "the cutter does not get free of the material at the open end");
      end = end + 0.5 * radius * out;
    }
  }
  const bool both = run.open_first && run.open_last;
  std::vector<double> sides;
  if (aside > 1e-6) {
    const double step = side_step(task, head->diameter_mm);
    const double rough = aside - last_side_mm(task, u);
    const int n = static_cast<int>(std::ceil(rough / step - 1e-9));
    if (n > kMostPasses)
      return refuse(task, "TPA-NO-FIT",
                    "the cutter of " + trimmed(head->diameter_mm, 3) + " mm takes " + std::to_string(n) +
                        " passes to reach the slot's sides, more than " + std::to_string(kMostPasses) +
                        "; take a larger one");
    for (int i = 1; i <= n; ++i) sides.push_back(rough * i / n);
    sides.push_back(aside);
  }
  const double bottom = w->bottom_z_mm + task.allowance_bottom_mm;
  std::vector<double> heights;
  const double spare = u.flank_rad > 0.0 ? 0.0 : u.height_mm - task.allowance_bottom_mm - head->height_mm;
  const int n = spare > kSameSize ? static_cast<int>(std::ceil(spare / head->height_mm - 1e-9)) : 0;
  for (int i = 0; i <= n; ++i) heights.push_back(bottom + (n > 0 ? std::max(spare, 0.0) * (n - i) / n : 0.0));
  PathWriter writer(task);
  if (both) {
    if (auto ok = cut_through(task, u, run.line, sides, heights, writer); !ok)
      return tl::unexpected(ok.error());
  } else if (auto ok = cut_to_the_end(task, u, *w, run.line, sides, heights, writer); !ok) {
    return tl::unexpected(ok.error());
  }
  GeneratedPath out = writer.finish();
  out.levels_z_mm = heights;
  return out;
}

}  // namespace capstan::toolpath
