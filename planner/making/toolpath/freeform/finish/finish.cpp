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
/// What a ball that finishes what a wider one left takes at once, square to the surface, mm: as much as a
/// last ball meets after a semi-finish. Default, unsourced.
constexpr double kLayerMm = 0.4;
constexpr int kMostLayers = 40;

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
        job_(job) {}

  Result<FreeformPath> run() {
    const std::vector<std::vector<Run>> found = passes(task_, nullptr);
    if (job_.stop_requested()) return stopped();
    const std::vector<Piece> between = between_passes(task_, found);
    if (job_.stop_requested()) return stopped();
    PassWriter all(task_, drop_, cutter_, hatch_.spacing_mm);
    for (std::size_t i = 0; i < found.size(); ++i) {
      job_.progress("freeform finish", static_cast<double>(i) / static_cast<double>(found.size()));
      const bool back = task_.to_and_fro && hatch_.stripes[i].line % 2 != 0;
      std::vector<Run> runs = found[i];
      if (back) std::reverse(runs.begin(), runs.end());
      for (Run& r : runs) {
        if (back) std::reverse(r.begin(), r.end());
        all.add(r);
      }
    }
    if (all.empty()) return fail("FRF-EMPTY", "the area holds no surface to finish");
    if (between.empty()) return written(all);
    all.link_within(0.0);
    all.add_nearest_first(between, hatch_.v_axis);
    PassWriter split(task_, drop_, cutter_, hatch_.spacing_mm);
    split.link_within(cutter_.radius());
    const Reach reach = reach_of(task_);
    const DropGrid grid = reach.grid(area_, job_);
    const Mask steep = steep_of(grid, drop_, cutter_, task_.allowance_mm, kSteepRad);
    add_area(task_, reach, grid, steep, nullptr, found, between, split);
    if (job_.stop_requested()) return stopped();
    return written(!split.empty() && split.way_mm() < all.way_mm() ? split : all);
  }

  /// What a wider ball left.
  Result<FreeformPath> run_after(const MillEnd& wider) {
    const DropGrid places = reach_of(task_).grid(area_, job_);
    const std::vector<double> left = left_by_wider(places, drop_, cutter_, wider, job_);
    if (job_.stop_requested()) return stopped();
    const double limit = task_.scallop_mm + task_.tolerance_mm;
    const double most = *std::max_element(left.begin(), left.end());
    const int layers = std::clamp(static_cast<int>(std::ceil((most - limit) / kLayerMm)), 1, kMostLayers);
    PassWriter out(task_, drop_, cutter_, hatch_.spacing_mm);
    out.link_within(cutter_.radius());
    for (int k = layers - 1; k >= 0; --k) {
      job_.progress("freeform finish", 1.0 - static_cast<double>(k + 1) / layers);
      FreeformJob layer = task_;
      layer.allowance_mm = task_.allowance_mm + k * kLayerMm;
      if (k > 0) {  // not the last: as coarse as the next bears
        layer.scallop_mm = std::max(task_.scallop_mm, 0.25 * kLayerMm);
        layer.tolerance_mm = std::max(task_.tolerance_mm, 0.1 * kLayerMm);
      }
      const Mask rest = grown(more_than(places, left, k * kLayerMm + limit), 1);
      if (!rest.any()) continue;
      const Reach reach = reach_of(layer);
      const DropGrid grid = about(reach, places, grown(rest, 2));
      const Mask steep = steep_of(grid, drop_, cutter_, layer.allowance_mm, kSteepRad);
      const auto found = passes(layer, &rest);
      out.keep(layer);
      add_area(layer, reach, grid, steep, &rest, found, between_passes(layer, found), out);
      if (job_.stop_requested()) return stopped();
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

  [[nodiscard]] Follower follower(const FreeformJob& task) const {
    return {.drop = &drop_,
            .cutter = cutter_,
            .allowance_mm = task.allowance_mm,
            .tolerance_mm = task.tolerance_mm,
            .bottom_z_mm = task.bottom_z_mm,
            .beside_is_free = task.beside_is_free};
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

  /// How far apart passes may lie along the surface: half of the tolerance lifts them, the other half the
  /// ridges may have.
  [[nodiscard]] double most_apart(const FreeformJob& task) const {
    const double ridge = task.scallop_mm + 0.5 * task.tolerance_mm + kShareOfLeft * task_.allowance_mm;
    return std::max(hatch_.spacing_mm, scallop_stepover(cutter_.ball_mm(), ridge));
  }

  /// The passes of the hatch, by stripe; `only`: pieces of them.
  [[nodiscard]] std::vector<std::vector<Run>> passes(const FreeformJob& task, const Mask* only) const {
    std::vector<std::vector<Run>> found(hatch_.stripes.size());
    const Follower follow = follower(task);
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
  void add_area(const FreeformJob& task, const Reach& reach, const DropGrid& grid, const Mask& steep,
                const Mask* area, const std::vector<std::vector<Run>>& found,
                const std::vector<Piece>& between, PassWriter& out) const {
    const Mask walls = area != nullptr ? both(grown(steep, 1), *area) : grown(steep, 1);
    out.add_levels(waterlines(reach, grid, walls, most_apart(task), job_));
    const Mask shallow = grown(inverse(steep), 1);
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
  }

  using Line = std::pair<double, std::vector<Run>>;  ///< v, and the runs along it

  /// Passes between those of the hatch where these lie too far apart along the surface, by v.
  std::vector<Piece> between_passes(const FreeformJob& task,
                                    const std::vector<std::vector<Run>>& found) const {
    if (!(task.scallop_mm > 0.0) || task.stepover_mm > 0.0) return {};
    std::vector<Line> lines;
    for (std::size_t i = 0; i < found.size(); ++i) {
      const Stripe& s = hatch_.stripes[i];
      if (i == 0 || s.line != hatch_.stripes[i - 1].line) lines.emplace_back(s.v, std::vector<Run>{});
      auto& runs = lines.back().second;
      runs.insert(runs.end(), found[i].begin(), found[i].end());
    }
    if (lines.size() < 2) return {};
    std::vector<std::vector<Piece>> gaps(lines.size() - 1);
    std::vector<double> steep(gaps.size());
    const Follower follow = follower(task);
    const double apart = most_apart(task);
    parallel_for(job_, gaps.size(), [&](std::size_t i) {
      if (job_.stop_requested()) return;
      fill(follow, apart, lines[i], lines[i + 1], kMostHalvings, gaps[i], steep[i]);
    });
    std::vector<Piece> out;
    double left = 0.0;
    for (std::size_t i = 0; i < gaps.size(); ++i) {
      std::move(gaps[i].begin(), gaps[i].end(), std::back_inserter(out));
      left += steep[i];
    }
    if (left > 0.0)
      job_.note("FRF-SCALLOP",
                "along " + trimmed(left, 1) +
                    " mm the surface is so steep across the passes that ridges are not counted");
    return out;
  }

  void fill(const Follower& follow, double apart, const Line& below, const Line& above, int halvings,
            std::vector<Piece>& out, double& steep) const {
    auto wide = wide_gaps(below.second, above.second, hatch_, apart);
    // An upright step is no slope: however close passes lie, one is above it and the next below.
    if (halvings == kMostHalvings)
      std::erase_if(wide, [&](const std::pair<double, double>& gap) {
        const double u = 0.5 * (gap.first + gap.second);
        return has_upright_step(drop_, cutter_, follow.allowance_mm, hatch_.place(u, below.first),
                                hatch_.place(u, above.first));
      });
    if (task_.after) add_hollows(follow, below, above, wide);
    if (wide.empty()) return;
    if (halvings == 0) {
      for (const auto& [lo, hi] : wide) steep += hi - lo;
      return;
    }
    Line middle{0.5 * (below.first + above.first), {}};
    for (const auto& [lo, hi] : wide) {
      for (Run& run : follow.over(hatch_.place(lo, middle.first), hatch_.place(hi, middle.first)))
        middle.second.push_back(std::move(run));
    }
    fill(follow, apart, below, middle, halvings - 1, out, steep);
    for (const Run& run : middle.second) out.push_back({middle.first, run});
    fill(follow, apart, middle, above, halvings - 1, out, steep);
  }

  /// What a wider ball left is hollow: places where a ball between two passes would go deeper than the line
  /// from one to the other. The ridge is higher by that depth than that of a plane.
  void add_hollows(const Follower& follow, const Line& below, const Line& above,
                   std::vector<std::pair<double, double>>& wide) const {
    const double most = task_.scallop_mm + 1.5 * task_.tolerance_mm + kShareOfLeft * task_.allowance_mm;
    const double step = 0.5 * cutter_.radius(), v = 0.5 * (below.first + above.first);
    const double dv = above.first - below.first;
    const auto ends = [&](const Run& run) {
      return std::pair(dot(xy(run.front()), hatch_.u_axis), dot(xy(run.back()), hatch_.u_axis));
    };
    std::uint32_t hint = 0;
    const auto z = [&](double u, double at_v) {
      const Vec2 p = hatch_.place(u, at_v);
      return drop_.drop(cutter_, p.x, p.y, follow.allowance_mm, hint);
    };
    const std::size_t before = wide.size();
    for (const Run& one : below.second) {
      for (const Run& other : above.second) {
        const double lo = std::max(ends(one).first, ends(other).first);
        const double hi = std::min(ends(one).second, ends(other).second);
        for (double u = lo + 0.5 * step; u < hi; u += step) {
          const double a = z(u, below.first), m = z(u, v), b = z(u, above.first);
          if (a == DropCutter::kNoContact || m == DropCutter::kNoContact || b == DropCutter::kNoContact)
            continue;
          const double apart = std::hypot(dv, b - a), depth = (0.5 * (a + b) - m) * dv / apart;
          if (depth <= 0.0 || ridge_mm(cutter_.ball_mm(), apart) + depth <= most) continue;
          wide.emplace_back(std::max(lo, u - step), std::min(hi, u + step));
        }
      }
    }
    if (wide.size() == before) return;
    std::sort(wide.begin(), wide.end());
    std::vector<std::pair<double, double>> joined;
    for (const auto& gap : wide) {
      if (!joined.empty() && gap.first <= joined.back().second)
        joined.back().second = std::max(joined.back().second, gap.second);
      else
        joined.push_back(gap);
    }
    wide = std::move(joined);
  }

  const FreeformJob& task_;
  const DropCutter& drop_;
  const MillEnd& cutter_;
  Hatch hatch_;
  geometry::Region area_, kept_out_;
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
