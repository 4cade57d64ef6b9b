#include <algorithm>
#include <cmath>
#include <iterator>
#include <numbers>
#include <string>

#include "planner/ground/base/number.h"
#include "planner/making/toolpath/freeform/finish/between.h"
#include "planner/making/toolpath/freeform/finish/mask.h"
#include "planner/making/toolpath/freeform/finish/pass_writer.h"
#include "planner/making/toolpath/freeform/finish/rest.h"
#include "planner/making/toolpath/freeform/finish/waterline.h"
#include "planner/making/toolpath/freeform/freeform.h"
#include "planner/making/toolpath/freeform/hatch.h"
#include "planner/making/toolpath/freeform/rim.h"
#include "planner/making/toolpath/freeform/surface_line.h"
#include "planner/making/toolpath/freeform/task.h"
#include "planner/making/toolpath/freeform/upright_step.h"
#include "planner/making/toolpath/path_job.h"

// Passes side by side over all of a surface; where it slopes across them too much, others between them
// (between.h). Where both are longer than ways at constant heights along what is steep, those, and passes
// over the rest of it (waterline.h), with a grid point of overlap on either side.
//
// After a wider ball (FreeformJob::after) only what that left: in layers, for it may have left more than a
// small ball bears at once, each of them down what is steep first, then over what is not.

namespace capstan::toolpath::freeform {
namespace {

using geometry::Vec2;
using geometry::Vec3;

/// How much of what a semi-finish leaves its ridges may take beside their own height. Default, unsourced.
constexpr double kShareOfLeft = 0.2;
/// Passes lie between two others at most 2^5 times as close: as ridges on a slope of 88 degrees need.
constexpr int kMostHalvings = 5;
/// From about 45 degrees on ways at constant heights are the shorter ones: across a slope passes are
/// 1 / cos t as many, levels 1 / sin t. Derived; a little more, for many a chamfer and cone has just 45.
constexpr double kSteepRad = 47.0 / 180.0 * std::numbers::pi;
/// What a ball that finishes what a wider one left takes at once, square to the surface: this share of its
/// diameter, for a narrow one is slender, and no more than a last ball meets after a semi-finish, mm.
/// Default, unsourced.
constexpr double kLayerShare = 0.03, kLayerMm = 0.4;
constexpr int kMostLayers = 200;
constexpr const char* kNoSurface = "the area holds no surface to finish";
/// Of the tolerance, for ridges beside the height asked for: three quarters are the passes' own (Follower).
/// As long as none is higher by more than half of it, no passes are put between those of the raster.
constexpr double kRidgeShare = 0.25, kRasterShare = 0.5;
/// Of the tolerance, what ridges in hollows may have beside the height asked for: where a wider ball was
/// before, all of the rest is hollow; else few places are, and the check allows 3.5. Defaults, unsourced.
constexpr double kHollowAfter = 1.5, kHollow = 3.0;
/// Steps are looked for in places so many radii apart along a gap. Default, unsourced.
constexpr double kStepPlaces = 0.25;
/// Of what passes run over, that may have higher ridges unsaid. Default, unsourced.
constexpr double kUnsaidShare = 0.001;

class Finisher {
 public:
  Finisher(const FreeformJob& task, const DropCutter& drop, const MillEnd& cutter, Hatch hatch,
           geometry::Region area, geometry::Region kept_out, Job& job)
      : task_(task),
        drop_(drop),
        cutter_(cutter),
        hatch_(std::move(hatch)),
        area_(std::move(area)),
        kept_out_(std::move(kept_out)),
        job_(job) {
    if (!task.area.empty() || !task.avoid.empty()) allowed_ = geometry::subtract(area_, kept_out_);
  }

  Result<FreeformPath> run() {
    const std::vector<std::vector<Run>> found = passes(task_, nullptr);
    if (job_.stop_requested()) return stopped();
    std::vector<High> high;
    const std::vector<Piece> between = between_passes(task_, found, high);
    if (job_.stop_requested()) return stopped();
    const Reach reach = reach_of(task_);
    std::optional<DropGrid> grid;
    if (task_.stock != nullptr && !task_.area.empty() && cutter_.ball_mm() == cutter_.radius()) {
      grid = reach.grid(area_, job_);
      const std::optional<Mask> standing = where_stock_stands(*grid, drop_, cutter_, task_, job_);
      if (standing) return run_within(*standing, reach, *grid, found, between, high);
    }
    PassWriter all(task_, drop_, cutter_, hatch_.spacing_mm, job_);
    for (std::size_t i = 0; i < found.size(); ++i) {
      if (job_.stop_requested()) return stopped();
      job_.progress("freeform finish", static_cast<double>(i) / static_cast<double>(found.size()));
      const bool back = task_.to_and_fro && hatch_.stripes[i].line % 2 != 0;
      std::vector<Run> runs = found[i];
      if (back) std::reverse(runs.begin(), runs.end());
      for (Run& r : runs) {
        if (back) std::reverse(r.begin(), r.end());
        all.add(r);
      }
    }
    if (all.empty()) return fail("FRF-EMPTY", kNoSurface);
    if (between.empty()) {
      say_of_ridges(high, found, nullptr);
      return written(all);
    }
    all.link_within(0.0);
    all.add_nearest_first(between, hatch_.v_axis);
    PassWriter split(task_, drop_, cutter_, hatch_.spacing_mm, job_);
    split.link_within(cutter_.radius());
    if (!grid) grid = reach.grid(area_, job_);
    const Mask steep = steep_of(*grid, drop_, cutter_, task_.allowance_mm, kSteepRad);
    const Mask passed = add_area(task_, reach, *grid, steep, nullptr, found, between, split);
    if (job_.stop_requested()) return stopped();
    const bool shorter = !split.empty() && split.way_mm() < all.way_mm();
    say_of_ridges(high, found, shorter ? &passed : nullptr);
    return written(shorter ? split : all);
  }

  /// Passes, and ways at constant heights, where stock stands: what other mills or the raw piece have left at
  /// its height already is not gone over.
  Result<FreeformPath> run_within(const Mask& standing, const Reach& reach, const DropGrid& grid,
                                  const std::vector<std::vector<Run>>& found,
                                  const std::vector<Piece>& between, const std::vector<High>& high) const {
    PassWriter out(task_, drop_, cutter_, hatch_.spacing_mm, job_);
    out.link_within(cutter_.radius());
    const Mask steep =
        between.empty() ? empty_mask(grid) : steep_of(grid, drop_, cutter_, task_.allowance_mm, kSteepRad);
    std::vector<std::vector<Run>> runs(found.size());
    for (std::size_t i = 0; i < found.size(); ++i) runs[i] = within(found[i], standing);
    std::vector<Piece> pieces;
    for (const Piece& p : between) {
      for (Run& piece : within(p.run, standing)) pieces.push_back({p.v, std::move(piece)});
    }
    const Mask passed = add_area(task_, reach, grid, steep, &standing, runs, pieces, out);
    if (job_.stop_requested()) return stopped();
    if (out.empty()) return fail("FRF-EMPTY", kNoSurface);
    say_of_ridges(high, runs, &passed);
    return written(out);
  }

  /// What a wider ball left.
  Result<FreeformPath> run_after(const MillEnd& wider) {
    const DropGrid places = reach_of(task_).grid(area_, job_);
    std::vector<double> left = left_by_wider(places, drop_, cutter_, wider, task_.stock, job_);
    if (job_.stop_requested()) return stopped();
    const double limit = task_.scallop_mm + task_.tolerance_mm;
    const double layer_mm = std::min(kLayerMm, kLayerShare * 2.0 * cutter_.radius());
    double most = 0.0;
    for (std::size_t i = 0; i < left.size(); ++i) {
      if (std::isinf(left[i])) left[i] = std::max(0.0, stands_over(places, i));
      most = std::max(most, left[i]);
    }
    const int layers = std::clamp(static_cast<int>(std::ceil((most - limit) / layer_mm)), 1, kMostLayers);
    std::vector<High> high;
    PassWriter out(task_, drop_, cutter_, hatch_.spacing_mm, job_);
    out.link_within(cutter_.radius());
    for (int k = layers - 1; k >= 0; --k) {
      job_.progress("freeform finish", 1.0 - static_cast<double>(k + 1) / layers);
      FreeformJob layer = task_;
      layer.allowance_mm = task_.allowance_mm + k * layer_mm;
      if (k > 0) {  // not the last: as coarse as the next bears
        layer.scallop_mm = std::max(task_.scallop_mm, 0.25 * layer_mm);
        layer.tolerance_mm = std::max(task_.tolerance_mm, 0.1 * layer_mm);
      }
      const Mask rest = grown(more_than(places, left, k * layer_mm + limit), 1);
      if (!rest.any()) continue;
      const Reach reach = reach_of(layer);
      const DropGrid grid = about(reach, places, grown(rest, 2));
      const Mask steep = steep_of(grid, drop_, cutter_, layer.allowance_mm, kSteepRad);
      const auto found = passes(layer, &rest);
      out.keep(layer);
      high.clear();  // of the last layer alone
      const std::vector<Piece> between = between_passes(layer, found, high);
      const Mask passed = add_area(layer, reach, grid, steep, &rest, found, between, out);
      if (job_.stop_requested()) return stopped();
      if (k == 0) say_of_ridges(high, found, &passed);
    }
    if (out.empty()) return fail(kNothingToCut, "the wider ball before it leaves no more than it may");
    return written(out);
  }

 private:
  static tl::unexpected<Diagnostic> stopped() {
    return fail("FRF-STOPPED", "the finish path was stopped before it was whole");
  }

  [[nodiscard]] FreeformPath written(PassWriter& passes) const {
    FreeformPath out;
    out.path = passes.finished();
    out.stepover_mm = hatch_.spacing_mm;
    return out;
  }

  /// Half of the tolerance lifts the cutter, as the Follower does.
  [[nodiscard]] Reach reach_of(const FreeformJob& task) const {
    Reach out{.task = task, .drop = drop_, .cutter = cutter_, .kept_out = kept_out_};
    out.margin_mm = 0.5 * task.tolerance_mm;
    out.spacing_mm = std::min(probe_spacing(cutter_.ball_mm() + task.allowance_mm, out.margin_mm),
                              kProbedShare * cutter_.radius());
    out.floor_mm = task.bottom_z_mm;
    out.beside = task.beside_is_free;
    return out;
  }

  /// The tip's places about an area; NaN elsewhere. `places`: those without a layer's allowance.
  [[nodiscard]] DropGrid about(const Reach& reach, const DropGrid& places, const Mask& area) const {
    DropGrid out = places;
    parallel_for(job_, static_cast<std::size_t>(out.ny), [&](std::size_t row) {
      std::uint32_t hint = 0;
      for (int ix = 0; ix < out.nx; ++ix) {
        const std::size_t i = row * static_cast<std::size_t>(out.nx) + static_cast<std::size_t>(ix);
        if (std::isnan(out.z[i])) continue;
        out.z[i] = area.on[i] != 0 ? reach.at(out.place(ix, static_cast<int>(row)), hint) : std::nan("");
      }
    });
    return out;
  }

  /// The height that ridges may have, with a share of the tolerance.
  [[nodiscard]] double most_ridge(const FreeformJob& task, double share) const {
    return task.scallop_mm + share * task.tolerance_mm + kShareOfLeft * task_.allowance_mm;
  }

  /// How far apart passes may lie along the surface, for ridges no higher than asked.
  [[nodiscard]] double most_apart(const FreeformJob& task, double share = kRidgeShare) const {
    return std::max(hatch_.spacing_mm, scallop_stepover(cutter_.ball_mm(), most_ridge(task, share)));
  }

  /// What may stand above a place of the tip, mm.
  [[nodiscard]] double stands_over(const DropGrid& places, std::size_t i) const {
    const auto nx = static_cast<std::size_t>(places.nx);
    const Vec2 p = places.place(static_cast<int>(i % nx), static_cast<int>(i / nx));
    const double top =
        task_.stock != nullptr ? stock::max_height(*task_.stock, p, cutter_.radius()) : task_.top_z_mm;
    return top - places.z[i];
  }

  /// The passes of the hatch, by stripe; `only`: pieces of them.
  [[nodiscard]] std::vector<std::vector<Run>> passes(const FreeformJob& task, const Mask* only) const {
    std::vector<std::vector<Run>> found(hatch_.stripes.size());
    const Follower follow = follower_of(task, drop_, cutter_);
    parallel_for(job_, found.size(), [&](std::size_t i) {
      if (job_.stop_requested()) return;
      const Stripe& s = hatch_.stripes[i];
      if (only == nullptr) {
        found[i] = follow.over(hatch_.place(s.lo, s.v), hatch_.place(s.hi, s.v));
        return;
      }
      const int n = std::max(1, static_cast<int>(std::ceil(2.0 * (s.hi - s.lo) / only->step_mm)));
      const auto at = [&](int k) { return hatch_.place(s.lo + (s.hi - s.lo) * k / n, s.v); };
      int first = -1;
      for (int k = 0; k <= n + 1; ++k) {
        const bool in = k <= n && only->at(at(k));
        if (in && first < 0) first = k;
        if (in || first < 0) continue;
        if (k - 1 > first) {
          for (Run& run : follow.over(at(first), at(k - 1))) found[i].push_back(std::move(run));
        }
        first = -1;
      }
    });
    return found;
  }

  /// Ways at constant heights along what is steep, then pieces of passes over the rest, of an area or of all.
  /// Returns the rest; it has what those ways left out, too.
  Mask add_area(const FreeformJob& task, const Reach& reach, const DropGrid& grid, const Mask& steep,
                const Mask* area, const std::vector<std::vector<Run>>& found,
                const std::vector<Piece>& between, PassWriter& out) const {
    const Mask walls = area != nullptr ? both(grown(steep, 1), *area) : grown(steep, 1);
    Waterlines lines = waterlines(reach, grid, walls, most_apart(task), job_);
    out.add_levels(std::move(lines.levels));
    Mask shallow = grown(inverse(steep), 1);
    if (lines.left_out_mm > 0.0) shallow = either(shallow, lines.left_out);
    std::vector<Piece> pieces;
    const auto add = [&](double v, const Run& run) {
      for (Run& piece : within(run, shallow)) pieces.push_back({v, std::move(piece)});
    };
    for (std::size_t i = 0; i < found.size(); ++i) {
      for (const Run& run : found[i]) add(hatch_.stripes[i].v, run);
    }
    for (const Piece& piece : between) add(piece.v, piece.run);
    std::stable_sort(pieces.begin(), pieces.end(), [](const Piece& a, const Piece& b) { return a.v < b.v; });
    out.add_nearest_first(pieces, hatch_.v_axis);
    return shallow;
  }

  /// The runs along a line of the hatch, or along one between two of them.
  struct Line {
    int number = 0;
    double v = 0.0;
    std::vector<Run> runs;
  };

  [[nodiscard]] std::vector<Line> lines_of(const std::vector<std::vector<Run>>& found) const {
    std::vector<Line> lines;
    for (std::size_t i = 0; i < found.size(); ++i) {
      const Stripe& s = hatch_.stripes[i];
      if (lines.empty() || s.line != lines.back().number) lines.push_back({s.line, s.v, {}});
      auto& runs = lines.back().runs;
      runs.insert(runs.end(), found[i].begin(), found[i].end());
    }
    return lines;
  }

  /// Passes between those of the hatch where these lie too far apart along the surface, by v; `high` is given
  /// where they still do: with a stated stepover wherever they do.
  std::vector<Piece> between_passes(const FreeformJob& task, const std::vector<std::vector<Run>>& found,
                                    std::vector<High>& high) const {
    if (!(task.scallop_mm > 0.0)) return {};
    const std::vector<Line> lines = lines_of(found);
    if (lines.size() < 2) return {};
    const std::size_t n = lines.size() - 1;
    std::vector<std::vector<Piece>> gaps(n);
    std::vector<std::vector<High>> left(n);
    const Follower follow = follower_of(task, drop_, cutter_);
    // What lies between lines that do not follow each other is none of theirs: a clamp may stand there.
    const auto are_neighbours = [&](std::size_t i) { return lines[i + 1].number == lines[i].number + 1; };
    const bool stated = task.stepover_mm > 0.0;
    std::vector<char> wide(n);
    const double raster = stated ? scallop_stepover(cutter_.ball_mm(), most_ridge(task, kRasterShare))
                                 : most_apart(task, kRasterShare);
    parallel_for(job_, n, [&](std::size_t i) {
      if (job_.stop_requested() || !are_neighbours(i)) return;
      std::vector<Gap> found_here = wide_here(follow, raster, lines[i], lines[i + 1], true);
      if (!stated) add_hollows(follow, lines[i], lines[i + 1], found_here);
      wide[i] = found_here.empty() ? 0 : 1;
      if (stated) note_high(lines[i], lines[i + 1], found_here, left[i]);
    });
    const bool any = std::any_of(wide.begin(), wide.end(), [](char c) { return c != 0; });
    if (any && !stated) {
      const double apart = most_apart(task);
      parallel_for(job_, n, [&](std::size_t i) {
        if (job_.stop_requested() || !are_neighbours(i)) return;
        fill(follow, apart, lines[i], lines[i + 1], kMostHalvings, gaps[i], left[i]);
      });
    }
    std::vector<Piece> out;
    for (std::size_t i = 0; i < n; ++i) {
      std::move(gaps[i].begin(), gaps[i].end(), std::back_inserter(out));
      high.insert(high.end(), left[i].begin(), left[i].end());
    }
    return out;
  }

  void note_high(const Line& below, const Line& above, const std::vector<Gap>& wide,
                 std::vector<High>& high) const {
    const double dv = above.v - below.v;
    for (const Gap& gap : wide)
      high.push_back(
          {0.5 * (below.v + above.v), gap.lo, gap.hi, dv, ridge_mm(cutter_.ball_mm(), gap.apart_mm)});
  }

  /// Says where ridges come out higher than asked. `passed`: where passes are what cuts; null: all over.
  void say_of_ridges(const std::vector<High>& high, const std::vector<std::vector<Run>>& found,
                     const Mask* passed) const {
    double over = 0.0, all = 0.0, worst = 0.0;
    const double step = kStepPlaces * cutter_.radius();
    for (const High& h : high) {
      const int n = std::max(1, static_cast<int>(std::ceil((h.hi - h.lo) / step)));
      int in = 0;
      for (int k = 0; k < n; ++k)
        in +=
            passed == nullptr || passed->at(hatch_.place(h.lo + (k + 0.5) / n * (h.hi - h.lo), h.v)) ? 1 : 0;
      if (in == 0) continue;
      over += (h.hi - h.lo) * h.dv * in / n;
      worst = std::max(worst, h.ridge_mm);
    }
    for (const auto& runs : found) {
      for (const Run& run : runs) all += norm(xy(run.back()) - xy(run.front())) * hatch_.spacing_mm;
    }
    if (!(all > 0.0) || !(over > kUnsaidShare * all)) return;
    job_.note("FRF-SCALLOP",
              "on " + trimmed(std::min(100.0, 100.0 * over / all), 1) +
                  " % of what the passes run over, seen from above, ridges are higher than " +
                  trimmed(task_.scallop_mm, 4) + " mm, up to " + trimmed(worst, 4) +
                  " mm, because it slopes across the passes: " +
                  (task_.stepover_mm > 0.0
                       ? "state a smaller stepover, or a scallop height alone, which puts passes between them"
                       : "state a feed direction that runs up and down it"));
  }

  /// Too wide gaps between two lines; `first`: between lines of the hatch, without upright steps. Such a step
  /// is no slope: however close passes lie, one is above it and the next below.
  [[nodiscard]] std::vector<Gap> wide_here(const Follower& follow, double apart, const Line& below,
                                           const Line& above, bool first) const {
    const std::vector<Gap> wide = wide_gaps(below.runs, above.runs, hatch_, apart);
    if (!first) return wide;
    std::vector<Gap> out;
    for (const Gap& gap : wide) {
      const int n =
          std::max(1, static_cast<int>(std::ceil((gap.hi - gap.lo) / (kStepPlaces * cutter_.radius()))));
      const auto at = [&](int k) { return k == n ? gap.hi : gap.lo + (gap.hi - gap.lo) * k / n; };
      bool goes_on = false;
      for (int k = 0; k < n; ++k) {
        const double u = 0.5 * (at(k) + at(k + 1));
        const bool upright = has_upright_step(drop_, cutter_, follow.allowance_mm, hatch_.place(u, below.v),
                                              hatch_.place(u, above.v));
        if (!upright && goes_on) out.back().hi = at(k + 1);
        if (!upright && !goes_on) out.push_back({at(k), at(k + 1), gap.apart_mm});
        goes_on = !upright;
      }
    }
    return out;
  }

  void fill(const Follower& follow, double apart, const Line& below, const Line& above, int halvings,
            std::vector<Piece>& out, std::vector<High>& high) const {
    std::vector<Gap> wide = wide_here(follow, apart, below, above, halvings == kMostHalvings);
    add_hollows(follow, below, above, wide);
    if (wide.empty()) return;
    if (halvings == 0) return note_high(below, above, wide, high);
    Line middle{below.number, 0.5 * (below.v + above.v), {}};
    for (const Gap& gap : wide) {
      for (const auto& [lo, hi] : parts_in(allowed_, hatch_, middle.v, gap)) {
        for (Run& run : follow.over(hatch_.place(lo, middle.v), hatch_.place(hi, middle.v)))
          middle.runs.push_back(std::move(run));
      }
    }
    fill(follow, apart, below, middle, halvings - 1, out, high);
    for (const Run& run : middle.runs) out.push_back({middle.v, run});
    fill(follow, apart, middle, above, halvings - 1, out, high);
  }

  /// Places where a ball between two passes would go deeper than the line from one to the other: in a hollow
  /// hardly wider than the ball the ridge is higher by that depth than that of a plane.
  void add_hollows(const Follower& follow, const Line& below, const Line& above,
                   std::vector<Gap>& wide) const {
    const double most = task_.scallop_mm + (task_.after ? kHollowAfter : kHollow) * task_.tolerance_mm +
                        kShareOfLeft * task_.allowance_mm;
    const double step = kStepPlaces * cutter_.radius(), v = 0.5 * (below.v + above.v);
    const double dv = above.v - below.v;
    const auto ends = [&](const Run& run) {
      return std::pair(dot(xy(run.front()), hatch_.u_axis), dot(xy(run.back()), hatch_.u_axis));
    };
    std::uint32_t hint = 0;
    const auto z = [&](double u, double at_v) {
      const Vec2 p = hatch_.place(u, at_v);
      return drop_.drop(cutter_, p.x, p.y, follow.allowance_mm, hint);
    };
    const std::size_t before = wide.size();
    for (const Run& one : below.runs) {
      for (const Run& other : above.runs) {
        const double lo = std::max(ends(one).first, ends(other).first);
        const double hi = std::min(ends(one).second, ends(other).second);
        for (double u = lo + 0.5 * step; u < hi; u += step) {
          const double a = z(u, below.v), m = z(u, v), b = z(u, above.v);
          if (a == DropCutter::kNoContact || m == DropCutter::kNoContact || b == DropCutter::kNoContact)
            continue;
          const double apart = std::hypot(dv, b - a), depth = (0.5 * (a + b) - m) * dv / apart;
          if (depth <= 0.0 || ridge_mm(cutter_.ball_mm(), apart) + depth <= most) continue;
          wide.push_back({std::max(lo, u - step), std::min(hi, u + step), apart});
        }
      }
    }
    if (wide.size() == before) return;
    std::sort(wide.begin(), wide.end(), [](const Gap& a, const Gap& b) { return a.lo < b.lo; });
    std::vector<Gap> joined;
    for (const Gap& gap : wide) add_gap(joined, gap);
    wide = std::move(joined);
  }

  const FreeformJob& task_;
  const DropCutter& drop_;
  const MillEnd& cutter_;
  Hatch hatch_;
  geometry::Region area_, kept_out_;
  geometry::Region allowed_;  ///< the one without the other; empty: all, and lines run beyond the rim
  Job& job_;
};

}  // namespace

double scallop_stepover(double ball_radius_mm, double scallop_mm) {
  const double h = std::clamp(scallop_mm, 0.0, ball_radius_mm);
  return 2.0 * std::sqrt(h * (2.0 * ball_radius_mm - h));
}

Result<FreeformPath> finish(const FreeformJob& task, Job& job) {
  const auto cutter = checked_cutter(task);
  if (!cutter) return tl::unexpected(cutter.error());
  if (!(cutter->ball_mm() > 0.0)) {
    return fail("FRF-CUTTER",
                "finishing a surface needs a cutter that is taken without a corner; '" + task.cutter.id +
                    "' is taken with one, as every flat and tapered mill is: name a ball or bull nosed one");
  }
  const double stepover =
      task.stepover_mm > 0.0 ? task.stepover_mm : scallop_stepover(cutter->ball_mm(), task.scallop_mm);
  if (!(stepover > 0.0)) return fail("FRF-VALUE", "neither a stepover nor a scallop height is given");
  const DropCutter drop(*task.surface);
  // A step to the next pass is shorter than what is kept out of is wide.
  const geometry::Region area = area_of(task, drop);
  geometry::Region out = kept_out(task, *cutter);
  Hatch lines = hatch(geometry::subtract(area, out), task.feed_angle_rad, stepover);
  // What is kept out of may lie beyond the rim.
  if (task.area.empty() && task.avoid.empty()) lines = beyond_rim(lines, drop, *cutter, task.allowance_mm);
  Finisher finisher(task, drop, *cutter, std::move(lines), area, std::move(out), job);
  if (!task.after) return finisher.run();
  const std::optional<MillEnd> wider = mill_end_of(model::profile_of(*task.after));
  const auto is_ball = [](const MillEnd& end) { return end.ball_mm() == end.radius(); };
  if (!wider || !is_ball(*wider) || !is_ball(*cutter) || !(wider->radius() > cutter->radius()))
    return fail("FRF-CUTTER", "what '" + task.after->id +
                                  "' left is finished by a ball smaller than that ball; '" + task.cutter.id +
                                  "' is none");
  return finisher.run_after(*wider);
}

}  // namespace capstan::toolpath::freeform
