#include "planner/optimise/feeds.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <vector>

#include "planner/base/number.h"

namespace capstan::optimise {
namespace {

constexpr int kMostSteps = 30;     // 0.9^30 = 4 %: below, a feed is no cut any more
constexpr double kSection = 0.01;  // sections are compared on a grid of this size, mm

/// The worst section of one move, on a grid so that equal cuts are computed once.
struct Section {
  long ap = 0, ae = 0;
  bool plunge = false;
  friend auto operator<=>(const Section&, const Section&) = default;
};

long up(double v) { return static_cast<long>(std::ceil(v / kSection - 1e-6)); }

class Scheduler {
 public:
  explicit Scheduler(const FeedQuestion& q) : q_(q) {}

  /// Steps down from full feed that the section needs; loads at that feed go into the peak.
  int steps_for(const Section& s, double base_factor) {
    const auto key = std::pair{s, base_factor};
    if (const auto it = known_.find(key); it != known_.end()) return it->second;
    int k = 0;
    for (; k < kMostSteps; ++k) {
      const auto l = loads(s, base_factor * std::pow(kFeedStep, k));
      if (l && worst_excess(q_.cut, *l, std::abs(q_.n_rpm)) <= 1e-6)
        break;  // unknown loads are not safe ones
    }
    known_.emplace(key, k);
    return k;
  }

  [[nodiscard]] std::optional<model::StepLoads> loads(const Section& s, double factor) const {
    if (s.ap <= 0 || s.ae <= 0) return std::nullopt;
    const double ap = static_cast<double>(s.ap) * kSection;
    const double ae = std::min(static_cast<double>(s.ae) * kSection, q_.cut.cutter.cutting_diameter_mm);
    return loads_of(q_.cut, ap, ae, std::abs(q_.n_rpm), q_.feed_mm_min * factor);
  }

 private:
  const FeedQuestion& q_;
  std::map<std::pair<Section, double>, int> known_;
};

double role_factor(const FeedQuestion& q, const model::CutterPath& path, std::size_t i) {
  if (!q.adapt || q.cut.kind == CutKind::kDrill || q.cut.kind == CutKind::kReam ||
      q.cut.kind == CutKind::kTap)
    return 1.0;
  if (path.role[i] == model::MoveRole::kPlunge) return kPlungeFraction;
  if (path.role[i] == model::MoveRole::kRamp) return kRampFraction;
  return 1.0;
}

/// What the axis across the others allows on a move that goes down or up; arcs by their chord, which is
/// shorter.
double steepest_feed(const FeedQuestion& q, const model::CutterPath& path, std::size_t i) {
  const double dz = std::abs(path.z[i] - path.z[i - 1]);
  const double most = q.cut.machine.axes[2].feed_max_mm_min;
  if (!(dz > 0.0) || !(most > 0.0)) return std::numeric_limits<double>::infinity();
  return most * std::hypot(path.x[i] - path.x[i - 1], path.y[i] - path.y[i - 1], dz) / dz;
}

void keep_peak(model::StepLoads& peak, const model::StepLoads& l) {
  peak.peak_force_n = std::max(peak.peak_force_n, l.peak_force_n);
  peak.torque_nm = std::max(peak.torque_nm, l.torque_nm);
  peak.power_w = std::max(peak.power_w, l.power_w);
  peak.deflection_mm = std::max(peak.deflection_mm, l.deflection_mm);
  peak.chip_thickness_mm = std::max(peak.chip_thickness_mm, l.chip_thickness_mm);
  peak.mrr_mm3_min = std::max(peak.mrr_mm3_min, l.mrr_mm3_min);
}

}  // namespace

FeedAnswer feeds(const FeedQuestion& q, const model::CutterPath& path) {
  FeedAnswer a;
  const std::size_t n = path.size();
  a.schedule.feed_mm_min.assign(n, 0.0);
  a.schedule.spindle_rpm.assign(n, q.n_rpm);
  a.schedule.dwell_s.assign(n, 0.0);
  Scheduler scheduler(q);
  const bool side_cut = q.cut.kind == CutKind::kRough || q.cut.kind == CutKind::kFinish;
  std::size_t next = 0;
  bool slowed = false;
  std::vector<Section> sections;  // of one move, each once
  for (std::size_t i = 0; i < n; ++i) {
    const double given = i < q.feed_factor.size() ? q.feed_factor[i] : 1.0;
    double factor = given * role_factor(q, path, i);
    // Each sample is judged by itself: the deepest and the widest cut of a move need not be the same.
    sections.clear();
    bool in_air = true;
    for (; next < q.samples.size() && q.samples[next].move <= i; ++next) {
      const CutSample& s = q.samples[next];
      if (s.move != i) continue;
      const Section section{up(s.ap_mm), up(s.ae_mm), s.plunge};
      in_air = in_air && section.ap <= 0;
      if (section.ap > 0 && !s.plunge) sections.push_back(section);
    }
    if (side_cut) {
      std::sort(sections.begin(), sections.end());
      sections.erase(std::unique(sections.begin(), sections.end()), sections.end());
      int steps = 0;
      for (const Section& s : sections) {
        if (q.adapt) steps = std::max(steps, scheduler.steps_for(s, factor));
      }
      slowed = slowed || steps > 0;
      factor *= std::pow(kFeedStep, steps);
      for (const Section& s : sections) {
        const auto l = scheduler.loads(s, factor);
        if (!l) continue;
        keep_peak(a.peak, *l);
        a.worst_excess = std::max(a.worst_excess, worst_excess(q.cut, *l, std::abs(q.n_rpm)));
      }
    }
    double feed = q.feed_mm_min * factor;
    if (q.adapt && q.cut.kind != CutKind::kTap && i > 0) feed = std::min(feed, steepest_feed(q, path, i));
    if (q.adapt && q.cut.kind != CutKind::kTap)
      feed = std::max(rounded(std::floor(feed * 10.0 + 1e-6) / 10.0, 1), 0.1);
    const bool air = path.role[i] == model::MoveRole::kApproach || path.role[i] == model::MoveRole::kLink;
    if (q.adapt && air && in_air) {
      const auto& axes = q.cut.machine.axes;
      const double most =
          std::min({axes[0].feed_max_mm_min, axes[1].feed_max_mm_min, axes[2].feed_max_mm_min});
      feed = std::max(feed, std::min(most, kAirFeedMmMin));
    }
    a.schedule.feed_mm_min[i] = path.kind[i] == model::MoveKind::kRapid ? 0.0 : feed;
    if (i < q.speed_factor.size()) a.schedule.spindle_rpm[i] = q.n_rpm * q.speed_factor[i];
    if (i < q.dwell_s.size()) a.schedule.dwell_s[i] = q.dwell_s[i];
  }
  if (!side_cut) {
    if (const auto l = loads_of(q.cut, 0.0, 0.0, std::abs(q.n_rpm), q.feed_mm_min)) {
      a.peak = *l;
      a.worst_excess = worst_excess(q.cut, *l, std::abs(q.n_rpm));
    }
  }
  if (slowed) a.slowed.emplace_back("section: power, torque, deflection or chip thickness");
  return a;
}

}  // namespace capstan::optimise
