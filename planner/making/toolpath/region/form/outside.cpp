#include <algorithm>
#include <cmath>

#include "planner/ground/base/number.h"
#include "planner/ground/geometry/lines/open_line.h"
#include "planner/making/toolpath/defaults.h"
#include "planner/making/toolpath/region/patterns.h"
#include "planner/making/toolpath/region/region_paths.h"

namespace capstan::toolpath {

using geometry::Region;
using geometry::Vec2;
using model::MoveRole;

namespace {

constexpr double kNoAreaMm2 = 1e-3;  // less is rounding of contours
constexpr double kNoFloorMm = 1e-6;

/// Once round each outer contour of `kept` at a distance, the kept side where walls belong.
std::vector<Track> rings_around(const Region& grown, const Region& kept, bool natural) {
  std::vector<Track> out;
  for (const auto& loop : grown.loops) {
    if (geometry::signed_area(loop) <= 0.0) continue;
    if (geometry::intersect(Region{{loop}}, kept).empty()) continue;  // round something else
    Track t = track_of(loop);
    out.push_back(natural ? reversed(t) : t);  // clockwise round what stays: it is on the right
  }
  return out;
}

struct Around {
  const PathJob& task;
  WorkArea w;
  Region kept;
  double radius;
};

Region grown_by(const Around& a, double d) {
  Region g = d > 0.0 ? inset(a.kept, -d, kWallChord) : a.kept;
  if (!a.w.avoid.empty()) g = geometry::unite(g, inset(a.w.avoid, -a.radius, kWallChord));
  return g;
}

/// True if a ring at this distance leaves raw material beyond its outer edge.
bool beyond(const Around& a, double distance) {
  return geometry::area(geometry::subtract(a.task.stock,
                                           inset(a.kept, -(distance + a.radius), kInnerChord))) >= kNoAreaMm2;
}

/// Distances of the rings from what stays, the outermost first, the innermost `from_wall` off it.
std::vector<double> ring_distances(const Around& a, double step, bool shell, double from_wall) {
  const double first = a.radius + from_wall;
  std::vector<double> out = {first};
  if (shell || a.task.stock.empty()) return out;
  for (double d = first; out.size() < 1000; d += step) {
    // Covered so far: a radius beyond the ring.
    if (!beyond(a, d)) break;
    out.push_back(d + step);
  }
  std::reverse(out.begin(), out.end());
  return out;
}

Status cut_around(const Around& a, LevelCutter& c, double z, double from,
                  const std::vector<double>& distances, bool shell) {
  Level level(c.task, a.w, z, shell ? z : from, a.task.allowance_side_mm);
  level.above_mm = from;
  const double room = 2.0 * a.radius + 2.0;
  const Region edge =
      geometry::offset_sharp(geometry::unite(a.w.material, grown_by(a, distances.front())), room);
  level.centres = geometry::subtract(edge, grown_by(a, distances.back()));
  level.inside = Inside(inset(level.centres, -kInsideSlack, 0.25 * kInsideSlack));
  level.air.clear();
  for (const auto& loop : edge.loops) {
    for (std::size_t i = 0; i < loop.size(); ++i) {
      for (const double t : {0.0, 0.25, 0.5, 0.75}) {
        const Vec2 p = loop[i] + t * (loop[(i + 1) % loop.size()] - loop[i]);
        if (level.material.clear_of(p, a.radius + 0.1) && level.inside.contains(p)) level.air.push_back(p);
      }
    }
  }
  if (shell) {
    level.cleared.emplace(
        geometry::subtract(edge, grown_by(a, a.radius + a.task.left_on_side_mm.value_or(0.0) + 0.02)));
  }
  bool first = true;
  for (const double d : distances) {
    const bool wall = d == distances.back();
    for (const Track& t : rings_around(grown_by(a, d), a.kept, walls_on_right(a.task))) {
      if (wall && shell && cut_with_leads(c, level, t)) continue;
      if (shell) level.from_mm = from;
      const Spot spot = c.writer.begun() ? nearest(t, xy(c.writer.at())) : Spot{};
      if (!first && c.cut_to(level, spot.point)) {
        c.follow(level, begun_at(t, spot));
        continue;
      }
      auto in = c.enter(level, t, nullptr);
      if (!in) return tl::unexpected(in.error());
      c.follow(level, *in);
    }
    first = false;
  }
  return {};
}

/// The side of an open line that is taken away, and the line run out over its ends, set-up XY.
struct OpenSide {
  Region removed;
  std::vector<Vec2> line;
};

/// The track at a distance from an open line: the boundary of the removed area, offset inwards, without the
/// parts that do not belong to the line. The removed area lies on the line's left. Empty if the distance
/// leaves no track.
std::vector<Vec2> line_at(const OpenSide& side, double d) {
  constexpr double kBeside = 0.01;  // mm, of chords
  std::vector<Vec2> best;
  for (const auto& loop : inset(side.removed, d, kWallChord).loops) {
    const std::size_t n = loop.size();
    const auto belongs = [&](std::size_t i) {
      return geometry::distance_to_line(side.line, 0.5 * (loop[i] + loop[(i + 1) % n])) < d + kBeside;
    };
    std::size_t first = 0;
    while (first < n && belongs(first)) ++first;
    if (first == n) continue;
    std::vector<Vec2> chain;
    for (std::size_t k = 1; k <= n; ++k) {
      const std::size_t i = (first + k) % n;
      if (!belongs(i)) {
        if (chain.size() > best.size()) best = chain;
        chain.clear();
        continue;
      }
      if (chain.empty()) chain.push_back(loop[i]);
      chain.push_back(loop[(i + 1) % n]);
    }
  }
  return best;
}

/// Cuts the line back at its first end to the point beside `end` where the cutter just leaves the material.
Status run_in(const Around& a, const Inside& material, std::vector<Vec2>& line, Vec2 end, double room) {
  const Vec2 out = (1.0 / norm(line[0] - line[1])) * (line[0] - line[1]);
  const double length = norm(line[0] - line[1]);
  double at = std::clamp(dot(end - line[1], out), 0.0, length);
  while (!material.clear_of(line[1] + at * out, room)) {
    if (at >= length) {
      return fail({.code = "TPA-ENTRY",
                   .message = a.task.shape.name +
                              ": no room for the approach: at the end of the contour cutter " +
                              a.task.cutter.id + " is within " + trimmed(room, 2) +
                              " mm of the raw piece; extend the contour beyond it",
                   .path = a.task.shape.name});
    }
    at = std::min(at + 0.5 * a.radius, length);
  }
  line[0] = line[1] + at * out;
  return {};
}

/// Height of the layer that a finishing step takes from the floor before the wall, mm; 0: none.
double layer_on_floor(const PathJob& task, bool shell) {
  if (!shell || task.operation == model::TypeId::kSideFinishMilling) return 0.0;
  const double layer = task.left_on_bottom_mm.value_or(0.0) - task.allowance_bottom_mm;
  return layer > kNoFloorMm ? layer : 0.0;
}

/// How far from the wall that layer is cut, clear of what is still left on the wall, mm.
double floor_from_wall(const PathJob& task) {
  return std::max(task.allowance_side_mm, task.left_on_side_mm.value_or(0.0));
}

/// Passes along an open line, each from the air before the raw piece to the air behind it.
class OpenLine {
 public:
  OpenLine(const Around& a, double step)
      : a_(a), step_(step), side_{in_setup(a.task.shape.reach, a.task.feature_in_setup), {}} {
    constexpr double kFar = 1e5;  // mm: beyond every raw piece
    for (const Vec2 p : a.task.shape.spine) side_.line.push_back(in_plan(p));
    const std::size_t n = side_.line.size();
    const Vec2 before = side_.line[0] - side_.line[1], behind = side_.line[n - 1] - side_.line[n - 2];
    side_.line.front() = side_.line.front() + (kFar / norm(before)) * before;
    side_.line.back() = side_.line.back() + (kFar / norm(behind)) * behind;
    raw_ = geometry::intersect(a.w.material, side_.removed);
  }

  /// True if a pass at this distance from the line leaves raw material beyond it.
  [[nodiscard]] bool beyond(double distance) const {
    const Region rest = inset(side_.removed, distance + a_.radius, kInnerChord);
    return geometry::area(geometry::intersect(raw_, rest)) >= kNoAreaMm2;
  }

  /// Pass beside pass from the edge of the raw piece to the one `from_wall` off the wall; that one alone
  /// where `alone`. Every pass in the sense that the cut mode asks for.
  [[nodiscard]] Result<std::vector<Track>> passes(double from_wall, bool alone) const {
    std::vector<double> distances = {a_.radius + from_wall};
    while (!alone && distances.size() < 1000 && beyond(distances.back()))
      distances.push_back(distances.back() + step_);
    std::reverse(distances.begin(), distances.end());
    const PathJob& task = a_.task;
    const Inside material(a_.w.material);
    std::vector<Track> out;
    for (const double d : distances) {
      // The removed area lies on the right of the spine, and on the left of its boundary.
      std::vector<Vec2> line = line_at(side_, d);
      if (line.size() < 2) continue;
      for (const Vec2 end : {task.shape.spine.front(), task.shape.spine.back()}) {
        std::reverse(line.begin(), line.end());
        if (auto ok = run_in(a_, material, line, in_plan(end), a_.radius + kAirBeyond); !ok)
          return tl::unexpected(ok.error());
      }
      Track t = track_of_line(line);
      // In this direction the wall is on the right of the pass.
      out.push_back(walls_on_right(task) ? t : reversed(t));
    }
    if (out.empty()) {
      return fail(
          {.code = "TPA-NO-FIT",
           .message = task.shape.name + ": no pass of the cutter " + task.cutter.id + " fits beside it",
           .path = task.shape.name});
    }
    return out;
  }

 private:
  [[nodiscard]] Vec2 in_plan(Vec2 p) const { return xy(a_.task.feature_in_setup.to_parent({p.x, p.y, 0.0})); }

  const Around& a_;
  double step_;
  OpenSide side_;
  Region raw_;
};

Result<GeneratedPath> along_open_line(const Around& a, PathWriter& writer, const std::vector<double>& heights,
                                      double step, bool shell) {
  const OpenLine line(a, step);
  const auto wall = line.passes(a.task.allowance_side_mm, shell);
  if (!wall) return tl::unexpected(wall.error());
  std::vector<Track> floor;
  if (layer_on_floor(a.task, shell) > 0.0 && line.beyond(a.radius + a.task.allowance_side_mm)) {
    auto passes = line.passes(floor_from_wall(a.task), false);
    if (!passes) return tl::unexpected(passes.error());
    floor = std::move(*passes);
  }
  const auto cut = [&](const std::vector<Track>& passes, double z) {
    for (const Track& t : passes) {
      writer.over(t.start);
      writer.descend(z, z);
      writer.follow(t, z, MoveRole::kCut);
    }
  };
  for (const double z : heights) {
    if (z == heights.back()) cut(floor, z);
    cut(*wall, z);
  }
  GeneratedPath out = writer.finish();
  out.levels_z_mm = heights;
  return out;
}

}  // namespace

Result<GeneratedPath> outside_path(const PathJob& task, Job& job) {
  auto w = work_area(task);
  if (!w) return tl::unexpected(w.error());
  Around a{.task = task, .w = *w, .kept = {}, .radius = 0.5 * task.cutter.cutting_diameter_mm};
  for (const auto& i : a.w.islands) a.kept = geometry::unite(a.kept, i.area);
  const bool along = a.kept.empty() && task.shape.spine.size() > 1;
  if (a.kept.empty() && !along) {
    return fail({.code = "TPA-UNSUPPORTED",
                 .message = task.shape.name +
                            ": its closed contour has no area inside that stays; correct the contour",
                 .path = task.shape.name});
  }
  a.w.islands.clear();
  if (task.stock.empty() && along) {
    return fail({.code = "TPA-STOCK",
                 .message = task.shape.name +
                            ": the end of the open contour follows from the raw piece; state it (--stock)",
                 .path = task.shape.name});
  }
  if (task.stock.empty()) a.w.material = a.w.area = geometry::offset_sharp(a.kept, a.radius);
  PathWriter writer(task);
  LevelCutter c(task, a.w, writer, job);
  const bool shell =
      model::has(task.operation, model::OperationTrait::kFinishes) && task.left_on_side_mm.has_value();
  if (task.stock.empty() && !shell)
    c.warn("TPA-REST", "one round beside the contour: the raw piece is not known; state it (--stock)");
  const double step = std::min(c.step_mm, 0.99 * a.radius);
  const double end = a.w.bottom_z_mm + task.allowance_bottom_mm;
  const bool single = task.multiple_passes.has_value() && !*task.multiple_passes;
  const auto heights = levels(a.w, task.start_z_mm, end, single ? 0.0 : task.axial_depth_mm, 0.0);
  if (heights.empty()) {
    return fail(
        {.code = kNothingToCut,
         .message = task.shape.name + " has nothing to cut below " + trimmed(task.start_z_mm, 3) + " mm",
         .path = task.shape.name});
  }
  if (along) return along_open_line(a, writer, heights, step, shell);
  double from = task.start_z_mm;
  for (const double z : heights) {
    // A sloped flank leans inwards going up.
    Around at = a;
    const double lean = std::max(0.0, z - a.w.bottom_z_mm) * std::tan(a.w.slope_rad);
    if (lean > 0.0) at.kept = inset(a.kept, lean, kWallChord);
    if (at.kept.empty()) at.kept = a.kept;
    // A finishing step first removes the allowance on the floor, clear of that on the wall.
    const double on_floor = layer_on_floor(task, shell);
    if (z == heights.back() && on_floor > 0.0 && !task.stock.empty() &&
        beyond(at, task.allowance_side_mm + a.radius)) {
      if (auto ok = cut_around(at, c, z, std::min(from, z + on_floor),
                               ring_distances(at, step, false, floor_from_wall(task)), false);
          !ok)
        return tl::unexpected(ok.error());
    }
    const auto distances = ring_distances(at, step, shell, task.allowance_side_mm);
    if (auto ok = cut_around(at, c, z, from, distances, shell); !ok) return tl::unexpected(ok.error());
    from = z;
  }
  GeneratedPath out = writer.finish();
  out.levels_z_mm = heights;
  return out;
}

}  // namespace capstan::toolpath
