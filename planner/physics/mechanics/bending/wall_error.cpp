#include "planner/physics/mechanics/bending/wall_error.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "planner/physics/mechanics/constants.h"
#include "planner/physics/mechanics/force/domain.h"

// At each height of the wall the tool's bending is the integral, over all teeth and along each edge within the
// arc, of the force per height times the beam's compliance between that height and the wall's.
//
// The feed stands outside of these integrals. By Kienzle's law the chip h = fz sin(phi) gives a force per height
// of kc1.1 (h sin(kappa))^-mc h, which is fz^(1 - mc) times what it is at fz = 1 mm. By measured coefficients it
// is a part by the edge alone and one that grows as fz. So each height has two numbers, and an error at another
// feed costs one power.
// Source  Kline, DeVor & Shareef 1982, see the header; Gauss-Legendre: Abramowitz and Stegun, table 25.4.

namespace capstan::mechanics {
namespace {

constexpr double kPi = std::numbers::pi;
constexpr double kReach = 1e-6;  // rad: an arc this close to the wall reaches it
// Gauss-Legendre on -1 .. 1.
constexpr std::array<double, 6> kNode = {-0.9324695142031521, -0.6612093864662645, -0.2386191860831969,
                                         0.2386191860831969,  0.6612093864662645,  0.9324695142031521};
constexpr std::array<double, 6> kWeight = {0.1713244923791704, 0.3607615730481386, 0.4679139345726910,
                                           0.4679139345726910, 0.3607615730481386, 0.1713244923791704};

/// What does not change with the feed, and what grows with it; of forces per height, N/mm, or of bendings, mm.
struct ByFeed {
  double fixed = 0.0, growing = 0.0;
};

struct Edge {
  const Section& section;
  const Tooth& tooth;
  const ForceLaw& law;
  const ToolBeam& beam;
  double wall = 0.0, lag = 0.0;                          // lag per height
  double sin_kappa = 1.0, cos_kappa = 0.0, axial = 0.0;  // of the flank; axial: force over the tangential one
};

/// Of one edge, in the plane's normal direction (y), at an angle and a height above the tip.
ByFeed force_y(const Edge& e, double angle, double height) {
  const double corner = std::min(e.tooth.corner_radius_mm, 0.5 * e.tooth.cutting_diameter_mm);
  double sin_kappa = e.sin_kappa;
  double cos_kappa = e.cos_kappa;
  if (height < corner) {
    cos_kappa = 1.0 - height / corner;
    sin_kappa = std::sqrt(std::max(1e-12, 1.0 - cos_kappa * cos_kappa));
  }
  const double sin = std::sin(angle);
  const double cos = std::cos(angle);
  const double chip = std::max(0.0, sin);  // over the feed per tooth
  const auto normal = [&](double ft, double fr, double fa) {
    return ft * sin - (fr * sin_kappa + fa * cos_kappa) * cos;
  };
  if (e.law.mechanistic) {
    const CuttingCoefficients& k = *e.law.mechanistic;
    return {normal(k.kte_n_mm / sin_kappa, k.kre_n_mm / sin_kappa, k.kae_n_mm / sin_kappa),
            chip * normal(k.ktc_n_mm2, k.krc_n_mm2, k.kac_n_mm2)};
  }
  if (!(chip > 0.0)) return {};
  const double ft = specific_force_n_mm2(e.law.kienzle, chip * sin_kappa) * chip;
  return {0.0, normal(ft, kRadialToTangentialRatio * ft, e.axial * ft)};
}

/// Bending at a height above the lower end of contact while an edge at that height is at the wall.
ByFeed bend_at(const Edge& e, double above) {
  constexpr double kStraight = 1e-9;
  const double seen = e.section.from_tip_mm + above;
  const double pitch = 2.0 * kPi / e.tooth.teeth;
  const double entry = e.section.arc.entry_rad - kReach;
  const double exit = e.section.arc.exit_rad + kReach;
  const double ap = e.section.ap_mm;
  ByFeed bend;
  const auto integrate = [&](double low, double high, double turned) {
    for (std::size_t i = 0; i < kNode.size(); ++i) {
      const double at = 0.5 * (low + high) + 0.5 * (high - low) * kNode[i];
      const double angle = turned + e.lag * (above - at);
      const double place = e.section.from_tip_mm + at;
      const ByFeed force = force_y(e, angle, place);
      const double by = 0.5 * (high - low) * kWeight[i] * bending_mm_n(e.beam, place, seen);
      bend.fixed += by * force.fixed;
      bend.growing += by * force.growing;
    }
  };
  // Teeth at wall + k pitch + lag (above - z): those whose edge is in the arc somewhere along the contact.
  const double reach = std::abs(e.lag) * ap;
  const auto first = static_cast<int>(std::floor((entry - e.wall - reach) / pitch));
  const auto last = static_cast<int>(std::ceil((exit - e.wall + reach) / pitch));
  for (int k = first; k <= last; ++k) {
    const double turned = e.wall + pitch * k;
    if (std::abs(e.lag) * ap < kStraight) {
      if (turned >= entry && turned <= exit) integrate(0.0, ap, turned);
      continue;
    }
    const double at_exit = above - (exit - turned) / e.lag;
    const double at_entry = above - (entry - turned) / e.lag;
    const double low = std::max(0.0, std::min(at_exit, at_entry));
    const double high = std::min(ap, std::max(at_exit, at_entry));
    if (low < high) integrate(low, high, turned);
  }
  return bend;
}

}  // namespace

double WallError::largest_mm() const { return most_left_mm >= -most_over_mm ? most_left_mm : most_over_mm; }

Result<WallAtFeeds> WallAtFeeds::of(const Section& section, const Tooth& tooth, const ForceLaw& law,
                                    WallSide side, const ToolBeam& beam) {
  if (auto ok = check_shape(section, tooth, law); !ok) return fail(ok.error());
  WallAtFeeds out;
  if (!(section.ap_mm > 0.0)) return out;
  const double wall = side == WallSide::kLeft ? 0.0 : kPi;
  if (section.arc.entry_rad > wall + kReach || section.arc.exit_rad < wall - kReach)
    return fail(Diagnostic{.code = "MECH-DOMAIN",
                           .message = "the arc does not reach the wall",
                           .path = "arc",
                           .expected = side == WallSide::kLeft ? "entry at 0" : "exit at pi"});
  const double lead = tooth.lead_angle_rad + tooth.taper_angle_rad;
  const Edge edge{.section = section,
                  .tooth = tooth,
                  .law = law,
                  .beam = beam,
                  .wall = wall,
                  .lag = helix_lag_rad(1.0, tooth.cutting_diameter_mm, tooth.helix_rad),
                  .sin_kappa = std::cos(lead),
                  .cos_kappa = std::sin(lead),
                  .axial = kAxialToTangentialRatio * std::tan(tooth.helix_rad)};
  if (!law.mechanistic) out.exponent_ = 1.0 - law.kienzle.mc;
  // Towards the wall is +y on the left and -y on the right; material is left when the tool gives way from it.
  const double away = side == WallSide::kLeft ? -1.0 : 1.0;
  for (std::size_t i = 0; i < WallError::kHeights; ++i) {
    const double above =
        section.ap_mm * static_cast<double>(i) / static_cast<double>(WallError::kHeights - 1);
    const ByFeed bend = bend_at(edge, above);
    out.height_mm_[i] = section.from_tip_mm + above;
    out.at_no_feed_mm_[i] = away * bend.fixed;
    out.growing_mm_[i] = away * bend.growing;
  }
  return out;
}

Result<WallError> WallAtFeeds::at(double fz_mm) const {
  if (auto ok = check_positive({{"fz_mm", fz_mm}}); !ok) return fail(ok.error());
  WallError out;
  const double by = exponent_ == 1.0 ? fz_mm : std::pow(fz_mm, exponent_);
  out.height_mm = height_mm_;
  for (std::size_t i = 0; i < WallError::kHeights; ++i) {
    out.error_mm[i] = at_no_feed_mm_[i] + by * growing_mm_[i];
    out.most_left_mm = std::max(out.most_left_mm, out.error_mm[i]);
    out.most_over_mm = std::min(out.most_over_mm, out.error_mm[i]);
  }
  return out;
}

}  // namespace capstan::mechanics
