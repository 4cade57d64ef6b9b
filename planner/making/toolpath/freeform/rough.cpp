#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <string>

#include "planner/ground/base/number.h"
#include "planner/making/toolpath/defaults.h"
#include "planner/making/toolpath/freeform/freeform.h"
#include "planner/making/toolpath/freeform/hatch.h"
#include "planner/making/toolpath/freeform/level_contour.h"
#include "planner/making/toolpath/freeform/levels.h"
#include "planner/making/toolpath/freeform/surface_line.h"
#include "planner/making/toolpath/freeform/task.h"
#include "planner/physics/stock/sweep.h"

namespace capstan::toolpath::freeform {
namespace {

using geometry::Vec2;
using geometry::Vec3;
using model::MoveRole;

constexpr double kBlocked = 1e300;
/// More turns of a ramp than this and a place counts as not to be entered; default, unsourced.
constexpr int kMostRampTurns = 100;
constexpr double kMostGridPoints = 2e6;

/// Lowest tip heights along one stripe, evenly spaced.
struct Probes {
  double step = 0.0;
  std::vector<double> z;
};

/// A piece of a stripe that one level cuts, u from lo to hi.
struct Pass {
  std::size_t stripe = 0;
  double lo = 0.0, hi = 0.0;
};

class Rougher {
 public:
  Rougher(const FreeformJob& task, const DropCutter& drop, const MillEnd& cutter, Hatch hatch,
          geometry::Region kept_out, Job& job)
      : task_(task),
        drop_(drop),
        cutter_(cutter),
        hatch_(std::move(hatch)),
        kept_out_(std::move(kept_out)),
        job_(job),
        profile_(model::profile_of(task.cutter)),
        rest_(task.stock ? *task.stock : block(task, hatch_)) {
    margin_ = std::max(task.tolerance_mm, 0.1 * task.allowance_mm);
    spacing_ = std::min(probe_spacing(cutter.ball_mm() + task.allowance_mm, margin_),
                        kProbedShare * cutter.radius());
    floor_ = std::max(task.bottom_z_mm, rest_.origin.z);
    ends_alike_ = stock_ends_with(drop.bounds());
  }

  Result<FreeformPath> run(const geometry::Region& area) {
    probe_all();
    probe_grid(area);
    if (job_.stop_requested()) return stopped();
    double lowest = kBlocked;
    for (const Probes& p : probes_) {
      for (const double z : p.z) lowest = std::min(lowest, z);
    }
    if (lowest >= task_.top_z_mm) return fail("FRF-EMPTY", "nothing above the surface is left to rough");
    const auto [levels, floors] = levels_of(task_, lowest, margin_);
    floors_ = floors;
    for (std::size_t k = 0; k < levels.size(); ++k) {
      job_.progress("freeform rough", static_cast<double>(k) / static_cast<double>(levels.size()));
      if (job_.stop_requested()) return stopped();
      level(levels[k]);
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

  /// Solid material under the area, for a job without a stock.
  static stock::HeightMap block(const FreeformJob& task, const Hatch& hatch) {
    geometry::Box3 box;
    for (const Stripe& s : hatch.stripes) {
      for (const double u : {s.lo, s.hi}) {
        const Vec2 p = hatch.place(u, s.v);
        box.add({p.x, p.y, task.top_z_mm});
      }
    }
    const double low = std::max(task.bottom_z_mm, geometry::bounds(*task.surface).lo.z);
    box.add({box.lo.x, box.lo.y, std::min(low, task.top_z_mm)});
    return stock::from_box(box, stock::cell_for(task.cutter.cutting_diameter_mm, box, 40.0));
  }

  /// Whether the material ends where the surface does: then beside both is nothing that must stay.
  [[nodiscard]] bool stock_ends_with(const geometry::Box3& surface) const {
    const double within = 1.5 * rest_.cell_mm;  // the map's last cells are cut through
    return rest_.origin.x > surface.lo.x - within && rest_.origin.y > surface.lo.y - within &&
           rest_.origin.x + rest_.nx * rest_.cell_mm < surface.hi.x + within &&
           rest_.origin.y + rest_.ny * rest_.cell_mm < surface.hi.y + within;
  }

  [[nodiscard]] double reach_down(Vec2 p, std::uint32_t& hint, double share = 1.0) const {
    if (!kept_out_.empty() && geometry::contains(kept_out_, p)) return kBlocked;
    const double z = drop_.drop(cutter_, p.x, p.y, task_.allowance_mm + share * margin_, hint);
    if (z == DropCutter::kNoContact) return task_.beside_is_free || ends_alike_ ? floor_ : kBlocked;
    return std::max(z, floor_);
  }

  /// The grid that the borders of levels are read from; how fine it is decides only which borders are seen.
  void probe_grid(const geometry::Region& area) {
    const geometry::Box2 box = geometry::bounds(area);
    const Vec2 size = box.hi - box.lo;
    grid_.step_mm = std::max(0.125 * cutter_.radius(), std::sqrt(size.x * size.y / kMostGridPoints));
    grid_.origin = box.lo;
    grid_.nx = static_cast<int>(size.x / grid_.step_mm) + 1;
    grid_.ny = static_cast<int>(size.y / grid_.step_mm) + 1;
    grid_.z.resize(static_cast<std::size_t>(grid_.nx) * static_cast<std::size_t>(grid_.ny));
    parallel_for(job_, static_cast<std::size_t>(grid_.ny), [&](std::size_t row) {
      if (job_.stop_requested()) return;
      std::uint32_t hint = 0;
      for (int ix = 0; ix < grid_.nx; ++ix) {
        const Vec2 p = grid_.place(ix, static_cast<int>(row));
        grid_.z[row * static_cast<std::size_t>(grid_.nx) + static_cast<std::size_t>(ix)] =
            geometry::contains(area, p) ? reach_down(p, hint) : std::nan("");
      }
    });
  }

  void probe_all() {
    probes_.resize(hatch_.stripes.size());
    parallel_for(job_, probes_.size(), [&](std::size_t i) {
      if (job_.stop_requested()) return;
      const Stripe& s = hatch_.stripes[i];
      const int n = std::max(1, static_cast<int>(std::ceil((s.hi - s.lo) / spacing_)));
      probes_[i].step = (s.hi - s.lo) / n;
      std::uint32_t hint = 0;
      for (int k = 0; k <= n; ++k) {
        probes_[i].z.push_back(reach_down(hatch_.place(s.lo + k * probes_[i].step, s.v), hint));
      }
    });
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

  /// Last free place from `free` towards `blocked`, to a micrometre.
  [[nodiscard]] Vec2 border(Vec2 free, Vec2 blocked, double z) const {
    std::uint32_t hint = 0;
    while (norm(blocked - free) > 1e-3) {
      const Vec2 middle = 0.5 * (free + blocked);
      (reach_down(middle, hint) <= z ? free : blocked) = middle;
    }
    return free;
  }
  [[nodiscard]] double border(const Stripe& s, double free, double blocked, double z) const {
    return dot(border(hatch_.place(free, s.v), hatch_.place(blocked, s.v), z), hatch_.u_axis);
  }

  /// Cuts off, and splits at, long stretches without material; keeps a run-in in air where there is one.
  void trim(const Pass& whole, const Stripe& s, double z, std::vector<Pass>& out) const {
    const double radius = cutter_.radius();
    const double step = 0.25 * radius;
    const int n = std::max(1, static_cast<int>(std::ceil((whole.hi - whole.lo) / step)));
    const double du = (whole.hi - whole.lo) / n;
    std::optional<Pass> open;
    int idle = 0;
    for (int k = 0; k <= n; ++k) {
      const double u = whole.lo + k * du;
      if (stock::max_height(rest_, hatch_.place(u, s.v), radius) > z + kNothing) {
        if (!open) open = Pass{whole.stripe, std::max(whole.lo, u - du), u};
        open->hi = std::min(whole.hi, u + du);
        idle = 0;
      } else if (open && ++idle * du > 2.0 * radius) {
        out.push_back(*open);
        open.reset();
      }
    }
    if (open) out.push_back(*open);
  }

  void level(double z) {
    const bool on_floor = std::find(floors_.begin(), floors_.end(), z) != floors_.end();
    const bool walls_first = task_.left_mm && !on_floor;
    bool any = walls_first && along_borders(z);
    any |= within(z);
    if (!walls_first) any |= along_borders(z);
    ends_.clear();
    if (any) out_.levels_z_mm.push_back(z);
  }

  bool along_borders(double z) {
    bool any = false;
    const auto to_border = [&](Vec2 f, Vec2 b) { return border(f, b, z); };
    for (auto line : level_contour(grid_, z, to_border)) {
      if (!task_.floors_z_mm.empty()) {  // walls: what is left out round their corners meets deeper levels
        std::uint32_t hint = 0;
        line = refined(
            line, 0.25 * margin_, [&](Vec2 p) { return reach_down(p, hint) <= z; }, to_border);
      }
      any |= go_along(line, z);
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
      const bool material = stock::max_height(rest_, line[i - 1], line[i], cutter_.radius()) > z + kNothing;
      // Two points on a border: the chord may cut the border's corner by what the margin allows.
      if (!is_free(line[i - 1], line[i], z, 0.5) || (!material && !on)) {
        on = false;
        continue;
      }
      if (!on) on = approach(line[i - 1], z);
      if (!on) continue;
      this->line({line[i].x, line[i].y, z}, MoveRole::kCut);
      any = true;
      on = material || i + 1 < line.size();
    }
    return any;
  }

  /// To a point on a border: from here, or from the nearest pass's end with a free way to it.
  bool approach(Vec2 p, double z) {
    if (down_ && here().z == z && norm(xy(here()) - p) <= 2.0 * cutter_.radius() &&
        is_free(xy(here()), p, z, 0.5)) {
      line({p.x, p.y, z}, MoveRole::kCut);
      return true;
    }
    std::optional<Vec2> from;
    for (const Vec2 e : ends_) {
      if (norm(e - p) > 2.0 * cutter_.radius() || (from && norm(e - p) >= norm(*from - p))) continue;
      if (is_free(e, p, z, 0.5)) from = e;  // the cutter was there at this level
    }
    if (!from && task_.left_mm) from = air_near(p, z);
    if (!from) return false;
    come_down({from->x, from->y, z}, stock::max_height(rest_, *from, cutter_.radius()));
    down_ = true;
    line({p.x, p.y, z}, MoveRole::kCut);
    return true;
  }

  /// The nearest place within a diameter where the cutter is in air and has a free way to p.
  [[nodiscard]] std::optional<Vec2> air_near(Vec2 p, double z) const {
    constexpr int kRings = 16, kAround = 24;
    std::uint32_t hint = 0;
    for (int k = 1; k <= kRings; ++k) {
      const double r = 2.0 * cutter_.radius() * k / kRings;
      for (int i = 0; i < kAround; ++i) {
        const double a = 2.0 * std::numbers::pi * i / kAround;
        const Vec2 q = p + Vec2{r * std::cos(a), r * std::sin(a)};
        if (reach_down(q, hint) <= z && in_air(q, z) && is_free(q, p, z, 0.5)) return q;
      }
    }
    return std::nullopt;
  }

  /// A pass on the next line that can be reached from here without lifting.
  [[nodiscard]] std::optional<std::size_t> neighbour(const std::vector<Pass>& todo,
                                                     const std::vector<bool>& done, std::size_t i,
                                                     double z) const {
    if (!down_) return std::nullopt;
    const int line = hatch_.stripes[todo[i].stripe].line + 1;
    for (std::size_t k = i + 1; k < todo.size(); ++k) {
      const Stripe& s = hatch_.stripes[todo[k].stripe];
      if (s.line > line) break;
      if (s.line < line || done[k]) continue;
      const Vec2 to = hatch_.place(near_end(todo[k]), s.v);
      if (norm(to - xy(here())) <= 2.0 * cutter_.radius() + hatch_.spacing_mm && is_free(xy(here()), to, z)) {
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

  /// Whether a straight way at this level is clear with `share` of the margin, between the probes too.
  [[nodiscard]] bool is_free(Vec2 a, Vec2 b, double z, double share = 1.0) const {
    const double spacing =
        std::min(spacing_, probe_spacing(cutter_.ball_mm() + task_.allowance_mm, share * margin_));
    const int n = std::max(1, static_cast<int>(std::ceil(norm(b - a) / spacing)));
    std::uint32_t hint = 0;
    for (int k = 0; k <= n; ++k) {
      if (reach_down(a + (static_cast<double>(k) / n) * (b - a), hint, share) > z) return false;
    }
    return true;
  }

  bool cut_pass(const Pass& pass, double z, bool linked) {
    const double v = hatch_.stripes[pass.stripe].v;
    double from = pass.lo;
    double to = pass.hi;
    if (out_.path.size() > 0 && near_end(pass) == pass.hi) std::swap(from, to);
    if (linked) {
      line(at(from, v, z), MoveRole::kCut);
    } else {
      const auto open = [&](double u, double far) { return in_air(u, v, z) || air_before(u, far, v, z); };
      if (open(to, from) && !open(from, to)) std::swap(from, to);
      if (!enter(from, to, v, z)) {
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
  [[nodiscard]] bool in_air(Vec2 p, double z) const {
    return stock::max_height(rest_, p, cutter_.radius()) <= z + kNothing;
  }
  [[nodiscard]] bool in_air(double u, double v, double z) const { return in_air(hatch_.place(u, v), z); }

  /// From the security plane to the beginning of a pass, on its way from `u` to `far`.
  bool enter(double u, double far, double v, double z) {
    const double radius = cutter_.radius();
    if (in_air(u, v, z)) {
      come_down(at(u, v, z), z);
      return true;
    }
    if (const auto beside = air_before(u, far, v, z)) {
      come_down(at(*beside, v, z), z);
      line(at(u, v, z), MoveRole::kCut);
      return true;
    }
    const double leg = std::min(std::abs(far - u), 4.0 * radius);
    const double end = u + (far > u ? leg : -leg);
    const double top = stock::max_height(rest_, hatch_.place(u, v), hatch_.place(end, v), radius);
    const double most = task_.cutter.maximum_ramp_angle_rad;
    const double angle = task_.ramp_angle_rad > 0.0 ? std::min(most, task_.ramp_angle_rad) : most;
    if (angle > 0.0 && leg >= 0.5 * radius) {
      const double turns = std::ceil((top - z) / (2.0 * leg * std::tan(angle)) - 1e-9);
      if (turns <= kMostRampTurns) return ramp(u, end, v, top, z, std::max(1, static_cast<int>(turns)));
    }
    if (!task_.cutter.centre_cutting) return false;
    come_down(at(u, v, z), stock::max_height(rest_, hatch_.place(u, v), radius));
    return true;
  }

  /// The nearest place in air, within a diameter and a half before a pass from u to `far`, that has a free
  /// way to its beginning: beside the piece, or where this level is cleared.
  [[nodiscard]] std::optional<double> air_before(double u, double far, double v, double z) const {
    constexpr int kPlaces = 24;
    const double step = 3.0 * cutter_.radius() / kPlaces * (far > u ? -1.0 : 1.0);
    const Vec2 begin = hatch_.place(u, v);
    for (int k = 1; k <= kPlaces; ++k) {
      const Vec2 p = hatch_.place(u + k * step, v);
      if (in_air(p, z)) return is_free(p, begin, z) ? std::optional(u + k * step) : std::nullopt;
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

  /// Over the place at the security plane, fast to the clearance above `material`, at feed through the air
  /// there, then as a plunge.
  void come_down(Vec3 p, double material) {
    const Vec3 high{p.x, p.y, task_.security_z_mm};
    if (out_.path.size() == 0) {
      out_.path.start(high);
    } else {
      lift();
      out_.path.rapid(high);
    }
    const double z = std::min(task_.security_z_mm, std::max(material, p.z) + task_.clearance_mm);
    if (z < task_.security_z_mm) out_.path.rapid({p.x, p.y, z}, MoveRole::kApproach);
    // Beside the piece nothing is near; on what this level has cleared the tip comes to stand on material.
    constexpr double kNearMm = 0.1;
    if (in_air(xy(p), p.z - kNearMm)) return line(p, MoveRole::kApproach);
    const bool raw = material >= task_.top_z_mm - kNothing;
    const double near = std::max(material, p.z) + (raw ? kAboveRaw : kAirAbove);
    if (near < z) line({p.x, p.y, near}, MoveRole::kApproach);
    line(p, MoveRole::kPlunge);
  }

  void lift() {
    const Vec3 p = here();
    if (p.z < task_.security_z_mm) out_.path.line({p.x, p.y, task_.security_z_mm}, MoveRole::kRetract);
    down_ = false;
  }

  void line(Vec3 to, MoveRole why) {
    if (out_.path.size() > 0 && here() == to) return;
    out_.path.line(to, why);
    stock::cut(rest_, profile_, out_.path, out_.path.size() - 1);
  }

  const FreeformJob& task_;
  const DropCutter& drop_;
  MillEnd cutter_;
  Hatch hatch_;
  geometry::Region kept_out_;
  Job& job_;
  geometry::CutterProfile profile_;
  stock::HeightMap rest_;
  std::vector<double> floors_;  ///< levels that end on a floor
  double margin_ = 0.0, spacing_ = 0.0, floor_ = 0.0;
  bool ends_alike_ = false;  ///< stock and surface
  std::vector<Probes> probes_;
  DropGrid grid_;
  std::vector<Vec2> ends_;  ///< of the passes of this level
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
