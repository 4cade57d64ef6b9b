#include <algorithm>
#include <array>
#include <cmath>

#include "planner/making/optimise/feeds/motion_limits.h"

namespace capstan::optimise::feed {
namespace {

using model::CutterPath;

// Limits that can determine a feed along a path: those of FeedBound, then those of motion.
enum Name : std::size_t { kTolerance = kFeedBounds, kBlockTime, kNames };
constexpr std::array<std::string_view, kNames - kLimits> kText = {
    "step_feed",         "end_cutting", "air_feed",       "axis_feed",
    "axis_acceleration", "least_feed",  "path_tolerance", "block_time"};
constexpr std::array<std::string_view, kNames - kLimits> kUnit = {"mm/min", "mm/min", "mm/min", "mm/min",
                                                                  "mm/s2",  "mm/min", "mm",     "s"};

/// The largest feed that a bound of its own allows somewhere: ramps go faster than plunges.
double largest_by(const std::vector<Cap>& caps, FeedBound by) {
  double out = 0.0;
  for (const Cap& c : caps) {
    if (c.by == by) out = std::max(out, c.feed_mm_min);
  }
  return out;
}

double limit_value(const FeedQuestion& q, const std::vector<Cap>& caps, CutClasses& classes,
                   std::size_t name) {
  const CutLoads& loads = classes.loads(rpm_on(q, q.speed_factor.size()));
  const auto& axes = q.cut.machine.axes;
  if (name < kLimits) return stated(loads.limits()[name]) ? loads.limits()[name] : 0.0;
  switch (name) {
    case static_cast<std::size_t>(FeedBound::kStepFeed):
      return loads.ceiling_mm_min();
    case static_cast<std::size_t>(FeedBound::kEndCut):
      return largest_by(caps, FeedBound::kEndCut);
    case static_cast<std::size_t>(FeedBound::kAir):
      return kAirFeedMmMin;
    case static_cast<std::size_t>(FeedBound::kAxisFeed):
      return std::min(axes[0].feed_max_mm_min, axes[1].feed_max_mm_min);
    case static_cast<std::size_t>(FeedBound::kAcceleration):
      return std::min(axes[0].acceleration_mm_s2, axes[1].acceleration_mm_s2);
    case static_cast<std::size_t>(FeedBound::kUnknown):
      return loads.floor_mm_min();
    case kTolerance:
      return q.cut.machine.control.path_tolerance_mm;
    default:
      return q.cut.machine.control.block_time_s;
  }
}

std::array<double, kNames> seconds_by(const CutterPath& path, const Followed& f, const motion::StepTime& t) {
  std::array<double, kNames> out{};
  const auto acceleration = static_cast<std::size_t>(FeedBound::kAcceleration);
  for (std::size_t i = 1; i < path.size(); ++i) {
    if (path.kind[i] == model::MoveKind::kRapid || path.kind[i] == model::MoveKind::kDwell) continue;
    auto name = static_cast<std::size_t>(f.by[i]);
    if (t.top[i] == motion::TopBy::kAxes) name = static_cast<std::size_t>(FeedBound::kAxisFeed);
    if (t.top[i] == motion::TopBy::kTurning) name = acceleration;
    if (t.top[i] == motion::TopBy::kBlock) name = kBlockTime;
    out[name] += t.at_top_s[i];
    out[acceleration] += t.move_s[i] - t.at_top_s[i];
  }
  out[acceleration] = std::max(0.0, out[acceleration] - t.corner_s);
  out[kTolerance] += t.corner_s;
  return out;
}

/// Cutting seconds when there is 10 % more of one limit.
double seconds_with_more(const FeedQuestion& q, const CutterPath& path, const std::vector<Cap>& caps,
                         std::size_t name) {
  std::vector<double> most(caps.size());
  std::vector<FeedBound> by(caps.size());
  model::Machine machine = q.cut.machine;
  const bool of_caps = name <= kLimits;
  for (std::size_t i = 0; i < caps.size(); ++i) {
    most[i] = of_caps ? caps[i].more[name] : caps[i].feed_mm_min;
    by[i] = caps[i].by;
    const bool fraction = name == static_cast<std::size_t>(FeedBound::kEndCut) ||
                          name == static_cast<std::size_t>(FeedBound::kAir);
    if (fraction && static_cast<std::size_t>(caps[i].by) == name) most[i] *= kMoreOfALimit;
  }
  for (auto& axis : machine.axes) {
    if (name == static_cast<std::size_t>(FeedBound::kAxisFeed)) axis.feed_max_mm_min *= kMoreOfALimit;
    if (name == static_cast<std::size_t>(FeedBound::kAcceleration)) axis.acceleration_mm_s2 *= kMoreOfALimit;
  }
  if (name == kTolerance) machine.control.path_tolerance_mm *= kMoreOfALimit;
  if (name == kBlockTime) machine.control.block_time_s /= kMoreOfALimit;
  Followed f = followed(q, path, std::move(most), std::move(by), machine);
  const auto t = motion::time_of(path, schedule_with(q, path, std::move(f.feed_mm_min)), machine);
  return t ? t->cutting_s : -1.0;
}

}  // namespace

std::vector<model::LimitAlongPath> held_by(const FeedQuestion& q, const CutterPath& path,
                                           const std::vector<Cap>& caps, CutClasses& classes,
                                           const Followed& f) {
  std::vector<model::LimitAlongPath> out;
  const auto t = motion::time_of(path, schedule_with(q, path, f.feed_mm_min), q.cut.machine);
  if (!t || !(t->cutting_s > 0.0)) return out;
  const auto seconds = seconds_by(path, f, *t);
  for (std::size_t k = 0; k < kNames; ++k) {
    constexpr double kWorthSaying = 1e-4;
    const double share = std::clamp(seconds[k] / t->cutting_s, 0.0, 1.0);
    if (share < kWorthSaying) continue;
    model::LimitAlongPath l;
    l.name = k < kLimits ? row_of(model::kSectionLimits[k]).name : kText[k - kLimits];
    l.unit = k < kLimits ? row_of(model::kSectionLimits[k]).unit : kUnit[k - kLimits];
    l.limit = limit_value(q, caps, classes, k);
    if (!std::isfinite(l.limit)) l.limit = 0.0;
    l.share = share;
    const double quicker = seconds_with_more(q, path, caps, k);
    if (quicker >= 0.0) l.saves_s = std::max(0.0, t->cutting_s - quicker);
    out.push_back(std::move(l));
  }
  std::stable_sort(out.begin(), out.end(), [](const auto& a, const auto& b) { return a.share > b.share; });
  return out;
}

}  // namespace capstan::optimise::feed
