#include "planner/physics/motion/time.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "planner/ground/base/stopping.h"
#include "planner/physics/motion/s_curve.h"
#include "planner/physics/motion/shape.h"

namespace capstan::motion {
namespace {

using model::CutterPath;
using model::FeedSchedule;
using model::Machine;
using model::MoveKind;

tl::unexpected<Diagnostic> bad(const char* code, const char* what, std::size_t move) {
  return fail(Diagnostic{.code = code, .message = what, .path = "move " + std::to_string(move)});
}

bool finite_point(const CutterPath& p, std::size_t i) {
  return std::isfinite(p.x[i] + p.y[i] + p.z[i] + p.cx[i] + p.cy[i]);
}

// A ramp that began somewhere without acceleration and has not ended yet.
struct Ramp {
  double speed = 0.0;  // where it began
  double length = 0.0, a = 0.0, jerk = 0.0;

  void begin(double v) { *this = {v, 0.0, 0.0, 0.0}; }

  // The speed after the next segment, when it follows one that is run at `v`.
  double over(const Segment& s, double v) {
    // Where the axes share the motion otherwise, it is another ramp.
    constexpr double kAlike = 1.25;
    const bool alike =
        length > 0.0 && s.acceleration_mm_s2 <= kAlike * a && a <= kAlike * s.acceleration_mm_s2;
    if (!alike) *this = {v, 0.0, s.acceleration_mm_s2, s.jerk_mm_s3};
    a = std::min(a, s.acceleration_mm_s2);
    jerk = std::min(jerk, s.jerk_mm_s3);
    length += s.length_mm;
    return std::max(v, reachable_smoothly(speed, length, a, jerk));
  }
};

// The scans over one path. Columns hold one entry per move; entry 0 is the start.
class Scan {
 public:
  Scan(const CutterPath& path, const FeedSchedule& schedule, const Machine& machine, const Limits& limits)
      : path_(path), schedule_(schedule), machine_(machine), limits_(limits) {}

  Result<StepTime> run() {
    const std::size_t n = path_.size();
    out_.move_s.assign(n, 0.0);
    out_.peak_mm_min.assign(n, 0.0);
    out_.at_top_s.assign(n, 0.0);
    out_.top.assign(n, TopBy::kFeed);
    segments_.assign(n, Segment{});
    next_.assign(n, 0);
    corner_.assign(n, 0.0);
    if (auto filled = fill(); !filled) return tl::unexpected(filled.error());
    if (limits_.has_jerk) {
      smooth();
    } else {
      for (std::size_t i = n; i-- > 1;) {
        Segment& s = segments_[i];
        if (s.length_mm > 0.0) s.entry_mm_s = std::min(s.entry_mm_s, reachable(s, exit_limit(i)));
      }
      for (std::size_t i = 1; i < n; ++i) take(i);
    }
    for (std::size_t i = 1; i < n; ++i) sum(i);
    return std::move(out_);
  }

 private:
  // Moves without length do not exist for the scan: the next one joins the last that had a length.
  Status fill() {
    if (path_.size() > 0 && !finite_point(path_, 0))
      return bad("MOT-NUMBER", "a coordinate is not finite", 0);
    Shape before;
    std::size_t last = 0;
    for (std::size_t i = 1; i < path_.size(); ++i) {
      tick();
      const MoveKind kind = path_.kind[i];
      if (!finite_point(path_, i)) return bad("MOT-NUMBER", "a coordinate is not finite", i);
      if (!std::isfinite(schedule_.spindle_rpm[i])) return bad("MOT-NUMBER", "a speed is not finite", i);
      const double change =
          spindle_change_s(machine_.spindle, schedule_.spindle_rpm[i - 1], schedule_.spindle_rpm[i]);
      const bool new_speed = i > 1 && schedule_.spindle_rpm[i] != schedule_.spindle_rpm[i - 1];
      if (new_speed) out_.spindle_s += change;
      if (kind == MoveKind::kDwell) {
        if (!(schedule_.dwell_s[i] >= 0.0 && std::isfinite(schedule_.dwell_s[i])))
          return bad("MOT-NUMBER", "a dwell has no time", i);
        out_.move_s[i] = schedule_.dwell_s[i];
        out_.dwell_s += schedule_.dwell_s[i];
        last = 0;
        continue;
      }
      const double feed = schedule_.feed_mm_min[i] / 60.0;
      if (kind != MoveKind::kRapid && !(feed > 0.0 && std::isfinite(feed))) {
        return bad("MOT-FEED", "a move at feed has no feed", i);
      }
      Shape shape = shape_of(path_, i, feed, limits_);
      if (shape.segment.length_mm <= 0.0) {
        if (new_speed) last = 0;
        continue;
      }
      out_.top[i] = top_of(shape, kind == MoveKind::kRapid ? kNoSpeed : feed);
      if (new_speed || (last != 0 && stops_between(path_, last, i))) last = 0;
      if (last != 0) {
        const Junction j = junction(before, shape, limits_);
        shape.segment.entry_mm_s = j.speed_mm_s;
        corner_[i] = j.by_tolerance ? j.speed_mm_s : -1.0;
      } else {
        corner_[i] = -1.0;
      }
      segments_[i] = shape.segment;
      next_[last] = i;
      before = shape;
      last = i;
    }
    return {};
  }

  TopBy top_of(Shape& shape, double feed) const {
    Segment& s = shape.segment;
    if (limits_.block_s > 0.0 && s.length_mm < limits_.block_s * s.speed_mm_s) {
      s.speed_mm_s = s.length_mm / limits_.block_s;
      return TopBy::kBlock;
    }
    if (feed <= std::min(shape.axes_mm_s, shape.turning_mm_s)) return TopBy::kFeed;
    return shape.turning_mm_s < shape.axes_mm_s ? TopBy::kTurning : TopBy::kAxes;
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
    keep(i, trapezoid(s, s.entry_mm_s, exit_limit(i)));
  }

  void keep(std::size_t i, const SegmentTime& t) {
    out_.move_s[i] = t.seconds;
    out_.peak_mm_min[i] = 60.0 * t.peak_mm_s;
    constexpr double kRounding = 1e-9;
    if (t.peak_mm_s >= segments_[i].speed_mm_s * (1.0 - kRounding))
      out_.at_top_s[i] = std::min(out_.move_s[i], t.at_peak_s);
  }

  // With jerk: where each place's own limit does not hold, one ramp goes on from the last that does.
  void smooth() {
    const std::size_t n = path_.size();
    std::vector<char> touched(n, 1);  // the entry is passed at its own limit
    std::vector<char> begins(n, 1);   // a rise may begin there
    Ramp ramp;
    for (std::size_t i = n; i-- > 1;) {
      Segment& s = segments_[i];
      if (s.length_mm <= 0.0) continue;
      const std::size_t after = next_[i];
      if (after == 0 || touched[after] != 0) ramp.begin(exit_limit(i));
      tick();
      const double reach = ramp.over(s, exit_limit(i));
      touched[i] = s.entry_mm_s <= reach ? 1 : 0;
      s.entry_mm_s = std::min(s.entry_mm_s, reach);
    }
    ramp.begin(0.0);
    for (std::size_t i = 1; i < n; ++i) {
      const Segment& s = segments_[i];
      const std::size_t after = next_[i];
      if (s.length_mm <= 0.0) continue;
      tick();
      if (begins[i] != 0) ramp.begin(s.entry_mm_s);
      const double reach = ramp.over(s, s.entry_mm_s);
      if (after == 0) continue;
      double& exit = segments_[after].entry_mm_s;
      begins[after] = exit <= reach ? 1 : 0;
      if (exit > reach) touched[after] = 0;
      exit = std::min(exit, reach);
    }
    for (std::size_t i = 1; i < n;) i = stretch(i, touched);
  }

  // One stretch from a touched place to the next; gives the move after it.
  std::size_t stretch(std::size_t first, const std::vector<char>& touched) {
    if (segments_[first].length_mm <= 0.0) return first + 1;
    Segment whole;
    whole.acceleration_mm_s2 = whole.jerk_mm_s3 = kNoJerk;
    double highest = -1.0;
    std::size_t last = first;
    for (std::size_t i = first;; i = next_[i]) {
      const Segment& s = segments_[i];
      last = i;
      whole.length_mm += s.length_mm;
      whole.acceleration_mm_s2 = std::min(whole.acceleration_mm_s2, s.acceleration_mm_s2);
      whole.jerk_mm_s3 = std::min(whole.jerk_mm_s3, s.jerk_mm_s3);
      const double mean = s.entry_mm_s + exit_limit(i);
      if (mean > highest) {
        highest = mean;
        whole.speed_mm_s = s.speed_mm_s;
      }
      if (next_[i] == 0 || touched[next_[i]] != 0) break;
    }
    const double v0 = segments_[first].entry_mm_s;
    const double v1 = exit_limit(last);
    const SegmentTime t = s_curve(whole, v0, v1);
    if (first == last) {
      keep(first, t);
    } else {
      share(first, last, SCurve(whole, v0, v1, t), t);
    }
    return last + 1;
  }

  // The curve's time among the moves of a stretch.
  void share(std::size_t first, std::size_t last, SCurve curve, const SegmentTime& t) {
    double length = 0.0;
    double before_s = 0.0;
    double entered = segments_[first].entry_mm_s;
    const double top_from = 0.5 * (t.seconds - t.at_peak_s);  // nearly: the ramps may differ
    for (std::size_t i = first;; i = next_[i]) {
      Segment& s = segments_[i];
      length += s.length_mm;
      const double at_s = i == last ? t.seconds : curve.seconds_at(length);
      const double left = i == last ? exit_limit(last) : std::min(curve.speed_there(), s.speed_mm_s);
      SegmentTime one;
      one.seconds = std::max(at_s - before_s, s.length_mm / s.speed_mm_s);
      const bool tops = before_s <= top_from + t.at_peak_s && at_s >= top_from;
      one.peak_mm_s = tops ? std::min(t.peak_mm_s, s.speed_mm_s) : std::max(entered, left);
      one.peak_mm_s = std::max(one.peak_mm_s, s.length_mm / std::max(one.seconds, 1e-12));
      if (tops)
        one.at_peak_s = std::max(0.0, std::min(at_s, top_from + t.at_peak_s) - std::max(before_s, top_from));
      s.entry_mm_s = entered;
      keep(i, one);
      entered = left;
      before_s = at_s;
      if (i == last) break;
    }
  }

  void sum(std::size_t i) {
    if (segments_[i].length_mm <= 0.0) return;
    if (path_.kind[i] == MoveKind::kRapid) {
      out_.rapid_s += out_.move_s[i];
      return;
    }
    out_.cutting_s += out_.move_s[i];
    const double v0 = segments_[i].entry_mm_s;
    const double v1 = exit_limit(i);
    const double peak = out_.peak_mm_min[i] / 60.0;
    const double up = std::max(0.0, peak - v0);
    const double down = std::max(0.0, peak - v1);
    const double changing = out_.move_s[i] - out_.at_top_s[i];
    if (!(up + down > 0.0)) return;
    const bool from = corner_[i] >= 0.0 && v0 >= corner_[i] * (1.0 - 1e-9);
    const bool to = next_[i] != 0 && corner_[next_[i]] >= 0.0 && v1 >= corner_[next_[i]] * (1.0 - 1e-9);
    out_.corner_s += changing * ((from ? up : 0.0) + (to ? down : 0.0)) / (up + down);
  }

  const CutterPath& path_;
  const FeedSchedule& schedule_;
  const Machine& machine_;
  const Limits& limits_;
  std::vector<Segment> segments_;
  std::vector<std::size_t> next_;  // the next move without a stop in between; 0: none
  std::vector<double> corner_;     // speed at the start of a move where the path tolerance limits it; else -1
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

Result<std::vector<MoveReach>> reach_along(const CutterPath& path, const Machine& machine) {
  const auto limits = limits_of(machine);
  if (!limits) return tl::unexpected(limits.error());
  std::vector<MoveReach> out(path.size());
  if (path.size() > 0 && !finite_point(path, 0)) return bad("MOT-NUMBER", "a coordinate is not finite", 0);
  Shape before;
  std::size_t last = 0;
  for (std::size_t i = 1; i < path.size(); ++i) {
    tick();
    if (!finite_point(path, i)) return bad("MOT-NUMBER", "a coordinate is not finite", i);
    if (path.kind[i] == MoveKind::kDwell) {
      last = 0;
      continue;
    }
    const Shape shape = shape_of(path, i, kNoSpeed, *limits);
    const Segment& s = shape.segment;
    if (s.length_mm <= 0.0) continue;
    const bool stop = last == 0 || stops_between(path, last, i);
    out[i] = {s.length_mm, 60.0 * s.speed_mm_s, s.acceleration_mm_s2,
              s.jerk_mm_s3 < kNoJerk ? s.jerk_mm_s3 : 0.0,
              stop ? 0.0 : 60.0 * junction(before, shape, *limits).speed_mm_s};
    before = shape;
    last = i;
  }
  return out;
}

double braked_mm_min(const MoveReach& move, double exit_mm_min) {
  const double exit = exit_mm_min / 60.0;
  if (move.jerk_mm_s3 > 0.0)
    return 60.0 * reachable_smoothly(exit, move.length_mm, move.acceleration_mm_s2, move.jerk_mm_s3);
  return 60.0 * std::sqrt(exit * exit + 2.0 * move.acceleration_mm_s2 * move.length_mm);
}

}  // namespace capstan::motion
