#include <algorithm>
#include <cmath>
#include <string>

#include "planner/physics/mechanics/force/domain.h"
#include "planner/physics/mechanics/loads/section.h"

namespace capstan::mechanics {

Result<FeedWithin> feed_within(const Section& section, const Tooth& tooth, const ForceLaw& law,
                               const LoadLimits& limits, double n_rpm, double least_fz_mm,
                               double most_fz_mm) {
  if (auto ok = check_range({"least_fz_mm", least_fz_mm}, 0.0, most_fz_mm); !ok) return fail(ok.error());
  for (const Named& v : {Named{"peak_force_n", limits.peak_force_n}, Named{"torque_nm", limits.torque_nm},
                         Named{"peak_torque_nm", limits.peak_torque_nm}, Named{"power_w", limits.power_w},
                         Named{"h_max_mm", limits.h_max_mm}})
    if (!(v.value > 0.0))
      return fail(Diagnostic{
          .code = "MECH-DOMAIN", .message = std::string(v.name) + " is not a limit", .path = v.name});

  struct Use {
    double share = 0.0;
    LoadKind kind = LoadKind::kNone;
  };
  const auto use = [&](double fz) -> Result<Use> {
    const auto loads = section_loads(section, tooth, law, fz, n_rpm);
    if (!loads) return fail(loads.error());
    Use u;
    for (const Use& one : {Use{loads->peak_force_n / limits.peak_force_n, LoadKind::kForce},
                           Use{loads->torque_nm / limits.torque_nm, LoadKind::kTorque},
                           Use{loads->peak_torque_nm / limits.peak_torque_nm, LoadKind::kPeakTorque},
                           Use{loads->power_w / limits.power_w, LoadKind::kPower},
                           Use{loads->h_max_mm / limits.h_max_mm, LoadKind::kChip}})
      if (one.share > u.share) u = one;
    return u;
  };
  const auto top = use(most_fz_mm);
  if (!top) return fail(top.error());
  if (top->share <= 1.0) return FeedWithin{most_fz_mm, LoadKind::kNone};
  // From below the root in the logarithms: a law fz^k is met in one step, and every guess that keeps the
  // limits is a lower bound.
  double high = most_fz_mm, high_share = top->share;
  double low = std::max(least_fz_mm, 1e-6 * most_fz_mm);
  auto at_low = use(low);
  if (!at_low) return fail(at_low.error());
  if (at_low->share > 1.0) return FeedWithin{0.0, at_low->kind};
  double low_share = at_low->share;
  LoadKind kind = top->kind;
  constexpr int kMostSteps = 60;
  constexpr double kClose = 1e-3;
  for (int i = 0; i < kMostSteps && high / low > 1.0 + kClose && low_share < 1.0 - kClose; ++i) {
    double guess = std::sqrt(low * high);
    if (i % 3 != 2 && low_share > 0.0) {
      const double slope = std::log(high_share / low_share) / std::log(high / low);
      guess = low * std::pow((1.0 - 0.5 * kClose) / low_share, 1.0 / slope);
      guess = std::clamp(guess, low * (1.0 + 1e-9), high * (1.0 - 1e-9));
    }
    const auto u = use(guess);
    if (!u) return fail(u.error());
    (u->share <= 1.0 ? low : high) = guess;
    (u->share <= 1.0 ? low_share : high_share) = u->share;
    kind = u->kind;
  }
  return FeedWithin{low, kind};
}

}  // namespace capstan::mechanics
