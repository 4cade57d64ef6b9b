#include <algorithm>
#include <cmath>
#include <string>

#include "planner/ground/base/number.h"
#include "planner/making/toolpath/freeform/between.h"
#include "planner/making/toolpath/freeform/freeform.h"
#include "planner/making/toolpath/freeform/hatch.h"
#include "planner/making/toolpath/freeform/rim.h"
#include "planner/making/toolpath/freeform/surface_line.h"
#include "planner/making/toolpath/freeform/task.h"

namespace capstan::toolpath::freeform {
namespace {

using geometry::Vec2;
using geometry::Vec3;
using model::MoveRole;

double way(const Run& run) {
  double sum = 0.0;
  for (std::size_t i = 1; i < run.size(); ++i) sum += norm(run[i] - run[i - 1]);
  return sum;
}

/// How much of what a semi-finish leaves its ridges may take beside their own height. Default, unsourced.
constexpr double kShareOfLeft = 0.2;
/// Passes lie between two others at most 2^5 times as close: as ridges on a slope of 88 degrees need.
constexpr int kMostHalvings = 5;

/// A piece of a pass between two others.
struct Between {
  double v = 0.0;
  Run run;  ///< towards greater u
};

class Finisher {
 public:
  Finisher(const FreeformJob& task, const DropCutter& drop, const MillEnd& cutter, Hatch hatch, Job& job)
      : task_(task), hatch_(std::move(hatch)), job_(job) {
    follow_ = {.drop = &drop,
               .cutter = cutter,
               .allowance_mm = task.allowance_mm,
               .tolerance_mm = task.tolerance_mm,
               .bottom_z_mm = task.bottom_z_mm,
               .beside_is_free = task.beside_is_free};
  }

  Result<FreeformPath> run() {
    std::vector<std::vector<Run>> found(hatch_.stripes.size());
    parallel_for(job_, found.size(), [&](std::size_t i) {
      if (job_.stop_requested()) return;
      const Stripe& s = hatch_.stripes[i];
      found[i] = follow_.over(hatch_.place(s.lo, s.v), hatch_.place(s.hi, s.v));
    });
    if (job_.stop_requested()) return stopped();
    const std::vector<Between> between = between_passes(found);
    if (job_.stop_requested()) return stopped();
    for (std::size_t i = 0; i < found.size(); ++i) {
      job_.progress("freeform finish", static_cast<double>(i) / static_cast<double>(found.size()));
      const bool back = task_.to_and_fro && hatch_.stripes[i].line % 2 != 0;
      if (back) std::reverse(found[i].begin(), found[i].end());
      for (Run& r : found[i]) {
        if (back) std::reverse(r.begin(), r.end());
        add(r);
      }
    }
    add_nearest_first(between);
    if (out_.path.size() == 0) return fail("FRF-EMPTY", "the area holds no surface to finish");
    out_.path.line(up(out_.path.point(out_.path.size() - 1)), MoveRole::kRetract);
    out_.stepover_mm = hatch_.spacing_mm;
    return std::move(out_);
  }

 private:
  static tl::unexpected<Diagnostic> stopped() {
    return fail("FRF-STOPPED", "the finish path was stopped before it was whole");
  }

  /// How far apart passes may lie along the surface: half of the tolerance lifts them (Follower), the other
  /// half the ridges may have.
  [[nodiscard]] double most_apart() const {
    const double ridge = task_.scallop_mm + 0.5 * task_.tolerance_mm + kShareOfLeft * task_.allowance_mm;
    return std::max(hatch_.spacing_mm, scallop_stepover(follow_.cutter.ball_mm(), ridge));
  }

  /// Passes between those of the hatch where these lie too far apart along the surface, by v.
  std::vector<Between> between_passes(const std::vector<std::vector<Run>>& found) {
    if (!(task_.scallop_mm > 0.0) || task_.stepover_mm > 0.0) return {};
    std::vector<std::pair<double, std::vector<Run>>> lines;
    for (std::size_t i = 0; i < found.size(); ++i) {
      const Stripe& s = hatch_.stripes[i];
      if (i == 0 || s.line != hatch_.stripes[i - 1].line) lines.emplace_back(s.v, std::vector<Run>{});
      auto& runs = lines.back().second;
      runs.insert(runs.end(), found[i].begin(), found[i].end());
    }
    if (lines.size() < 2) return {};
    std::vector<std::vector<Between>> gaps(lines.size() - 1);
    std::vector<double> steep(gaps.size());
    parallel_for(job_, gaps.size(), [&](std::size_t i) {
      if (job_.stop_requested()) return;
      fill(lines[i], lines[i + 1], kMostHalvings, gaps[i], steep[i]);
    });
    std::vector<Between> out;
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

  using Line = std::pair<double, std::vector<Run>>;  ///< v, and the runs along it

  void fill(const Line& below, const Line& above, int halvings, std::vector<Between>& out,
            double& steep) const {
    const auto wide = wide_gaps(below.second, above.second, hatch_, most_apart());
    if (wide.empty()) return;
    if (halvings == 0) {
      for (const auto& [lo, hi] : wide) steep += hi - lo;
      return;
    }
    Line middle{0.5 * (below.first + above.first), {}};
    for (const auto& [lo, hi] : wide) {
      for (Run& run : follow_.over(hatch_.place(lo, middle.first), hatch_.place(hi, middle.first)))
        middle.second.push_back(std::move(run));
    }
    fill(below, middle, halvings - 1, out, steep);
    for (const Run& run : middle.second) out.push_back({middle.first, run});
    fill(middle, above, halvings - 1, out, steep);
  }

  /// Each piece of a pass after the one from which it is reached along the surface; where none is, the first.
  void add_nearest_first(const std::vector<Between>& pieces) {
    std::vector<bool> done(pieces.size());
    std::size_t first = 0;
    while (first < pieces.size()) {
      if (done[first]) {
        ++first;
        continue;
      }
      std::size_t next = first;
      bool back = false;
      double least = 1.5 * hatch_.spacing_mm;
      const Vec2 here = out_.path.size() > 0 ? xy(out_.path.point(out_.path.size() - 1)) : Vec2{1e300, 1e300};
      for (std::size_t i = first; i < pieces.size(); ++i) {
        // In order of v: farther on none is nearer.
        if (pieces[i].v > dot(here, hatch_.v_axis) + least && i > first) break;
        if (done[i]) continue;
        for (const bool end : {false, true}) {
          if (end && !task_.to_and_fro) continue;
          const double d = norm(xy(end ? pieces[i].run.back() : pieces[i].run.front()) - here);
          if (d >= least) continue;
          least = d;
          next = i;
          back = end;
        }
      }
      done[next] = true;
      Run run = pieces[next].run;
      if (back) std::reverse(run.begin(), run.end());
      add(run);
    }
  }

  [[nodiscard]] Vec3 up(Vec3 p) const { return {p.x, p.y, task_.security_z_mm}; }

  void add(const Run& run) {
    auto& path = out_.path;
    if (path.size() == 0) {
      path.start(up(run.front()));
      enter(run.front());
    } else if (!slide_to(run.front())) {
      path.line(up(path.point(path.size() - 1)), MoveRole::kRetract);
      path.rapid(up(run.front()));
      enter(run.front());
    }
    for (std::size_t i = 1; i < run.size(); ++i) path.line(run[i], MoveRole::kCut);
  }

  void enter(Vec3 p) {
    const double radius = follow_.cutter.radius();
    const double top = task_.stock ? stock::max_height(*task_.stock, xy(p), radius) : task_.top_z_mm;
    const double z = std::min(task_.security_z_mm, std::max(p.z, top) + task_.clearance_mm);
    if (z < task_.security_z_mm) out_.path.rapid({p.x, p.y, z}, MoveRole::kApproach);
    out_.path.line(p, MoveRole::kPlunge);
  }

  /// Along the surface to a neighbouring pass; false where that is no short way.
  bool slide_to(Vec3 to) {
    const Vec3 from = out_.path.point(out_.path.size() - 1);
    const double reach = norm(xy(to) - xy(from));
    if (!task_.to_and_fro || reach > 1.5 * hatch_.spacing_mm) return false;
    const auto pieces = follow_.over(xy(from), xy(to));
    if (pieces.size() != 1) return false;
    const Run& piece = pieces.front();
    if (xy(piece.front()) != xy(from) || norm(xy(piece.back()) - xy(to)) > 1e-9) return false;
    if (way(piece) > 3.0 * reach) return false;
    for (std::size_t i = 1; i < piece.size(); ++i) out_.path.line(piece[i], MoveRole::kCut);
    out_.path.line(to, MoveRole::kCut);
    return true;
  }

  const FreeformJob& task_;
  Hatch hatch_;
  Job& job_;
  Follower follow_;
  FreeformPath out_;
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
  Hatch lines =
      hatch(geometry::subtract(area_of(task, drop), kept_out(task, *cutter)), task.feed_angle_rad, stepover);
  // What is kept out of may lie beyond the rim.
  if (task.area.empty() && task.avoid.empty()) lines = beyond_rim(lines, drop, *cutter, task.allowance_mm);
  return Finisher(task, drop, *cutter, std::move(lines), job).run();
}

}  // namespace capstan::toolpath::freeform
