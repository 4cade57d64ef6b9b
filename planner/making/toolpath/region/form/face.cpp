#include <algorithm>
#include <cmath>

#include "planner/ground/base/number.h"
#include "planner/making/toolpath/defaults.h"
#include "planner/making/toolpath/region/patterns.h"
#include "planner/making/toolpath/region/region_paths.h"

namespace capstan::toolpath {

using geometry::Region;
using geometry::Vec2;
using model::MoveRole;
using model::StrategyKind;

namespace {

/// Largest distance between passes: the width of the flat end, else a corner radius leaves ridges between
/// them. A ball always leaves ridges: a tenth of its diameter, default, unsourced.
double flat_of(const model::Cutter& c) {
  return std::max(c.cutting_diameter_mm - 2.0 * c.corner_radius_mm, 0.1 * c.cutting_diameter_mm);
}

/// Overhang of a single pass over the edge at which it ends, in cutter radii. Default, unsourced.
constexpr double kOverhang = 0.1;
constexpr double kSomeArea = 0.1;  // mm2: less is chords of arcs

geometry::Loop oriented(geometry::Loop loop) {
  if (geometry::signed_area(loop) < 0.0) std::reverse(loop.begin(), loop.end());
  return loop;
}

constexpr double kRounding = 1e-6;  // mm

struct Stroke {
  Vec2 from, to;
  Vec2 first, last;  ///< the cutter's middle where all before and all behind it is cut
};

class Face {
 public:
  Face(const PathJob& task, const WorkArea& w, Job& job)
      : task_(task), w_(w), job_(job), writer_(task), radius_(0.5 * task.cutter.cutting_diameter_mm) {
    e_ = pass_direction(task, w.area);
    const bool one_way = task.strategy == StrategyKind::kUnidirectional;
    const bool left =
        one_way && !task.stepover_left ? !walls_on_right(task) : task.stepover_left.value_or(true);
    n_ = left ? Vec2{-e_.y, e_.x} : Vec2{e_.y, -e_.x};
  }

  Result<GeneratedPath> run() {
    const double end = w_.bottom_z_mm + task_.allowance_bottom_mm;
    const bool single = task_.multiple_passes.has_value() && !*task_.multiple_passes;
    const auto heights =
        levels(w_, task_.start_z_mm, end, single ? 0.0 : task_.axial_depth_mm, task_.allowance_bottom_mm);
    if (heights.empty()) {
      return fail({.code = kNothingToCut,
                   .message = task_.shape.name + " has nothing to cut between " +
                              trimmed(task_.start_z_mm, 3) + " and " + trimmed(end, 3) + " mm",
                   .path = task_.shape.name});
    }
    double from = task_.start_z_mm;
    for (const double z : heights) {
      if (auto ok = level(z, from); !ok) return tl::unexpected(ok.error());
      from = z;
    }
    GeneratedPath out = writer_.finish();
    out.levels_z_mm = heights;
    return out;
  }

 private:
  /// Areas higher than the level, which must not be touched, grown by the cutter.
  [[nodiscard]] Region obstacles(double z, double more) const {
    Region stand;
    for (const auto& i : w_.islands) {
      if (i.top_z_mm + task_.allowance_bottom_mm > z + 1e-6) stand = geometry::unite(stand, i.area);
    }
    // Where nothing is rounded at its foot, what stands and what is avoided are gone round as one.
    if (!(w_.bottom_radius_mm > 0.0)) stand = geometry::unite(stand, w_.avoid);
    const Region r = kept_off(w_, stand, task_.cutter, z, more);
    if (!(w_.bottom_radius_mm > 0.0) || w_.avoid.empty()) return r;
    return geometry::unite(r, inset(w_.avoid, -(radius_ + more), kWallChord));
  }

  /// How much of the face a cutter clears whose centre may be in `centres` without `but`, mm2.
  [[nodiscard]] double reached(const Region& centres, const Region& but) const {
    const Region c = but.empty() ? centres : geometry::subtract(centres, but);
    return geometry::area(geometry::intersect(geometry::offset(c, radius_), w_.area));
  }

  /// Extent along the passes of what of the region lies within a cutter's radius of the line at v.
  bool extent(const Region& of, double v, double& lo, double& hi) const {
    lo = 1e300;
    hi = -1e300;
    for (const auto& loop : of.loops) {
      for (std::size_t i = 0; i < loop.size(); ++i) {
        const Vec2 a = loop[i];
        const Vec2 d = loop[(i + 1) % loop.size()] - a;
        const double va = dot(a, n_) - v;
        const double dv = dot(d, n_);
        double t0 = 0.0;
        double t1 = 1.0;
        if (std::abs(dv) < 1e-12) {
          if (std::abs(va) > radius_) continue;
        } else {
          const double p = (-radius_ - va) / dv;
          const double q = (radius_ - va) / dv;
          t0 = std::max(t0, std::min(p, q));
          t1 = std::min(t1, std::max(p, q));
          if (t0 > t1) continue;
        }
        for (const double t : {t0, t1}) {
          lo = std::min(lo, dot(a + t * d, e_));
          hi = std::max(hi, dot(a + t * d, e_));
        }
      }
    }
    return lo <= hi;
  }

  /// Distance of passes over a face of this width: what may be, less where as many passes are equally wide
  /// with it. A distance that a file gives is kept.
  [[nodiscard]] double equal_step(double width) const {
    const double flat = flat_of(task_.cutter), most = std::min({stepover_of(task_), 1.98 * radius_, flat});
    if (task_.overlap || !(task_.radial_depth_mm > 0.0)) return most;
    // The flat end of the last pass reaches the edge, and over it as a single pass does.
    const double to_cover = width + radius_ - 0.5 * flat;
    const double passes = std::max(1.0, std::ceil(to_cover / most - kRounding));
    return passes > 1.0 ? std::min(most, (to_cover + kOverhang * radius_) / passes) : most;
  }

  /// How far from the axis the cutter reaches at most, up to a height: its edge may lean.
  [[nodiscard]] double widest(double depth_mm) const {
    return model::profile_of(task_.cutter).radius_at(depth_mm);
  }
  /// From the cutter's axis to the piece where it comes down beside it.
  [[nodiscard]] double beside(double depth_mm) const {
    return std::max(radius_ + kAirBeyond, widest(depth_mm));
  }

  [[nodiscard]] std::vector<Stroke> strokes(double depth_mm) const {
    double lo = 1e300;
    double hi = -1e300;
    for (const auto& loop : w_.area.loops) {
      for (const Vec2 p : loop) {
        lo = std::min(lo, dot(p, n_));
        hi = std::max(hi, dot(p, n_));
      }
    }
    const double step = equal_step(hi - lo), over = beside(depth_mm);
    // The first pass overhangs the edge by what passes overlap, so that it is as wide as the others.
    double first = std::min(lo + step - radius_, 0.5 * (lo + hi));
    // A single pass overhangs both edges: a rim exactly on an edge would leave slivers there.
    if (first + 0.5 * flat_of(task_.cutter) >= hi - 1e-6)
      first = std::min(std::max(first, hi - radius_ + kOverhang * radius_), 0.5 * (lo + hi));
    std::vector<Stroke> out;
    const Inside material(w_.material);
    for (int k = 0; k < 100'000; ++k) {
      const double v = first + k * step;
      double a = 0.0;
      double b = 0.0;
      if (extent(w_.area, v, a, b)) {
        Stroke s{.from = (a - over) * e_ + v * n_, .to = (b + over) * e_ + v * n_, .first = {}, .last = {}};
        free_start(material, over, s);
        extent(w_.material, v, a, b);
        s.first = std::max(a - kAirBeyond, dot(s.from, e_)) * e_ + v * n_;
        s.last = std::min(b + kAirBeyond, dot(s.to, e_)) * e_ + v * n_;
        out.push_back(s);
      }
      // The flat end must reach the edge: beyond it a corner radius would leave a ridge.
      if (v + 0.5 * flat_of(task_.cutter) >= hi - 1e-6) break;
    }
    return out;
  }

  /// Moves the ends of a pass out of raw material that is larger than the face.
  void free_start(const Inside& material, double over, Stroke& s) const {
    const double room = over - kRounding;
    for (int i = 0; i < 20 && !material.clear_of(s.from, room); ++i) s.from = s.from - 0.25 * radius_ * e_;
    for (int i = 0; i < 20 && !material.clear_of(s.to, room); ++i) s.to = s.to + 0.25 * radius_ * e_;
  }

  Status level(double z, double from) {
    if (task_.strategy == StrategyKind::kContourParallel || task_.strategy == StrategyKind::kContourSpiral ||
        task_.strategy == StrategyKind::kContourBidirectional) {
      return contours(z, from);
    }
    const Region keep_off = obstacles(z, task_.allowance_side_mm);
    auto all = strokes(from - z);
    if (!keep_off.empty()) return around(z, from, all, keep_off);
    const Inside material(w_.material);
    const bool one_way = task_.strategy == StrategyKind::kUnidirectional;
    bool forward = true;
    for (std::size_t i = 0; i < all.size(); ++i) {
      const Vec2 a = forward ? all[i].from : all[i].to;
      if (i == 0 || one_way) {
        if (!material.clear_of(a, radius_) && i == 0) {
          return fail(
              {.code = "TPA-ENTRY",
               .message = "the face " + task_.shape.name + " cannot be started outside of the raw material",
               .path = task_.shape.name});
        }
        writer_.over(a);
        writer_.descend(z, z);
      } else {
        const bool beside = material.clear_along(xy(writer_.at()), a, radius_);
        writer_.line({a.x, a.y, z}, beside ? MoveRole::kLink : MoveRole::kCut);
      }
      pass(all[i], forward, z);
      if (!one_way) forward = !forward;
    }
    writer_.retract();
    return {};
  }

  /// Cuts from one end of a stroke to the other. Behind the piece the edges of the cutter's rear run out at
  /// the feed of the cut where they leave the face's pattern, at that of air where it is cut away later.
  void pass(const Stroke& s, bool forward, double z) {
    const bool stays = task_.allowance_bottom_mm <= 0.0 && z <= w_.bottom_z_mm + kRounding;
    const Vec2 to = forward ? s.to : s.from, behind = forward ? s.last : s.first;
    if (!stays) writer_.line({behind.x, behind.y, z}, MoveRole::kCut);
    writer_.line({to.x, to.y, z}, stays ? MoveRole::kCut : MoveRole::kLink);
  }

  /// Straight passes over a face with islands: first the area between them, then along the islands.
  Status around(double z, double from, const std::vector<Stroke>& all, const Region& keep_off) {
    WorkArea open = w_;
    open.reach = geometry::offset_sharp(w_.area, 3.0 * radius_);
    open.open = true;
    LevelCutter c(task_, open, writer_, job_);
    c.step_mm = std::min(c.step_mm, flat_of(task_.cutter));
    Level level(task_, open, z, from, task_.allowance_side_mm);
    // Along the passes beyond the edge; across, the first and the last pass are as wide as the others.
    const Vec2 first = all.front().from;
    const Vec2 last = all.back().from;
    const double across = dot(last - first, n_);
    const double far = 1e4;
    const geometry::Loop band = {first - far * e_, first + far * e_, first + far * e_ + across * n_,
                                 first - far * e_ + across * n_};
    const Region out = geometry::offset_sharp(w_.area, beside(from - z));
    level.centres = geometry::subtract(geometry::intersect(out, geometry::clean({oriented(band)})), keep_off);
    // Between an island and the edge only a part of the cutter may fit: add passes further out.
    if (reached(out, keep_off) > reached(level.centres, {}) + kSomeArea)
      level.centres = geometry::subtract(out, keep_off);
    level.inside = Inside(inset(level.centres, -kInsideSlack, 0.25 * kInsideSlack));
    level.air.clear();
    const double clear = std::max(radius_ + 0.1, widest(from - z) - kRounding);
    for (const auto& loop : level.centres.loops) {
      for (const Vec2 p : loop) {
        if (level.material.clear_of(p, clear)) level.air.push_back(p);
      }
    }
    RasterOptions o;
    o.direction = e_;
    o.one_way = task_.strategy == StrategyKind::kUnidirectional;
    o.step_left = n_ == Vec2{-e_.y, e_.x};
    o.wall_of = &keep_off;
    return cut_raster(c, level, o);
  }

  /// Rings from outside in, the first one as far inside the edge as a pass is wide.
  Status contours(double z, double from) {
    WorkArea open = w_;
    open.reach = geometry::offset_sharp(w_.area, 3.0 * radius_ + 2.0);
    open.open = true;
    LevelCutter c(task_, open, writer_, job_);
    Level level(task_, open, z, from, task_.allowance_side_mm);
    const double step = std::min({c.step_mm, 0.99 * radius_, flat_of(task_.cutter)});
    const double inside = step - radius_;
    const Region keep_off = obstacles(z, task_.allowance_side_mm);
    const Region ring =
        inside > 0 ? inset(w_.area, inside, kWallChord) : geometry::offset_sharp(w_.area, -inside + 1e-6);
    const Region lead = geometry::offset_sharp(w_.area, 1.2 * radius_ + 0.3);
    level.centres = geometry::subtract(ring, keep_off);
    level.inside = Inside(inset(geometry::subtract(lead, keep_off), -kInsideSlack, 0.25 * kInsideSlack));
    level.air.clear();
    for (const auto& loop : lead.loops) {
      for (std::size_t i = 0; i < loop.size(); ++i) {
        for (const double t : {0.0, 0.25, 0.5, 0.75}) {
          const Vec2 p = loop[i] + t * (loop[(i + 1) % loop.size()] - loop[i]);
          if (level.material.clear_of(p, radius_ + 0.1) && level.inside.contains(p)) level.air.push_back(p);
        }
      }
    }
    ContourOptions o;
    o.outside_in = true;
    return cut_contours(c, level, o);
  }

  const PathJob& task_;
  const WorkArea& w_;
  Job& job_;
  PathWriter writer_;
  double radius_;
  Vec2 e_, n_;
};

}  // namespace

Result<GeneratedPath> face_path(const PathJob& task, Job& job) {
  const auto w = work_area(task);
  if (!w) return tl::unexpected(w.error());
  if (w->area.empty()) {
    return fail({.code = "TPA-DEPTH",
                 .message = "the face " + task.shape.name + " has no area over the raw material",
                 .path = task.shape.name});
  }
  return Face(task, *w, job).run();
}

}  // namespace capstan::toolpath
