#include <algorithm>
#include <cmath>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "planner/ground/base/number.h"
#include "planner/making/toolpath/freeform/freeform.h"
#include "planner/making/toolpath/freeform/hatch.h"
#include "planner/making/toolpath/freeform/rough/level_contour.h"
#include "planner/making/toolpath/freeform/rough/levels.h"
#include "planner/making/toolpath/freeform/rough/material.h"
#include "planner/making/toolpath/freeform/rough/reach.h"
#include "planner/making/toolpath/freeform/rough/ways_in.h"
#include "planner/making/toolpath/freeform/surface_line.h"
#include "planner/making/toolpath/freeform/task.h"
#include "planner/making/toolpath/path_job.h"
#include "planner/physics/stock/sweep.h"

namespace capstan::toolpath::freeform {
namespace {

using geometry::Vec2;
using geometry::Vec3;
using model::MoveRole;

/// Passes that end at a wall which is cut along on every level end so far from it: they do not touch all of
/// its height. Default, unsourced.
constexpr double kOffWallMm = 0.02;

/// Passes that the cutter can reach but not enter.
struct LeftOut {
  int passes = 0;
  double mm = 0.0;
};

class Rougher {
 public:
  Rougher(const FreeformJob& task, const DropCutter& drop, const MillEnd& cutter, Hatch hatch,
          geometry::Region kept_out, Job& job)
      : task_(task),
        hatch_(std::move(hatch)),
        job_(job),
        radius_(cutter.radius()),
        rest_(task.stock ? *task.stock : block_under(task, hatch_), task.cutter, task.may_stay),
        reach_{.task = task, .drop = drop, .cutter = cutter, .kept_out = std::move(kept_out)},
        ways_(task_, hatch_, reach_, grid_, rest_, out_.path) {
    reach_.margin_mm = std::max(task.tolerance_mm, 0.1 * task.allowance_mm);
    reach_.spacing_mm = std::min(probe_spacing(cutter.ball_mm() + task.allowance_mm, reach_.margin_mm),
                                 kProbedShare * cutter.radius());
    reach_.floor_mm = std::max(task.bottom_z_mm, rest_.map.origin.z);
    // Walls keep to one line from level to level: the next takes no sliver off what the last one left.
    if (!task.floors_z_mm.empty()) reach_.border_mm = 1e-5;
    reach_.beside = task.beside_is_free || ends_with(rest_.map, drop.bounds());
  }

  Rougher(const Rougher&) = delete;  // its parts refer to each other
  Rougher& operator=(const Rougher&) = delete;

  Result<FreeformPath> run(const geometry::Region& area) {
    probes_ = reach_.along(hatch_, job_);
    grid_ = reach_.grid(area, job_);
    if (job_.stop_requested()) return stopped();
    double lowest = kBlocked;
    for (const Probes& p : probes_) {
      for (const double z : p.z) lowest = std::min(lowest, z);
    }
    if (task_.terrace_mm > 0.0) {
      for (const double z : grid_.z) lowest = std::isnan(z) ? lowest : std::min(lowest, z);
    }
    if (lowest >= task_.top_z_mm) return fail(kNothingToCut, "nothing above the surface is left to rough");
    const auto [levels, floors] = levels_of(
        task_, grid_, lowest, reach_.margin_mm,
        task_.left_mm && !(task_.terrace_mm > 0.0)
            ? feet_of_walls(grid_, reach_.drop, reach_.cutter, task_.allowance_mm, lowest, task_.top_z_mm)
            : std::vector<double>{});
    floors_ = floors;
    left_out_.resize(levels.size());
    std::vector<bool> cut(levels.size());
    double above = 1e300, lowest_of_group = 1e300;
    std::size_t group = 0;  // its first level, the lowest
    for (std::size_t k = 0; k < levels.size(); ++k) {
      job_.progress("freeform rough", static_cast<double>(k) / static_cast<double>(levels.size()));
      if (job_.stop_requested()) return stopped();
      const bool raised = k > 0 && levels[k] > levels[k - 1];
      if (!raised) {
        above = std::exchange(lowest_of_group, levels[k]);
        group = k;
      }
      // From below, in strips, only over a level that was cut; else it is cut whole, from above.
      cut[k] = level(k, levels[k], above, raised && cut[k - 1]);
      // What could not be entered out of the solid may be from a level that is cleared above it.
      double cleared = levels[k];
      for (std::size_t j = k; cut[k] && j > group && !cut[j - 1]; --j) {
        if (job_.stop_requested()) return stopped();
        cut[j - 1] = again(j - 1, levels[j - 1], cleared);
        if (cut[j - 1]) cleared = levels[j - 1];
      }
    }
    tell_left_out();
    if (out_.path.size() == 0) return fail("FRF-EMPTY", "nothing above the surface can be roughed");
    ways_.lift();
    out_.stepover_mm = hatch_.spacing_mm;
    return std::move(out_);
  }

 private:
  static tl::unexpected<Diagnostic> stopped() {
    return fail("FRF-STOPPED", "the rough path was stopped before it was whole");
  }

  /// Where the cutter may pass at this level, as far as it meets material.
  [[nodiscard]] std::vector<Pass> passes(std::size_t stripe, double z) const {
    const Stripe& s = hatch_.stripes[stripe];
    const Probes& p = probes_[stripe];
    const auto at = [&](std::size_t k) { return s.lo + static_cast<double>(k) * p.step; };
    std::vector<Pass> out;
    for (std::size_t k = 0; k < p.z.size();) {
      if (p.z[k] > z) {
        ++k;
        continue;
      }
      std::size_t end = k;
      while (end + 1 < p.z.size() && p.z[end + 1] <= z) ++end;
      double lo = k > 0 ? border(s, at(k), at(k - 1), z) : at(k);
      double hi = end + 1 < p.z.size() ? border(s, at(end), at(end + 1), z) : at(end);
      if (task_.left_mm) {
        if (k > 0) lo += kOffWallMm;
        if (end + 1 < p.z.size()) hi -= kOffWallMm;
      }
      if (lo <= hi) trim({stripe, lo, hi}, s, z, out);
      k = end + 1;
    }
    return out;
  }

  [[nodiscard]] double border(const Stripe& s, double free, double blocked, double z) const {
    std::uint32_t hint = 0;
    return dot(reach_.border(hatch_.place(free, s.v), hatch_.place(blocked, s.v), z, hint), hatch_.u_axis);
  }

  /// Cuts off, and splits at, long stretches without material; keeps a run-in in air where there is one.
  void trim(const Pass& whole, const Stripe& s, double z, std::vector<Pass>& out) const {
    const double step = 0.25 * radius_;
    const int n = std::max(1, static_cast<int>(std::ceil((whole.hi - whole.lo) / step)));
    const double du = (whole.hi - whole.lo) / n;
    std::optional<Pass> open;
    int idle = 0;
    for (int k = 0; k <= n; ++k) {
      const double u = whole.lo + k * du;
      if (rest_.meets(hatch_.place(u, s.v), z)) {
        if (!open) open = Pass{whole.stripe, std::max(whole.lo, u - du), u};
        open->hi = std::min(whole.hi, u + du);
        idle = 0;
      } else if (open && ++idle * du > 2.0 * radius_) {
        out.push_back(*open);
        open.reset();
      }
    }
    if (open) out.push_back(*open);
  }

  void tell_left_out() {
    LeftOut all;
    for (const LeftOut& l : left_out_) {
      all.passes += l.passes;
      all.mm += l.mm;
    }
    if (all.passes == 0) return;
    const std::string only =
        task_.terrace_mm > 0.0 && task_.cutter.centre_cutting
            ? " through more than " + trimmed(kStraightTerraces * task_.terrace_mm, 2) + " mm of material"
            : "";
    job_.warn("FRF-REST", std::to_string(all.passes) + " passes, " + trimmed(all.mm, 1) +
                              " mm in all, are left out: cutter '" + task_.cutter.id +
                              "' can neither ramp nor plunge into them" + only);
  }

  /// A level of which nothing was cut, from one that is cleared since. What of it is left out is counted
  /// anew.
  bool again(std::size_t number, double z, double cleared) {
    left_out_[number] = {};
    // The cutter was at the ends above, but not as deep as this.
    std::vector<Vec2> above = std::exchange(ways_.ends, {});
    const bool any = level(number, z, cleared, false);
    ways_.ends.insert(ways_.ends.end(), above.begin(), above.end());
    return any;
  }

  /// `above`: a level cleared before it. `raised`: what stands above the level before is cut from below, in
  /// strips. Whether anything was cut.
  bool level(std::size_t number, double z, double above, bool raised) {
    const bool on_floor = std::find(floors_.begin(), floors_.end(), z) != floors_.end();
    const bool walls_first = raised || (task_.left_mm && !on_floor);
    number_ = number;
    ways_.begin_level(above, raised);
    bool any = walls_first && along_borders(z);
    any |= within(z);
    if (!walls_first) any |= along_borders(z);
    if (any) out_.levels_z_mm.push_back(z);
    return any;
  }

  bool along_borders(double z) {
    bool any = false;
    std::uint32_t hint = 0;
    const auto to_border = [&](Vec2 f, Vec2 b) { return reach_.border(f, b, z, hint); };
    auto lines = level_contour(grid_, z, to_border);
    while (!lines.empty()) {
      auto line = lines.begin();
      if (task_.terrace_mm > 0.0 && out_.path.size() > 0) line = nearest(lines, xy(here()));
      if (!task_.floors_z_mm.empty()) {  // walls: what is left out round their corners meets deeper levels
        *line = refined(
            *line, 0.25 * reach_.margin_mm, [&](Vec2 p) { return reach_.is_free(p, z, hint); }, to_border);
      }
      any |= go_along(*line, z);
      lines.erase(line);
    }
    return any;
  }

  bool within(double z) {
    std::vector<Pass> todo;
    for (std::size_t i = 0; i < hatch_.stripes.size(); ++i) {
      for (const Pass& p : passes(i, z)) todo.push_back(p);
    }
    std::vector<bool> done(todo.size());
    bool any = false;
    std::size_t first = 0;
    std::optional<std::size_t> next;
    while (true) {
      while (first < todo.size() && done[first]) ++first;
      if (first == todo.size()) break;
      const std::size_t i = next ? *next : first;
      done[i] = true;
      any |= cut_pass(todo[i], z, next.has_value());
      next = neighbour(todo, done, i, z);
    }
    return any;
  }

  /// Follows a border once, to cut what the passes left along it. Starts from the end of a pass of this
  /// level; skips stretches without material and stretches that it cannot prove safe.
  bool go_along(const std::vector<Vec2>& line, double z) {
    bool any = false;
    bool on = false;
    for (std::size_t i = 1; i < line.size(); ++i) {
      const bool material = task_.floors_z_mm.empty() || task_.may_stay != nullptr
                                ? rest_.meets(line[i - 1], z) || rest_.meets(line[i], z)
                                : stands_beside(line[i - 1], line[i], z);
      // Two points on a border: the chord may cut the border's corner by what the margin allows.
      if (!reach_.is_free(line[i - 1], line[i], z, 0.5) || (!material && !on)) {
        on = false;
        continue;
      }
      if (!on) on = ways_.approach(line[i - 1], z) || (i == 1 && ways_.ramp_along(line, z));
      if (!on) continue;
      ways_.line({line[i].x, line[i].y, z}, MoveRole::kCut);
      any = true;
      on = material || i + 1 < line.size();
    }
    return any;
  }

  /// Whether a way along a wall meets what the wall is to lose. The wall itself touches the cutter: only what
  /// reaches farther under it counts, half of what is left there or a cell and a half.
  [[nodiscard]] bool stands_beside(Vec2 a, Vec2 b, double z) const {
    const double within = std::min(1.5 * rest_.map.cell_mm, 0.5 * task_.left_mm.value_or(task_.allowance_mm));
    return stock::max_height(rest_.map, a, b, radius_ - within) > z + kNothing;
  }

  /// A pass on the next line that can be reached from here without lifting.
  std::optional<std::size_t> neighbour(const std::vector<Pass>& todo, const std::vector<bool>& done,
                                       std::size_t i, double z) {
    // Free at this level only: no way from one that was cut before, when no pass of this was entered yet.
    if (!ways_.is_down() || std::abs(here().z - z) > kNothing) return std::nullopt;
    const int line = hatch_.stripes[todo[i].stripe].line + 1;
    for (std::size_t k = i + 1; k < todo.size(); ++k) {
      const Stripe& s = hatch_.stripes[todo[k].stripe];
      if (s.line > line) break;
      if (s.line < line || done[k]) continue;
      // Where a border stands in the way to its end, a little farther on and back.
      const double end = near_end(todo[k]), far = end == todo[k].lo ? todo[k].hi : todo[k].lo;
      const double most = task_.terrace_mm > 0.0 ? std::min(1.5 * radius_, std::abs(far - end)) : 0.0;
      for (double on = 0.0; on <= most; on += kProbedShare * radius_) {
        const double u = end + (far > end ? on : -on);
        const Vec2 to = hatch_.place(u, s.v);
        if (norm(to - xy(here())) > 2.0 * radius_ + hatch_.spacing_mm) break;
        if (grid_.blocks(xy(here()), to, z) || !reach_.is_free(xy(here()), to, z)) continue;
        enter_at_ = u;
        return k;
      }
    }
    return std::nullopt;
  }

  [[nodiscard]] Vec3 here() const { return ways_.here(); }
  [[nodiscard]] double near_end(const Pass& p) const {
    const double u = dot(xy(here()), hatch_.u_axis);
    return std::abs(u - p.lo) <= std::abs(u - p.hi) ? p.lo : p.hi;
  }

  bool cut_pass(const Pass& pass, double z, bool linked) {
    const double v = hatch_.stripes[pass.stripe].v;
    double from = pass.lo;
    double to = pass.hi;
    if (linked ? std::abs(enter_at_ - pass.hi) < std::abs(enter_at_ - pass.lo)
               : out_.path.size() > 0 && near_end(pass) == pass.hi)
      std::swap(from, to);
    if (linked) {
      ways_.line(ways_.at(enter_at_, v, z), MoveRole::kCut);
      ways_.line(ways_.at(from, v, z), MoveRole::kCut);
    } else {
      if (ways_.is_open(to, from, v, z) && !ways_.is_open(from, to, v, z)) std::swap(from, to);
      if (!ways_.enter(from, to, v, z)) {
        ++left_out_[number_].passes;
        left_out_[number_].mm += std::abs(to - from);
        return false;
      }
    }
    ways_.line(ways_.at(to, v, z), MoveRole::kCut);
    for (const double u : {from, to}) ways_.ends.push_back(hatch_.place(u, v));
    ways_.stay_down();
    return true;
  }

  const FreeformJob& task_;
  Hatch hatch_;
  Job& job_;
  double radius_ = 0.0;
  Material rest_;
  Reach reach_;
  std::vector<double> floors_;  ///< levels that end on a floor
  std::vector<Probes> probes_;
  DropGrid grid_;
  double enter_at_ = 0.0;          ///< where the next pass is begun, along its line
  std::vector<LeftOut> left_out_;  ///< of each level
  std::size_t number_ = 0;         ///< of this level
  FreeformPath out_;
  WaysIn ways_;
};

bool same_cells(const stock::HeightMap& a, const stock::HeightMap& b) {
  return a.origin == b.origin && a.cell_mm == b.cell_mm && a.nx == b.nx && a.ny == b.ny;
}

}  // namespace

Result<FreeformPath> rough(const FreeformJob& task, Job& job) {
  const auto cutter = checked_cutter(task);
  if (!cutter) return tl::unexpected(cutter.error());
  if (!(task.axial_depth_mm > 0.0)) return fail("FRF-VALUE", "roughing needs an axial depth above 0");
  if (!(task.stepover_mm > 0.0) || task.stepover_mm > 2.0 * cutter->radius()) {
    return fail("FRF-VALUE", "roughing needs a stepover above 0 and up to the cutter's diameter, not " +
                                 trimmed(task.stepover_mm, 4) + " mm");
  }
  if (task.may_stay != nullptr && (task.stock == nullptr || !same_cells(*task.may_stay, *task.stock)))
    return fail("FRF-VALUE", "what may stay is told by the cells of another stock, or of none");
  const DropCutter drop(*task.surface);
  geometry::Region area = area_of(task, drop);
  if (task.may_stay != nullptr) {
    area = geometry::intersect(area, around_rests(*task.stock, *task.may_stay, cutter->radius()));
    if (area.empty()) return fail(kNothingToCut, "nothing stands higher than may stay for the next step");
  }
  geometry::Region out = kept_out(task, *cutter);
  Hatch lines =
      hatch(out.empty() ? area : geometry::subtract(area, out), task.feed_angle_rad, task.stepover_mm);
  if (lines.stripes.empty()) return fail("FRF-EMPTY", "the area to rough is empty");
  return Rougher(task, drop, *cutter, std::move(lines), std::move(out), job).run(area);
}

}  // namespace capstan::toolpath::freeform
