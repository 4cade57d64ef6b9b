#include "planner/motion/time.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <string>

#include "planner/motion/profile.h"

namespace capstan::motion {
namespace {

using geometry::Vec3;
using model::CutterPath;
using model::FeedSchedule;
using model::Machine;
using model::MoveKind;
using model::MoveRole;

// Share of the acceleration that a curve may use for turning; the rest (one half) is kept along the path.
// Source: LinuxCNC 2.9, blendmath.h, BLEND_ACC_RATIO_NORMAL.
constexpr double kNormalShare = 0.86602540378443864676;
constexpr double kTangentialShare = 0.5;
constexpr double kNoLimit = 1e300;

struct Limits {
  std::array<double, 3> rapid_mm_s{}, feed_mm_s{}, acceleration{};
  double tolerance_mm = 0.0;
  double block_s = 0.0;
};

Result<Limits> limits_of(const Machine& machine) {
  Limits out;
  for (std::size_t i = 0; i < 3; ++i) {
    const model::LinearAxis& axis = machine.axes[i];
    if (!(axis.acceleration_mm_s2 > 0.0) || !(axis.rapid_mm_min > 0.0) || !std::isfinite(axis.rapid_mm_min) ||
        !std::isfinite(axis.acceleration_mm_s2)) {
      return fail(Diagnostic{.code = "MOT-MACHINE",
                             .message = "axis " + axis.name + " has no rapid speed or no acceleration",
                             .path = "axes",
                             .hint = "state rapid and acceleration of each axis in the machine's file"});
    }
    out.rapid_mm_s[i] = axis.rapid_mm_min / 60.0;
    out.feed_mm_s[i] = axis.feed_max_mm_min > 0.0 ? axis.feed_max_mm_min / 60.0 : out.rapid_mm_s[i];
    out.acceleration[i] = axis.acceleration_mm_s2;
  }
  out.tolerance_mm = machine.control.path_tolerance_mm;
  out.block_s = machine.control.block_time_s;
  return out;
}

std::array<double, 3> array_of(Vec3 v) { return {v.x, v.y, v.z}; }

// The largest length along u that keeps every axis within its limit.
double along(const std::array<double, 3>& limit, Vec3 u) {
  const auto c = array_of(u);
  double out = kNoLimit;
  for (std::size_t i = 0; i < 3; ++i) {
    if (std::abs(c[i]) > 1e-12) out = std::min(out, limit[i] / std::abs(c[i]));
  }
  return out;
}

// What every axis can give in any direction of the plane spanned by the orthonormal u and v.
double within_plane(const std::array<double, 3>& limit, Vec3 u, Vec3 v) {
  const auto a = array_of(u);
  const auto b = array_of(v);
  double out = kNoLimit;
  for (std::size_t i = 0; i < 3; ++i) {
    const double reach = std::hypot(a[i], b[i]);
    if (reach > 1e-12) out = std::min(out, limit[i] / reach);
  }
  return out;
}

// One move with its directions at both ends.
struct Shape {
  Segment segment;
  Vec3 first, last;  // unit tangents; zero for a move without length
};

bool is_arc(MoveKind k) { return k == MoveKind::kArcCw || k == MoveKind::kArcCcw; }

Shape line_shape(const CutterPath& path, std::size_t i, double feed_mm_s, const Limits& limits) {
  Shape out;
  const Vec3 step = path.point(i) - path.point(i - 1);
  const double length = norm(step);
  if (length <= 0.0) return out;
  const Vec3 u = (1.0 / length) * step;
  out.first = out.last = u;
  out.segment.length_mm = length;
  out.segment.acceleration_mm_s2 = along(limits.acceleration, u);
  out.segment.speed_mm_s = path.kind[i] == MoveKind::kRapid ? along(limits.rapid_mm_s, u)
                                                            : std::min(feed_mm_s, along(limits.feed_mm_s, u));
  return out;
}

Shape arc_shape(const CutterPath& path, std::size_t i, double feed_mm_s, const Limits& limits) {
  Shape out;
  const double radius = std::hypot(path.x[i] - path.cx[i], path.y[i] - path.cy[i]);
  const double turned = model::arc_sweep(path, i) * radius;
  const double rise = path.z[i] - path.z[i - 1];
  const double length = std::hypot(turned, rise);
  if (length <= 0.0 || radius <= 0.0) return out;
  const double flat = turned / length;
  const double steep = rise / length;
  const double sign = path.kind[i] == MoveKind::kArcCcw ? 1.0 : -1.0;
  const auto tangent = [&](double x, double y) {
    const double k = sign * flat / std::hypot(x - path.cx[i], y - path.cy[i]);
    return Vec3{-k * (y - path.cy[i]), k * (x - path.cx[i]), steep};
  };
  out.first = tangent(path.x[i - 1], path.y[i - 1]);
  out.last = tangent(path.x[i], path.y[i]);
  // Somewhere on the arc (or close to it) either axis carries all of the motion.
  const Vec3 in_x{flat, 0.0, steep};
  const Vec3 in_y{0.0, flat, steep};
  const double a = std::min(along(limits.acceleration, in_x), along(limits.acceleration, in_y));
  const double bend_mm = radius / (flat * flat);  // radius of curvature of a helix
  const double turning = std::sqrt(kNormalShare * a * bend_mm);
  const double v =
      std::min({feed_mm_s, along(limits.feed_mm_s, in_x), along(limits.feed_mm_s, in_y), turning});
  const double used = v * v / (bend_mm * a);
  out.segment = {length, v, a * std::max(kTangentialShare, std::sqrt(std::max(0.0, 1.0 - used * used))), 0.0};
  return out;
}

// Speed of passing from one move into the next, with the corner rounded within the tolerance.
double junction_mm_s(const Shape& before, const Shape& after, const Limits& limits) {
  const double both = std::min(before.segment.speed_mm_s, after.segment.speed_mm_s);
  const double cosine = std::clamp(dot(before.last, after.first), -1.0, 1.0);
  const Vec3 aside = after.first - cosine * before.last;
  const double sine = norm(aside);
  if (sine < 1e-9) return cosine > 0.0 ? both : 0.0;
  const double half = 0.5 * (std::numbers::pi - std::atan2(sine, cosine));
  const double s = std::sin(half);
  const double by_tolerance = limits.tolerance_mm * s / (1.0 - s);
  const double by_length = std::tan(half) * 0.5 * std::min(before.segment.length_mm, after.segment.length_mm);
  const double radius = std::min(by_tolerance, by_length);
  if (!(radius > 0.0)) return 0.0;
  const double a = within_plane(limits.acceleration, before.last, (1.0 / sine) * aside);
  return std::min(both, std::sqrt(kNormalShare * a * radius));
}

tl::unexpected<Diagnostic> bad(const char* code, const char* what, std::size_t move) {
  return fail(Diagnostic{.code = code, .message = what, .path = "move " + std::to_string(move)});
}

// The scan over one path. Columns hold one entry per move; entry 0 is the start.
class Scan {
 public:
  Scan(const CutterPath& path, const FeedSchedule& schedule, const Machine& machine, const Limits& limits)
      : path_(path), schedule_(schedule), machine_(machine), limits_(limits) {}

  Result<StepTime> run() {
    const std::size_t n = path_.size();
    out_.move_s.assign(n, 0.0);
    out_.peak_mm_min.assign(n, 0.0);
    segments_.assign(n, Segment{});
    next_.assign(n, 0);
    if (auto filled = fill(); !filled) return tl::unexpected(filled.error());
    for (std::size_t i = n; i-- > 1;) {
      Segment& s = segments_[i];
      if (s.length_mm > 0.0) s.entry_mm_s = std::min(s.entry_mm_s, reachable(s, exit_limit(i)));
    }
    for (std::size_t i = 1; i < n; ++i) take(i);
    return std::move(out_);
  }

 private:
  // Moves without length do not exist for the scan: the next one joins the last that had a length.
  Status fill() {
    Shape before;
    std::size_t last = 0;
    for (std::size_t i = 1; i < path_.size(); ++i) {
      const MoveKind kind = path_.kind[i];
      if (!std::isfinite(path_.x[i] + path_.y[i] + path_.z[i] + path_.cx[i] + path_.cy[i])) {
        return bad("MOT-NUMBER", "a coordinate is not finite", i);
      }
      const double change =
          spindle_change_s(machine_.spindle, schedule_.spindle_rpm[i - 1], schedule_.spindle_rpm[i]);
      const bool new_speed = i > 1 && schedule_.spindle_rpm[i] != schedule_.spindle_rpm[i - 1];
      if (new_speed) out_.spindle_s += change;
      if (kind == MoveKind::kDwell) {
        if (!(schedule_.dwell_s[i] >= 0.0)) return bad("MOT-NUMBER", "a dwell has no time", i);
        out_.move_s[i] = schedule_.dwell_s[i];
        out_.dwell_s += schedule_.dwell_s[i];
        last = 0;
        continue;
      }
      const double feed = schedule_.feed_mm_min[i] / 60.0;
      if (kind != MoveKind::kRapid && !(feed > 0.0 && std::isfinite(feed))) {
        return bad("MOT-FEED", "a move at feed has no feed", i);
      }
      Shape shape = is_arc(kind) ? arc_shape(path_, i, feed, limits_) : line_shape(path_, i, feed, limits_);
      if (shape.segment.length_mm <= 0.0) {
        if (new_speed) last = 0;
        continue;
      }
      if (limits_.block_s > 0.0) {
        shape.segment.speed_mm_s =
            std::min(shape.segment.speed_mm_s, shape.segment.length_mm / limits_.block_s);
      }
      if (new_speed || (last != 0 && stops(last, i))) last = 0;
      shape.segment.entry_mm_s = last == 0 ? 0.0 : junction_mm_s(before, shape, limits_);
      segments_[i] = shape.segment;
      next_[last] = i;
      before = shape;
      last = i;
    }
    return {};
  }

  [[nodiscard]] bool stops(std::size_t before, std::size_t after) const {
    return (path_.kind[before] == MoveKind::kRapid) != (path_.kind[after] == MoveKind::kRapid) ||
           path_.role[before] == MoveRole::kTap || path_.role[after] == MoveRole::kTap;
  }

  // Speed at the end of move i: the entry of the next move that has a length, 0 where it stops.
  [[nodiscard]] double exit_limit(std::size_t i) const {
    return next_[i] == 0 ? 0.0 : segments_[next_[i]].entry_mm_s;
  }

  void take(std::size_t i) {
    const Segment& s = segments_[i];
    if (s.length_mm <= 0.0) return;
    if (next_[i] != 0) {
      double& exit = segments_[next_[i]].entry_mm_s;
      exit = std::min(exit, reachable(s, s.entry_mm_s));
    }
    const SegmentTime t = trapezoid(s, s.entry_mm_s, exit_limit(i));
    out_.move_s[i] = t.seconds;
    out_.peak_mm_min[i] = 60.0 * t.peak_mm_s;
    (path_.kind[i] == MoveKind::kRapid ? out_.rapid_s : out_.cutting_s) += t.seconds;
  }

  const CutterPath& path_;
  const FeedSchedule& schedule_;
  const Machine& machine_;
  const Limits& limits_;
  std::vector<Segment> segments_;
  std::vector<std::size_t> next_;  // the move that follows without a stop between; 0: none
  StepTime out_;
};

}  // namespace

double spindle_change_s(const model::Spindle& spindle, double from_rpm, double to_rpm) {
  if (!(spindle.rpm_max > 0.0)) return from_rpm == to_rpm ? 0.0 : spindle.spin_up_s;
  return spindle.spin_up_s * std::abs(to_rpm - from_rpm) / spindle.rpm_max;
}

Result<StepTime> time_of(const CutterPath& path, const FeedSchedule& schedule, const Machine& machine) {
  const std::size_t n = path.size();
  if (schedule.feed_mm_min.size() != n || schedule.spindle_rpm.size() != n || schedule.dwell_s.size() != n) {
    return fail("MOT-SCHEDULE", "the feed schedule does not have one entry per move of the path");
  }
  const auto limits = limits_of(machine);
  if (!limits) return tl::unexpected(limits.error());
  return Scan(path, schedule, machine, *limits).run();
}

}  // namespace capstan::motion
