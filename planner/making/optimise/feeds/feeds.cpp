#include "planner/making/optimise/feeds.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <utility>

#include "planner/ground/base/stopping.h"
#include "planner/making/optimise/cut/law/law.h"
#include "planner/making/optimise/cut/limits.h"
#include "planner/making/optimise/feeds/cut_loads.h"
#include "planner/making/optimise/feeds/motion_limits.h"
#include "planner/physics/mechanics/constants.h"
#include "planner/physics/mechanics/surface.h"

// The feed schedule is made in four stages:
//
// 1. Caps (`caps_of`, move_limits.cpp): for each move the largest feed at which every section measured along
//    it keeps every limit. Sections that are nearly equal form a class, whose feed is computed once
//    (cut_classes.cpp). Plunges and ramps also keep their fraction of the step's feed.
// 2. Axes (`followed`, motion_limits.cpp): caps are lowered to what the axes can do; neighbours within
//    `group_ratio` share the lower feed.
// 3. Braking: backwards along the path v_i^2 <= v_(i+1)^2 + 2 a L_i, for controls that brake within a move.
//    Then a run of moves at one feed asks for no more than its fastest move reaches, and braking is applied
//    once more.
// 4. Peaks (`measure_peaks`): the loads of each class at the largest feed at which it is cut, and the largest
//    excess over a limit with its place.
//
// With `constant` one feed replaces the caps of cutting moves, the largest that every section allows
// (`constant_feed`), and nothing is grouped or braked.
// Source  loads: mechanics/loads/section.h; the braking bound: constant deceleration, derived.

namespace capstan::optimise {
namespace {

using namespace feed;
using model::CutterPath;
using model::MoveKind;
using model::MoveRole;

/// Plunges and ramps keep their own feed, where it is lower.
bool ends_in(MoveRole r) { return r == MoveRole::kPlunge || r == MoveRole::kRamp; }

/// The largest feed at which every section of the cut keeps its limits, to 1e-6: by the grid first, directly
/// where it matters.
double constant_feed(const FeedQuestion& q, const CutterPath& path, CutClasses& classes) {
  double best = 0.0;
  for (std::size_t i = 1; i < path.size(); ++i) {
    const double given = i < q.feed_factor.size() ? std::max(q.feed_factor[i], 0.0) : 1.0;
    if (path.role[i] == MoveRole::kCut && given > 0.0)
      best = std::max(best, q.samples.empty() ? q.feed_mm_min : classes.loads(rpm_on(q, i)).ceiling_mm_min());
  }
  if (!(best > 0.0)) best = q.feed_mm_min;
  if (!is_milling(q.cut.kind) || !q.adapt) return best;
  std::vector<std::pair<double, std::size_t>> order;
  for (std::size_t k = 0; k < q.samples.size(); ++k) {
    const CutSample& s = q.samples[k];
    if (s.plunge || !(s.ap_mm > 0.0) || s.move >= path.size() || ends_in(path.role[s.move])) continue;
    tick();
    const double n = rpm_on(q, s.move);
    const double on_grid = sample_feed(classes, s, q.cut, n).feed_mm_min;
    if (on_grid < best) order.emplace_back(on_grid, k);
  }
  std::sort(order.begin(), order.end());
  for (const auto& [on_grid, k] : order) {
    if (on_grid >= best) break;
    const CutSample& s = q.samples[k];
    const CutLoads& loads = classes.loads(rpm_on(q, s.move));
    const Cuts cuts = cuts_of(s, q.cut);
    for (std::size_t c = 0; c < cuts.n; ++c) {
      const auto at_best = loads.at(cuts.cut[c], best);
      if (at_best && ratio(at_best->load, loads.limits()) <= 1.0) continue;
      best = std::max(loads.largest(cuts.cut[c], best), loads.floor_mm_min());
    }
  }
  return best;
}

void keep_largest(double& a, double b) {
  if (std::abs(b) > std::abs(a)) a = b;
}

void keep_peak(model::StepLoads& peak, const State& s, const CutLoads& loads, const model::Cutter& cutter) {
  const auto load = [&](Limit l) { return s.load.of(l); };
  peak.peak_force_n = std::max(peak.peak_force_n, load(Limit::kPeakForce));
  peak.deflection_mm = std::max(peak.deflection_mm, load(Limit::kToolDeflection));
  peak.torque_nm = std::max(peak.torque_nm, load(Limit::kSpindleTorque));
  peak.power_w = std::max(peak.power_w, load(Limit::kSpindlePower));
  peak.chip_thickness_mm = std::max(peak.chip_thickness_mm, s.chip_mm);
  // From the Ra that `cut` compares back to the height of the marks.
  const double rz =
      load(Limit::kSurfaceRoughness) / (1000.0 * kRoughnessOverGeometry * mechanics::kArcRaOverRz);
  peak.surface_rz_mm = std::max(peak.surface_rz_mm, rz);
  peak.wall_error_mm = std::max(peak.wall_error_mm, load(Limit::kWallError));
  const double margin = loads.margin();
  const auto keep = [](model::AxisForces& a, const model::AxisForces& b) {
    keep_largest(a.x_n, b.x_n);
    keep_largest(a.y_n, b.y_n);
    keep_largest(a.z_n, b.z_n);
  };
  keep(peak.mean_force, axis_forces(s.raw.mean, margin, cutter));
  keep(peak.peak_force, axis_forces(s.raw.peak, margin, cutter));
  peak.force_margin = margin;
}

/// The limit that a load exceeds most.
model::ExceededLimit worst_limit(const Column& load, const Column& limit) {
  std::size_t worst = 0;
  double most = -1.0;
  for (std::size_t k = 0; k < kLimits; ++k) {
    const double r = load[k] / limit[k];
    if (!(r > most)) continue;
    most = r;
    worst = k;
  }
  const model::LimitRow& row = row_of(model::kSectionLimits[worst]);
  return {.name = std::string(row.name),
          .value = load[worst],
          .limit = limit[worst],
          .unit = std::string(row.unit),
          .at_mm = std::nullopt};
}

/// Plunges that differ in their feed alone: speed and area.
using Plunge = std::pair<double, double>;
Plunge plunge_of(const FeedQuestion& q, const CutSample& s) { return {rpm_on(q, s.move), plunged_mm2(s)}; }

/// Keeps the largest excess, what it is of, and the class it is of. No load known: more than any.
class Worst {
 public:
  explicit Worst(FeedAnswer& a) : a_(a) {}
  void of(const std::optional<State>& s, const Column& limits, const CutClass* kind, Plunge plunge = {}) {
    const double excess = s ? ratio(s->load, limits) - 1.0 : std::numeric_limits<double>::infinity();
    if (!(excess > a_.worst_excess)) return;
    a_.worst_excess = excess;
    class_ = kind;
    plunge_ = plunge;
    if (excess > 0.0)
      a_.worst = s ? worst_limit(s->load, limits) : model::ExceededLimit{"load", 0.0, 0.0, "", std::nullopt};
  }

  /// Where the path first meets what is worst.
  void place(const FeedQuestion& q, const CutterPath& path, CutClasses& classes) {
    if (!(a_.worst_excess > 0.0)) return;
    const auto& feeds = a_.schedule.feed_mm_min;
    for (const CutSample& s : q.samples) {
      if (s.move >= feeds.size() || s.move >= path.size() || !(feeds[s.move] > 0.0)) continue;
      tick();
      bool here = s.plunge && class_ == nullptr && s.ap_mm > 0.0 && plunge_of(q, s) == plunge_;
      const Cuts cuts = cuts_of(s, q.cut);
      for (std::size_t c = 0; c < cuts.n && !s.plunge && class_ != nullptr; ++c) {
        const CutClass& kind = classes.class_of(cuts.cut[c], rpm_on(q, s.move));
        here = here || (&kind == class_ && feeds[s.move] * cuts.cut[c].gain >= kind.most_scheduled);
      }
      if (!here) continue;
      const double length = model::move_length(path, s.move);
      a_.worst.at_mm =
          model::point_on_move(path, s.move, length > 0.0 ? std::min(1.0, s.at_mm / length) : 1.0);
      return;
    }
  }

 private:
  FeedAnswer& a_;
  const CutClass* class_ = nullptr;  // null: a plunge
  Plunge plunge_{};
};

/// Loads of every class of section at the largest feed it is cut with.
void measure_peaks(const FeedQuestion& q, const CutterPath& path, CutClasses& classes, FeedAnswer& a) {
  const model::FeedSchedule& schedule = a.schedule;
  Worst worst(a);
  double removal = 0.0;
  std::map<Plunge, double> plunging;  // largest feed
  for (const CutSample& s : q.samples) {
    if (s.move >= schedule.feed_mm_min.size()) continue;
    const double feed = schedule.feed_mm_min[s.move];
    if (s.plunge) {
      double& most = plunging[plunge_of(q, s)];
      if (s.ap_mm > 0.0) most = std::max(most, feed);
      if (s.ap_mm > 0.0) removal = std::max(removal, feed * plunged_mm2(s));
      continue;
    }
    tick();
    const Cuts cuts = cuts_of(s, q.cut);
    for (std::size_t c = 0; c < cuts.n && feed > 0.0; ++c) {
      CutClass& kind = classes.class_of(cuts.cut[c], rpm_on(q, s.move));
      kind.most_scheduled = std::max(kind.most_scheduled, feed * cuts.cut[c].gain);
      removal = std::max(removal, feed * (s.csa_mm2 > 0.0 ? s.csa_mm2 : s.ap_mm * s.ae_mm));
    }
  }
  classes.each([&](const CutLoads& loads, const CutClass& kind) {
    if (!(kind.most_scheduled > 0.0)) return;
    auto s = kind.ready != nullptr ? loads.at(*kind.ready, kind.most_scheduled)
                                   : loads.at(kind.cut, kind.most_scheduled);
    // An area wider than two cutters lies below the tip, along a ramp or a helix: its edge is no faster.
    // Limits are held with it all the same. Default, unsourced.
    constexpr double kBelowTheTip = 2.0;
    if (s && kind.gain > kBelowTheTip) s->chip_mm /= kind.gain;
    if (s) keep_peak(a.peak, *s, loads, q.cut.cutter);
    worst.of(s, loads.limits(), &kind);
  });
  for (const auto& [plunge, feed] : plunging) {
    if (!(feed > 0.0)) continue;
    const auto& [n, area] = plunge;
    const CutLoads& loads = classes.loads(n);
    const auto s = loads.plunging(area, feed);
    if (s) keep_peak(a.peak, *s, loads, q.cut.cutter);
    worst.of(s, loads.limits(), nullptr, plunge);
  }
  worst.place(q, path, classes);
  a.peak.mrr_mm3_min = removal;
}

/// The end of the first move at feed that goes down: where a drill is in its hole.
std::optional<geometry::Vec3> deepest(const CutterPath& path) {
  for (std::size_t i = 1; i < path.size(); ++i) {
    if (path.kind[i] == MoveKind::kLine && path.z[i] < path.z[i - 1]) return path.point(i);
  }
  return std::nullopt;
}

/// Feeds that are given, and those of drills, reamers and taps.
void as_planned(const FeedQuestion& q, const CutterPath& path, const std::vector<Cap>& caps, FeedAnswer& a) {
  std::vector<double> feed(path.size(), 0.0);
  const auto reach = motion::reach_along(path, q.cut.machine);
  for (std::size_t i = 1; i < path.size(); ++i) {
    feed[i] = caps[i].feed_mm_min;
    if (!q.adapt || feeds_by_pitch(q.cut) || path.kind[i] == MoveKind::kRapid ||
        path.kind[i] == MoveKind::kDwell)
      continue;
    if (reach && (*reach)[i].length_mm > 0.0) feed[i] = std::min(feed[i], (*reach)[i].most_mm_min);
    feed[i] = std::max(std::floor(feed[i] * 10.0 + 1e-6) / 10.0, 0.1);
  }
  if (!feed.empty()) feed[0] = q.feed_mm_min;
  a.schedule = schedule_with(q, path, std::move(feed));
}

}  // namespace

double least_feed_mm_min(const CutQuestion& q, double n_rpm) {
  return least_chip_mm(q) * teeth_of(q) * std::abs(n_rpm);
}

FeedAnswer feeds(const FeedQuestion& q, const CutterPath& path, KnownFeeds* known) {
  FeedAnswer a;
  CutClasses classes(q, known);
  const std::vector<Cap> caps = caps_of(q, path, classes);
  const bool sideways = is_milling(q.cut.kind);
  if (!q.adapt || !sideways) {
    as_planned(q, path, caps, a);
  } else {
    std::vector<double> most(path.size(), 0.0);
    std::vector<FeedBound> by(path.size(), FeedBound::kStepFeed);
    const double one = q.constant ? constant_feed(q, path, classes) : 0.0;
    for (std::size_t i = 1; i < path.size(); ++i) {
      most[i] = caps[i].feed_mm_min;
      by[i] = caps[i].by;
      if (!q.constant || by[i] == FeedBound::kAir) continue;
      const double given = i < q.feed_factor.size() ? q.feed_factor[i] : 1.0;
      const bool own = ends_in(path.role[i]) || by[i] == FeedBound::kEndCut;
      const double all = std::min(1.0, given) * one;
      most[i] = own ? std::min(most[i], all) : all;
    }
    Followed f = followed(q, path, std::move(most), std::move(by), q.cut.machine);
    if (q.explain && !q.constant) a.held_by = held_by(q, path, caps, classes, f);
    if (!f.feed_mm_min.empty()) f.feed_mm_min[0] = q.feed_mm_min;
    a.schedule = schedule_with(q, path, std::move(f.feed_mm_min));
  }
  if (sideways) {
    measure_peaks(q, path, classes, a);
  } else if (const auto l = loads_of(q.cut, 0.0, 0.0, std::abs(q.n_rpm), q.feed_mm_min)) {
    a.peak = *l;
    const WorstLoad worst = worst_load(q.cut, *l, std::abs(q.n_rpm));
    a.worst_excess = worst.excess;
    if (worst.excess > 0.0) a.worst = {worst.name, worst.value, worst.limit, worst.unit, deepest(path)};
  }
  return a;
}

std::optional<double> excess_at(const FeedQuestion& q, const CutSample& s, double feed_mm_min) {
  const CutLoads loads(q.cut, q.feed_mm_min, rpm_on(q, s.move));
  const Cuts cuts = cuts_of(s, q.cut);
  double worst = -1.0;
  for (std::size_t c = 0; c < cuts.n; ++c) {
    const auto state = loads.at(cuts.cut[c], feed_mm_min);
    if (!state) return std::nullopt;
    worst = std::max(worst, ratio(state->load, loads.limits()) - 1.0);
  }
  return worst;
}

}  // namespace capstan::optimise
