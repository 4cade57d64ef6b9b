#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <string>

#include "planner/ground/base/number.h"
#include "planner/making/toolpath/defaults.h"
#include "planner/making/toolpath/freeform/freeform.h"
#include "planner/making/toolpath/freeform/hatch.h"
#include "planner/making/toolpath/freeform/rough/level_contour.h"
#include "planner/making/toolpath/freeform/rough/levels.h"
#include "planner/making/toolpath/freeform/rough/material.h"
#include "planner/making/toolpath/freeform/rough/reach.h"
#include "planner/making/toolpath/freeform/surface_line.h"
#include "planner/making/toolpath/freeform/task.h"
#include "planner/physics/stock/sweep.h"

namespace capstan::toolpath::freeform {
namespace {

using geometry::Vec2;
using geometry::Vec3;
using model::MoveRole;

/// More turns of a ramp than this and a place counts as not to be entered; default, unsourced.
constexpr int kMostRampTurns = 100;

class Rougher {
 public:
  Rougher(const FreeformJob& task, const DropCutter& drop, const MillEnd& cutter, Hatch hatch,
          geometry::Region kept_out, Job& job)
      : task_(task),
        hatch_(std::move(hatch)),
        job_(job),
        radius_(cutter.radius()),
        rest_(task.stock ? *task.stock : block_under(task, hatch_), task.cutter),
        reach_{.task = task, .drop = drop, .cutter = cutter, .kept_out = std::move(kept_out)} {
    reach_.margin_mm = std::max(task.tolerance_mm, 0.1 * task.allowance_mm);
    reach_.spacing_mm = std::min(probe_spacing(cutter.ball_mm() + task.allowance_mm, reach_.margin_mm),
                                 kProbedShare * cutter.radius());
    reach_.floor_mm = std::max(task.bottom_z_mm, rest_.map.origin.z);
    reach_.beside = task.beside_is_free || ends_with(rest_.map, drop.bounds());
  }

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
    if (lowest >= task_.top_z_mm) return fail("FRF-EMPTY", "nothing above the surface is left to rough");
    const auto [levels, floors] = levels_of(task_, grid_, lowest, reach_.margin_mm);
    floors_ = floors;
    bool before = true;  // something was cut on the level before
    for (std::size_t k = 0; k < levels.size(); ++k) {
      job_.progress("freeform rough", static_cast<double>(k) / static_cast<double>(levels.size()));
      if (job_.stop_requested()) return stopped();
      const bool any = level(levels[k], k > 0 && levels[k] > levels[k - 1]);
      if (any && k > 0 && !before)
        level(levels[k - 1], false);  // the bottom of a pit, too small to go down into
      before = any;
    }
    if (skipped_ > 0) {
      job_.warn("FRF-REST", std::to_string(skipped_) + " passes, " + trimmed(skipped_mm_, 1) +
                                " mm in all, are left out: cutter '" + task_.cutter.id +
                                "' can neither ramp nor plunge into them");
    }
    if (out_.path.size() == 0) return fail("FRF-EMPTY", "nothing above the surface can be roughed");
    lift();
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
      const double lo = k > 0 ? border(s, at(k), at(k - 1), z) : at(k);
      const double hi = end + 1 < p.z.size() ? border(s, at(end), at(end + 1), z) : at(end);
      trim({stripe, lo, hi}, s, z, out);
      k = end + 1;
    }
    return out;
  }

  [[nodiscard]] double border(const Stripe& s, double free, double blocked, double z) const {
    return dot(reach_.border(hatch_.place(free, s.v), hatch_.place(blocked, s.v), z), hatch_.u_axis);
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

  /// `raised`: what stands above the level before is cut from below, in strips.
  bool level(double z, bool raised) {
    const bool on_floor = std::find(floors_.begin(), floors_.end(), z) != floors_.end();
    const bool walls_first = raised || (task_.left_mm && !on_floor);
    raised_ = raised;
    if (!raised) {
      ends_.clear();
      above_ = first_ ? 1e300 : base_;
      base_ = z;
      first_ = false;
    }
    bool any = walls_first && along_borders(z);
    any |= within(z);
    if (!walls_first) any |= along_borders(z);
    if (any) out_.levels_z_mm.push_back(z);
    return any;
  }

  bool along_borders(double z) {
    bool any = false;
    const auto to_border = [&](Vec2 f, Vec2 b) { return reach_.border(f, b, z); };
    auto lines = level_contour(grid_, z, to_border);
    while (!lines.empty()) {
      auto line = lines.begin();
      if (task_.terrace_mm > 0.0 && out_.path.size() > 0) line = nearest(lines, xy(here()));
      if (!task_.floors_z_mm.empty()) {  // walls: what is left out round their corners meets deeper levels
        std::uint32_t hint = 0;
        *line = refined(
            *line, 0.25 * reach_.margin_mm, [&](Vec2 p) { return reach_.at(p, hint) <= z; }, to_border);
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
      const bool material = task_.floors_z_mm.empty()
                                ? rest_.meets(line[i - 1], z) || rest_.meets(line[i], z)
                                : stock::max_height(rest_.map, line[i - 1], line[i], radius_) > z + kNothing;
      // Two points on a border: the chord may cut the border's corner by what the margin allows.
      if (!reach_.is_free(line[i - 1], line[i], z, 0.5) || (!material && !on)) {
        on = false;
        continue;
      }
      if (!on) on = approach(line[i - 1], z) || (i == 1 && ramp_along(line, z));
      if (!on) continue;
      this->line({line[i].x, line[i].y, z}, MoveRole::kCut);
      any = true;
      on = material || i + 1 < line.size();
    }
    return any;
  }

  /// To a point on a border: from here, or from the nearest pass's end with a free way to it.
  bool approach(Vec2 p, double z) {
    if (down_ && here().z <= z && norm(xy(here()) - p) <= 2.0 * radius_ &&
        reach_.is_free(xy(here()), p, z, 0.5)) {
      line({here().x, here().y, z}, MoveRole::kRetract);
      line({p.x, p.y, z}, MoveRole::kCut);
      return true;
    }
    std::optional<Vec2> from;
    for (const Vec2 e : ends_) {
      if (norm(e - p) > 2.0 * radius_ || (from && norm(e - p) >= norm(*from - p))) continue;
      if (reach_.is_free(e, p, z, 0.5)) from = e;  // the cutter was there at this level
    }
    if (!from && (task_.left_mm || raised_)) from = air_near(p, z);
    if (!from) return false;
    come_down({from->x, from->y, z}, stock::max_height(rest_.map, *from, radius_), task_.terrace_mm > 0.0);
    down_ = true;
    line({p.x, p.y, z}, MoveRole::kCut);
    return true;
  }

  /// Down into the solid along a closed border, within the ramp angle; false where it is too short for that.
  bool ramp_along(const std::vector<Vec2>& line, double z) {
    const double angle = ramp_angle();
    if (!(task_.terrace_mm > 0.0) || line.front() != line.back() || !(angle > 0.0)) return false;
    double length = 0.0, material = z;
    bool clear = true;
    for (std::size_t i = 1; i < line.size(); ++i) {
      length += norm(line[i] - line[i - 1]);
      material = std::max(material, stock::max_height(rest_.map, line[i], radius_));
      clear = clear && is_clear(line[i], above_);
      if (!reach_.is_free(line[i - 1], line[i], z, 0.5)) return false;
    }
    const double top = clear ? std::clamp(above_, z, material) : material;
    const double turns = std::ceil((top - z) / (length * std::tan(angle)) - 1e-9);
    if (length < radius_ || turns > kMostRampTurns) return false;
    come_down({line.front().x, line.front().y, top}, top);
    down_ = true;
    double way = 0.0;
    for (int turn = 0; turn < static_cast<int>(turns); ++turn) {
      for (std::size_t i = 1; i < line.size(); ++i) {
        way += norm(line[i] - line[i - 1]);
        const double deep = std::min(1.0, way / (turns * length));
        this->line({line[i].x, line[i].y, top - deep * (top - z)}, MoveRole::kRamp);
      }
    }
    this->line({line.front().x, line.front().y, z}, MoveRole::kRamp);
    return true;
  }

  [[nodiscard]] double ramp_angle() const {
    const double most = task_.cutter.maximum_ramp_angle_rad;
    return task_.ramp_angle_rad > 0.0 ? std::min(most, task_.ramp_angle_rad) : most;
  }

  /// The nearest place within a diameter where the cutter is in air and has a free way to p.
  [[nodiscard]] std::optional<Vec2> air_near(Vec2 p, double z) const {
    constexpr int kRings = 16, kAround = 24;
    std::uint32_t hint = 0;
    for (int k = 1; k <= kRings; ++k) {
      const double r = 2.0 * radius_ * k / kRings;
      for (int i = 0; i < kAround; ++i) {
        const double a = 2.0 * std::numbers::pi * i / kAround;
        const Vec2 q = p + Vec2{r * std::cos(a), r * std::sin(a)};
        if (!is_clear(q, z) || grid_.blocks(q, p, z)) continue;
        if (reach_.at(q, hint) <= z && reach_.is_free(q, p, z, 0.5)) return q;
      }
    }
    return std::nullopt;
  }

  /// A pass on the next line that can be reached from here without lifting.
  std::optional<std::size_t> neighbour(const std::vector<Pass>& todo, const std::vector<bool>& done,
                                       std::size_t i, double z) {
    if (!down_) return std::nullopt;
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

  [[nodiscard]] Vec3 here() const { return out_.path.point(out_.path.size() - 1); }
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
      line(at(enter_at_, v, z), MoveRole::kCut);
      line(at(from, v, z), MoveRole::kCut);
    } else {
      const auto open = [&](double u, double far) {
        return is_clear(hatch_.place(u, v), z) || air_before(u, far, v, z);
      };
      if (open(to, from) && !open(from, to)) std::swap(from, to);
      if (!enter(from, to, v, z)) {
        if (task_.terrace_mm > 0.0 && std::abs(to - from) < 0.5 * radius_) return false;  // a pit's bottom
        ++skipped_;
        skipped_mm_ += std::abs(to - from);
        return false;
      }
    }
    line(at(to, v, z), MoveRole::kCut);
    for (const double u : {from, to}) ends_.push_back(hatch_.place(u, v));
    down_ = true;
    return true;
  }

  [[nodiscard]] Vec3 at(double u, double v, double z) const {
    const Vec2 p = hatch_.place(u, v);
    return {p.x, p.y, z};
  }
  [[nodiscard]] bool in_air(Vec2 p, double z) const { return rest_.is_below(p, z); }
  /// In air, or where this cutter takes nothing, its corner or ball beside what stands higher.
  [[nodiscard]] bool is_clear(Vec2 p, double z) const {
    return task_.terrace_mm > 0.0 ? rest_.is_clear(p, z) : in_air(p, z);
  }

  /// From the security plane to the beginning of a pass, on its way from `u` to `far`.
  bool enter(double u, double far, double v, double z) {
    if (is_clear(hatch_.place(u, v), z)) {
      come_down(at(u, v, z), z);
      return true;
    }
    if (const auto beside = air_before(u, far, v, z)) {
      come_down(at(*beside, v, z), z);
      line(at(u, v, z), MoveRole::kCut);
      return true;
    }
    if (task_.terrace_mm > 0.0) {
      if (const auto q = air_near(hatch_.place(u, v), z)) {  // from what a pass beside it has cleared
        come_down({q->x, q->y, z}, z);
        line(at(u, v, z), MoveRole::kCut);
        return true;
      }
    }
    const double leg = std::min(std::abs(far - u), 4.0 * radius_);
    const double end = u + (far > u ? leg : -leg);
    double top = stock::max_height(rest_.map, hatch_.place(u, v), hatch_.place(end, v), radius_);
    const auto probe = [&](double w) { return is_clear(hatch_.place(u + w * (end - u), v), above_); };
    if (above_ < top && probe(0.0) && probe(0.25) && probe(0.5) && probe(0.75) && probe(1.0))
      top = std::max(z, above_);
    const double angle = ramp_angle();
    if (angle > 0.0 && leg >= 0.5 * radius_) {
      const double turns = std::ceil((top - z) / (2.0 * leg * std::tan(angle)) - 1e-9);
      if (turns <= kMostRampTurns) return ramp(u, end, v, top, z, std::max(1, static_cast<int>(turns)));
    }
    // Too short for a ramp: straight down through a terrace at most, where the cutter ramps elsewhere.
    const bool deep = rest_.meets(hatch_.place(u, v), z + 2.0 * task_.terrace_mm);
    if (task_.terrace_mm > 0.0 && angle > 0.0 && deep) return false;
    if (!task_.cutter.centre_cutting) return false;
    come_down(at(u, v, z), stock::max_height(rest_.map, hatch_.place(u, v), radius_));
    return true;
  }

  /// The nearest place in air, within a diameter and a half before a pass from u to `far`, that has a free
  /// way to its beginning: beside the piece, or where this level is cleared.
  [[nodiscard]] std::optional<double> air_before(double u, double far, double v, double z) const {
    constexpr int kPlaces = 24;
    const double step = 3.0 * radius_ / kPlaces * (far > u ? -1.0 : 1.0);
    const Vec2 begin = hatch_.place(u, v);
    for (int k = 1; k <= kPlaces; ++k) {
      const Vec2 p = hatch_.place(u + k * step, v);
      if (is_clear(p, z)) return reach_.is_free(p, begin, z) ? std::optional(u + k * step) : std::nullopt;
    }
    return std::nullopt;
  }

  bool ramp(double u, double end, double v, double top, double z, int turns) {
    come_down(at(u, v, top), top);
    for (int k = 0; k < 2 * turns; ++k) {
      const double next = k + 1 == 2 * turns ? z : top - (top - z) * (k + 1) / (2.0 * turns);
      line(at(k % 2 == 0 ? end : u, v, next), MoveRole::kRamp);
    }
    return true;
  }

  /// To p from above: low over what stands where that way is free, else over the security plane, fast to the
  /// clearance above `material`; at feed through the air there, then as a plunge. `was_there`: no deeper than
  /// before.
  void come_down(Vec3 p, double material, bool was_there = false) {
    const Vec3 high{p.x, p.y, task_.security_z_mm};
    if (out_.path.size() == 0) {
      out_.path.start(high);
    } else if (!link_low(p)) {
      lift();
      out_.path.rapid(high);
    }
    const double z = std::min(here().z, std::max(material, p.z) + task_.clearance_mm);
    if (z < task_.security_z_mm && here().z == task_.security_z_mm)
      out_.path.rapid({p.x, p.y, z}, MoveRole::kApproach);
    // Beside the piece nothing is near; on what is cleared the tip comes to stand on material.
    constexpr double kNearMm = 0.1;
    if (in_air(xy(p), p.z - kNearMm)) return line(p, MoveRole::kApproach);
    const double top = was_there || is_clear(xy(p), p.z) ? p.z : std::max(material, p.z);
    const double near = top + (is_raw(material) ? kAboveRaw : kAirAbove);
    if (near < here().z) line({p.x, p.y, near}, MoveRole::kApproach);
    line(p, MoveRole::kPlunge);
  }

  [[nodiscard]] bool is_raw(double material) const { return material >= task_.top_z_mm - kNothing; }

  /// Up, and at feed through the air above what stands on the way to p; false where that is longer than over
  /// the security plane, or something is to be avoided there.
  bool link_low(Vec3 p) {
    if (!down_) return false;
    const double material = stock::max_height(rest_.map, xy(here()), xy(p), radius_);
    const double z = std::max({material + (is_raw(material) ? kAboveRaw : kAirAbove), here().z, p.z});
    // At the feed of air, no farther than up to the plane and down again, both of them fast.
    if (norm(xy(p) - xy(here())) > 2.0 * (task_.security_z_mm - z)) return false;
    if (!reach_.is_free(xy(here()), xy(p), z, 0.5)) return false;
    line({here().x, here().y, z}, MoveRole::kRetract);
    line({p.x, p.y, z}, MoveRole::kLink);
    return true;
  }

  void lift() {
    const Vec3 p = here();
    if (p.z < task_.security_z_mm) out_.path.line({p.x, p.y, task_.security_z_mm}, MoveRole::kRetract);
    down_ = false;
  }

  void line(Vec3 to, MoveRole why) {
    constexpr double kNoWay = 1e-6;  // mm, shorter than a program's digits say
    if (out_.path.size() > 0 && norm(here() - to) < kNoWay) return;
    out_.path.line(to, why);
    stock::cut(rest_.map, rest_.profile, out_.path, out_.path.size() - 1);
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
  std::vector<Vec2> ends_;  ///< of the passes of this level, and of those below it that it stands on
  bool raised_ = false;     ///< this level stands on the one before
  double enter_at_ = 0.0;   ///< where the next pass is begun, along its line
  bool first_ = true;       ///< no level was cut
  double base_ = 0.0;       ///< the lowest level of this group
  double above_ = 1e300;    ///< that of the group before
  FreeformPath out_;
  bool down_ = false;
  int skipped_ = 0;
  double skipped_mm_ = 0.0;
};

}  // namespace

Result<FreeformPath> rough(const FreeformJob& task, Job& job) {
  const auto cutter = checked_cutter(task);
  if (!cutter) return tl::unexpected(cutter.error());
  if (!(task.axial_depth_mm > 0.0)) return fail("FRF-VALUE", "roughing needs an axial depth above 0");
  if (!(task.stepover_mm > 0.0) || task.stepover_mm > 2.0 * cutter->radius()) {
    return fail("FRF-VALUE", "roughing needs a stepover above 0 and up to the cutter's diameter, not " +
                                 trimmed(task.stepover_mm, 4) + " mm");
  }
  const DropCutter drop(*task.surface);
  const geometry::Region area = area_of(task, drop);
  geometry::Region out = kept_out(task, *cutter);
  Hatch lines =
      hatch(out.empty() ? area : geometry::subtract(area, out), task.feed_angle_rad, task.stepover_mm);
  if (lines.stripes.empty()) return fail("FRF-EMPTY", "the area to rough is empty");
  return Rougher(task, drop, *cutter, std::move(lines), std::move(out), job).run(area);
}

}  // namespace capstan::toolpath::freeform
