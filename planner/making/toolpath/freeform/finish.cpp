#include <algorithm>
#include <cmath>
#include <string>

#include "planner/ground/base/number.h"
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

using Run = std::vector<Vec3>;

double way(const Run& run) {
  double sum = 0.0;
  for (std::size_t i = 1; i < run.size(); ++i) sum += norm(run[i] - run[i - 1]);
  return sum;
}

/// Says where ridges come out higher than asked, because the surface slopes across the passes.
void warn_of_ridges(const FreeformJob& task, double ball_mm, const Hatch& lines, Job& job) {
  double all = 0.0;
  double beyond = 0.0;
  double worst = 0.0;
  for (const auto& t : task.surface->triangles) {
    const Vec3 a = task.surface->vertices[t[0]];
    const Vec3 n = cross(task.surface->vertices[t[1]] - a, task.surface->vertices[t[2]] - a);
    const double size = norm(n);
    if (!(size > 0.0)) continue;
    all += size;
    // Steeper than 60 degrees a cutter from above does not finish by its ridges.
    if (std::abs(n.z) < 0.5 * size) continue;
    const double across = dot(xy(n), lines.v_axis) / n.z;
    const double half = 0.5 * lines.spacing_mm * std::sqrt(1.0 + across * across);
    const double ridge = half < ball_mm ? ball_mm - std::sqrt((ball_mm - half) * (ball_mm + half)) : ball_mm;
    if (ridge <= 1.05 * task.scallop_mm) continue;
    beyond += size;
    worst = std::max(worst, ridge);
  }
  if (beyond < 1e-3 * all) return;
  job.warn("FRF-SCALLOP", "on " + trimmed(100.0 * beyond / all, 1) +
                              " % of the surface the ridges are higher than " + trimmed(task.scallop_mm, 4) +
                              " mm, up to " + trimmed(worst, 4) + " mm, because it slopes across the passes");
}

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
    if (job_.stop_requested()) return fail("FRF-STOPPED", "the finish path was stopped before it was whole");
    for (std::size_t i = 0; i < found.size(); ++i) {
      job_.progress("freeform finish", static_cast<double>(i) / static_cast<double>(found.size()));
      const bool back = task_.to_and_fro && hatch_.stripes[i].line % 2 != 0;
      if (back) std::reverse(found[i].begin(), found[i].end());
      for (Run& r : found[i]) {
        if (back) std::reverse(r.begin(), r.end());
        add(r);
      }
    }
    if (out_.path.size() == 0) return fail("FRF-EMPTY", "the area holds no surface to finish");
    out_.path.line(up(out_.path.point(out_.path.size() - 1)), MoveRole::kRetract);
    out_.stepover_mm = hatch_.spacing_mm;
    return std::move(out_);
  }

 private:
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
  if (task.scallop_mm > 0.0) warn_of_ridges(task, cutter->ball_mm(), lines, job);
  return Finisher(task, drop, *cutter, std::move(lines), job).run();
}

}  // namespace capstan::toolpath::freeform
