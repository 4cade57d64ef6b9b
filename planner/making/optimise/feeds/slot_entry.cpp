#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "planner/making/optimise/cut/limits.h"
#include "planner/making/optimise/feeds.h"
#include "planner/physics/mechanics/life/arc_speed.h"

namespace capstan::optimise {

void enter_as_a_slot(FeedQuestion& q, double ae_mm, const model::CutterPath& path) {
  const double faster = speed_by_arc(q.cut, ae_mm);
  const double wide = largest_fz(q.cut) * teeth_of(q.cut) * std::abs(q.n_rpm) / faster;
  const double feed = wide > 0.0 && q.feed_mm_min > 0.0 ? std::min(1.0, wide / q.feed_mm_min) : 1.0;
  std::vector<bool> as_slot(path.size(), false);
  for (std::size_t i = 0; i < path.size(); ++i)
    as_slot[i] = path.role[i] == model::MoveRole::kRamp || path.role[i] == model::MoveRole::kPlunge;
  const double widest = mechanics::kWholeSpeedWidth * q.cut.cutter.cutting_diameter_mm;
  for (const CutSample& s : q.samples) {
    if (s.move < as_slot.size() && s.ap_mm > 0.0 && s.ae_mm >= widest) as_slot[s.move] = true;
  }
  for (std::size_t i = 0; i < path.size(); ++i) {
    if (!as_slot[i] || path.kind[i] == model::MoveKind::kRapid) continue;
    if (i < q.speed_factor.size()) q.speed_factor[i] /= faster;
    if (i < q.feed_factor.size()) q.feed_factor[i] *= feed;
  }
}

namespace {

/// Length of a slot from which it has its own speed, in diameters: on the way over to the next ring the
/// spindle would still be changing. Default, unsourced.
constexpr double kLongSlot = 1.0;
constexpr double kAnySpeed = 1e300;  // 1/min

}  // namespace

void slow_in_deep_slots(FeedQuestion& q) {
  if (q.cut.kind != CutKind::kRough || q.cut.slot) return;
  const double vc = q.cut.vc_table_m_min > 0.0 ? q.cut.vc_table_m_min : q.cut.vc_start_m_min;
  const double table = 1000.0 * vc / (std::numbers::pi * speed_diameter_mm(q.cut));
  if (!(table > 0.0)) return;
  const double d = q.cut.cutter.cutting_diameter_mm;
  std::vector<double> share(q.speed_factor.size(), 1.0), slot_mm(q.speed_factor.size(), 0.0);
  for (const CutSample& s : q.samples) {
    if (s.plunge || s.move >= share.size() || s.exit_rad - s.entry_rad < kSlotArc) continue;
    share[s.move] = std::min(share[s.move], deep_slot_share(s.ap_mm, d));
    slot_mm[s.move] += s.step_mm;
  }
  for (std::size_t i = 0; i < share.size();) {
    double long_mm = 0.0, one = kAnySpeed;
    std::size_t end = i;
    for (; end < share.size() && share[end] < 1.0; ++end) {
      long_mm += slot_mm[end];
      const double most = std::max(share[end] * table, speeds(q.cut).lo);
      one = std::min({one, most, std::abs(q.n_rpm * q.speed_factor[end])});
    }
    for (std::size_t k = i; k < end && long_mm >= kLongSlot * d; ++k) {
      const double now = std::abs(q.n_rpm * q.speed_factor[k]);
      if (now > one) q.speed_factor[k] *= one / now;
    }
    i = std::max(end, i + 1);
  }
}

}  // namespace capstan::optimise
