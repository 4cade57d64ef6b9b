#include "planner/making/optimise/feeds/motion_limits.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "planner/ground/base/number.h"
#include "planner/ground/base/stopping.h"
#include "planner/ground/vocabulary/control_rows.h"

namespace capstan::optimise::feed {
namespace {

using model::CutterPath;
using model::MoveKind;

constexpr double kLeastFeed = 0.1;  // mm/min, what a program can say

bool at_feed(const CutterPath& path, std::size_t i) {
  return i > 0 && path.kind[i] != MoveKind::kRapid && path.kind[i] != MoveKind::kDwell;
}

double down(double feed) { return std::max(rounded(std::floor(feed * 10.0 + 1e-6) / 10.0, 1), kLeastFeed); }

/// Largest feed of a move regardless of its direction, mm/min. Two axes together could move faster, but a
/// machine's stated maximum is that of one axis.
double across_mm_min(const CutterPath& path, std::size_t i, const model::Machine& machine) {
  double most = std::numeric_limits<double>::infinity();
  if (path.kind[i] == MoveKind::kLine && path.x[i] == path.x[i - 1] && path.y[i] == path.y[i - 1] &&
      path.z[i] != path.z[i - 1])
    return most;
  for (const std::size_t k : {0U, 1U}) {
    if (machine.axes[k].feed_max_mm_min > 0.0) most = std::min(most, machine.axes[k].feed_max_mm_min);
  }
  return most;
}

/// Each move brakes within itself to the feed of the next that has a length.
void brake(const CutterPath& path, const std::vector<motion::MoveReach>& reach, Followed& f) {
  std::size_t after = 0;
  for (std::size_t i = path.size(); i-- > 1;) {
    if (!at_feed(path, i)) {
      if (path.kind[i] == MoveKind::kDwell || reach[i].length_mm > 0.0) after = 0;
      continue;
    }
    if (!(reach[i].length_mm > 0.0)) continue;
    // A corner slower than the next feed is the control's to brake for: it knows the way.
    if (after != 0 && f.feed_mm_min[after] < reach[after].entry_mm_min &&
        f.feed_mm_min[after] < f.feed_mm_min[i]) {
      const double most = motion::braked_mm_min(reach[i], f.feed_mm_min[after]);
      if (most < f.feed_mm_min[i]) {
        f.feed_mm_min[i] = most;
        f.by[i] = FeedBound::kAcceleration;
      }
    }
    after = i;
  }
}

/// Runs of moves whose feeds lie within the ratio take their lowest.
void group(const CutterPath& path, double ratio, std::vector<double>& feed) {
  if (!(ratio > 0.0)) return;
  for (std::size_t i = 1; i < path.size();) {
    if (!at_feed(path, i)) {
      ++i;
      continue;
    }
    double lo = feed[i];
    double hi = feed[i];
    std::size_t end = i + 1;
    for (; end < path.size() && at_feed(path, end); ++end) {
      const double l = std::min(lo, feed[end]);
      const double h = std::max(hi, feed[end]);
      if (h > l * (1.0 + ratio)) break;
      lo = l;
      hi = h;
    }
    for (; i < end; ++i) feed[i] = lo;
  }
}

/// A run of moves at one feed asks for no more than its fastest move reaches.
void trim(const FeedQuestion& q, const CutterPath& path, const model::Machine& machine, Followed& f) {
  const auto time = motion::time_of(path, schedule_with(q, path, f.feed_mm_min), machine);
  if (!time) return;
  for (std::size_t i = 1; i < path.size();) {
    if (!at_feed(path, i)) {
      ++i;
      continue;
    }
    const double feed = f.feed_mm_min[i];
    double reached = 0.0;
    std::size_t end = i;
    for (; end < path.size() && at_feed(path, end) && f.feed_mm_min[end] == feed; ++end)
      reached = std::max(reached, time->peak_mm_min[end]);
    // A move too short to come to speed still asks for chips: what it reaches is the machine's to say.
    const double chips = is_milling(q.cut.kind) ? least_feed_mm_min(q.cut, q.n_rpm) : 0.0;
    const double enough = std::max(rounded(std::ceil(reached * 10.0 - 1e-6) / 10.0, 1), down(chips) + 0.1);
    for (; i < end; ++i) {
      if (reached > 0.0 && enough < feed) {
        f.feed_mm_min[i] = enough;
        f.by[i] = FeedBound::kAcceleration;
      }
    }
  }
}

}  // namespace

model::FeedSchedule schedule_with(const FeedQuestion& q, const CutterPath& path, std::vector<double> feeds) {
  model::FeedSchedule s;
  const std::size_t n = path.size();
  s.feed_mm_min = std::move(feeds);
  s.spindle_rpm.assign(n, q.n_rpm);
  s.dwell_s.assign(n, 0.0);
  for (std::size_t i = 0; i < n; ++i) {
    if (i < q.speed_factor.size()) s.spindle_rpm[i] = q.n_rpm * q.speed_factor[i];
    if (i < q.dwell_s.size()) s.dwell_s[i] = q.dwell_s[i];
    if (path.kind[i] == MoveKind::kRapid) s.feed_mm_min[i] = 0.0;
  }
  return s;
}

Followed followed(const FeedQuestion& q, const CutterPath& path, std::vector<double> most,
                  std::vector<FeedBound> by, const model::Machine& machine) {
  Followed f{std::move(most), std::move(by)};
  const auto reach = motion::reach_along(path, machine);
  for (std::size_t i = 1; i < path.size(); ++i) {
    if (!at_feed(path, i)) continue;
    tick();
    double axes = across_mm_min(path, i, machine);
    if (reach && (*reach)[i].length_mm > 0.0) axes = std::min(axes, (*reach)[i].most_mm_min);
    if (axes < f.feed_mm_min[i]) {
      f.feed_mm_min[i] = axes;
      f.by[i] = FeedBound::kAxisFeed;
    }
  }
  if (q.constant) {
    for (std::size_t i = 1; i < path.size(); ++i) {
      if (at_feed(path, i)) f.feed_mm_min[i] = down(f.feed_mm_min[i]);
    }
    return f;
  }
  group(path, q.group_ratio, f.feed_mm_min);
  const auto settle = [&] {
    if (reach && model::control_row(machine.control.dialect).brakes_within_a_move) brake(path, *reach, f);
    for (std::size_t i = 1; i < path.size(); ++i) {
      if (at_feed(path, i)) f.feed_mm_min[i] = down(f.feed_mm_min[i]);
    }
  };
  settle();
  trim(q, path, machine, f);
  settle();
  return f;
}

}  // namespace capstan::optimise::feed
