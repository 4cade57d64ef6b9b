#include "planner/making/toolpath/section/spine.h"

#include <algorithm>
#include <cmath>

#include "planner/making/toolpath/defaults.h"
#include "planner/making/toolpath/region/area/inside.h"

namespace capstan::toolpath {

using geometry::Region;
using geometry::Vec2;

namespace {

constexpr double kChord = 0.0005;    ///< mm, of arcs
constexpr double kSamePoint = 1e-6;  ///< mm

}  // namespace

Result<Spine> spine_of_slot(const PathJob& task, const WorkArea& w, double half) {
  const auto& s = task.shape;
  if (s.spine.size() < 2) {
    return fail({.code = "TPA-UNSUPPORTED", .message = s.name + " has no course to follow", .path = s.name});
  }
  Spine out;
  for (const Vec2 p : s.spine) out.line.push_back(xy(task.feature_in_setup.to_parent({p.x, p.y, 0.0})));
  if (norm(out.line.front() - out.line.back()) < kSamePoint) {
    out.closed = true;
    return out;
  }
  const double radius = 0.5 * task.cutter.cutting_diameter_mm;
  const Inside reach(w.reach);
  const Inside material(w.material);
  for (const bool last : {false, true}) {
    Vec2& end = last ? out.line.back() : out.line.front();
    const Vec2 before = last ? out.line[out.line.size() - 2] : out.line[1];
    const Vec2 way = (1.0 / norm(end - before)) * (end - before);
    const Vec2 across{-way.y, way.x};
    if (reach.contains(end + (half + 1.0) * way)) {
      (last ? out.air_last : out.air_first) = true;
      const auto free = [&](Vec2 p) { return material.clear_of(p, radius + 0.2); };
      end = end + (radius + kAirBeyond) * way;
      for (int i = 0; i < 50 && !(free(end) && free(end + half * across) && free(end - half * across)); ++i)
        end = end + 0.5 * radius * way;
    } else if (reach.contains(end + 0.5 * half * way)) {
      (last ? out.round_last : out.round_first) = true;
    } else {
      const double length = norm(end - before);
      if (length <= radius) {
        return fail(
            {.code = "TPA-NO-FIT",
             .message = "the cutter " + task.cutter.id + " does not fit between the ends of " + s.name,
             .path = s.name});
      }
      end = end - radius * way;
    }
  }
  if (!out.air_first && out.air_last) {
    std::reverse(out.line.begin(), out.line.end());
    std::swap(out.air_first, out.air_last);
    std::swap(out.round_first, out.round_last);
  }
  return out;
}

Spine spine_of_hole(const PathJob& task) {
  Spine s;
  s.line = {xy(task.feature_in_setup.origin)};
  return s;
}

Region within(const Spine& s, double d) {
  if (s.line.size() == 1) return geometry::disc(s.line.front(), d, kChord);
  Region r = geometry::stroke(s.line, d, false, kChord);
  if (s.round_first) r = geometry::unite(r, geometry::disc(s.line.front(), d, kChord));
  if (s.round_last) r = geometry::unite(r, geometry::disc(s.line.back(), d, kChord));
  return r;
}

std::vector<Track> tracks_at(const Spine& s, double d, bool walls_right) {
  if (s.line.size() == 1) {
    if (!(d > 0.0)) return {};
    const Vec2 c = s.line.front();
    const Bend bend = walls_right ? Bend::kCcw : Bend::kCw;
    // Begun beside where a helix ends, so that no crumb of an arc is left there.
    return {{.start = {c.x, c.y + d},
             .segments = {{{c.x, c.y - d}, c, bend}, {{c.x, c.y + d}, c, bend}},
             .closed = true}};
  }
  if (!(d > 0.0)) {
    Track t = track_of_line(s.line);
    t.closed = s.closed;
    return {t};
  }
  std::vector<Track> out;
  for (const auto& loop : within(s, d).loops) {
    const Track t = track_of(loop);
    out.push_back(walls_right ? t : reversed(t));
  }
  return out;
}

}  // namespace capstan::toolpath
