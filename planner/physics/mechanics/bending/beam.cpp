#include "planner/physics/mechanics/bending/beam.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "planner/physics/mechanics/constants.h"
#include "planner/physics/mechanics/force/domain.h"

namespace capstan::mechanics {
namespace {

constexpr double kPi = std::numbers::pi;
constexpr double kReach = 1e-6;  // rad: an arc this close to the wall reaches it
// Gauss-Legendre on -1 .. 1.
constexpr std::array<double, 6> kNode = {-0.9324695142031521, -0.6612093864662645, -0.2386191860831969,
                                         0.2386191860831969,  0.6612093864662645,  0.9324695142031521};
constexpr std::array<double, 6> kWeight = {0.1713244923791704, 0.3607615730481386, 0.4679139345726910,
                                           0.4679139345726910, 0.3607615730481386, 0.1713244923791704};

double stiffness_nmm2(const BeamSegment& s) {
  const double d2 = s.diameter_mm * s.diameter_mm;
  return s.youngs_modulus_n_mm2 * kPi * d2 * d2 / 64.0;
}

/// Adds what of from..to lies above what there is.
void add(ToolBeam& beam, double& top, double to, double diameter, double modulus) {
  if (!(to > top) || !(diameter > 0.0)) return;
  beam.segments.push_back({to - top, diameter, modulus});
  top = to;
}

double modulus_of(model::Substrate s) {
  return s == model::Substrate::kCarbide ? kCarbideYoungsModulusNMm2 : kHssYoungsModulusNMm2;
}

/// Tangential, radial and axial force of one edge per height, in the plane's normal direction (y).
double force_y(const Tooth& t, const ForceLaw& law, double fz, double angle, double height) {
  const double full = 0.5 * t.cutting_diameter_mm;
  const double corner = std::min(t.corner_radius_mm, full);
  double sin_kappa = std::cos(t.lead_angle_rad + t.taper_angle_rad);
  double cos_kappa = std::sin(t.lead_angle_rad + t.taper_angle_rad);
  if (height < corner) {
    cos_kappa = 1.0 - height / corner;
    sin_kappa = std::sqrt(std::max(1e-12, 1.0 - cos_kappa * cos_kappa));
  }
  const double chip = std::max(0.0, fz * std::sin(angle));
  double ft = 0.0, fr = 0.0, fa = 0.0;
  if (law.mechanistic) {
    const CuttingCoefficients& k = *law.mechanistic;
    ft = k.ktc_n_mm2 * chip + k.kte_n_mm / sin_kappa;
    fr = k.krc_n_mm2 * chip + k.kre_n_mm / sin_kappa;
    fa = k.kac_n_mm2 * chip + k.kae_n_mm / sin_kappa;
  } else if (chip > 0.0) {
    ft = specific_force_n_mm2(law.kienzle, chip * sin_kappa) * chip;
    fr = kRadialToTangentialRatio * ft;
    fa = kAxialToTangentialRatio * std::tan(t.helix_rad) * ft;
  }
  return ft * std::sin(angle) - (fr * sin_kappa + fa * cos_kappa) * std::cos(angle);
}

}  // namespace

Result<ToolBeam> beam_of(const model::Cutter& c) {
  if (auto ok = check_positive({{"cutting_diameter_mm", c.cutting_diameter_mm}}); !ok)
    return fail(ok.error());
  ToolBeam beam;
  const double modulus = modulus_of(c.substrate);
  const double d = c.cutting_diameter_mm;
  const double out = c.stick_out_mm > 0.0 ? c.stick_out_mm : std::max(c.usable_length_mm, 3.0 * d);
  const double shank = c.shank_diameter_mm > 0.0 ? c.shank_diameter_mm : d;
  const double flutes = c.maximum_depth_of_cut_mm > 0.0 ? std::min(c.maximum_depth_of_cut_mm, out) : out;
  double top = 0.0;
  // A taper's middle: thinner below, where little bends, thicker above.
  const double lean = flutes * std::tan(model::flank_lean_rad(c));
  add(beam, top, flutes, kFluteEquivalentDiameterRatio * (d + lean), modulus);
  if (c.neck_diameter_mm > 0.0) add(beam, top, std::min(c.neck_length_mm, out), c.neck_diameter_mm, modulus);
  add(beam, top, out, shank, modulus);
  for (const model::HolderSegment& h : c.holder) {
    const double diameter = std::min(h.lower_diameter_mm, h.upper_diameter_mm);
    if (h.height_mm > 0.0 && diameter > 0.0)
      beam.segments.push_back({h.height_mm, diameter, kHolderYoungsModulusNMm2});
  }
  return beam;
}

Result<double> tip_compliance_mm_n(const model::Cutter& cutter) {
  return beam_of(cutter).map([](const ToolBeam& beam) { return bending_mm_n(beam, 0.0, 0.0); });
}

Result<double> enduring_bend_mm(const model::Cutter& cutter, double force_mm) {
  const double out =
      cutter.stick_out_mm > 0.0 ? cutter.stick_out_mm : std::numeric_limits<double>::infinity();
  const double endurance =
      cutter.substrate == model::Substrate::kCarbide ? kCarbideEnduranceNMm2 : kHssEnduranceNMm2;
  return beam_of(cutter).map([&](const ToolBeam& beam) {
    double stress_per_n = 0.0;
    double top = 0.0;
    // The first segment is that of the flutes.
    double fibre = 0.5 / kFluteEquivalentDiameterRatio;
    for (std::size_t i = 0; i + cutter.holder.size() < beam.segments.size(); ++i) {
      const BeamSegment& s = beam.segments[i];
      top += s.length_mm;
      if (top > out + 1e-9) break;
      const double moment = std::max(0.0, top - force_mm) * fibre * s.diameter_mm;
      stress_per_n = std::max(stress_per_n, moment * s.youngs_modulus_n_mm2 / stiffness_nmm2(s));
      fibre = 0.5;
    }
    const double compliance = bending_mm_n(beam, force_mm, 0.0);
    return stress_per_n > 0.0 ? endurance * compliance / stress_per_n
                              : std::numeric_limits<double>::infinity();
  });
}

double bending_mm_n(const ToolBeam& beam, double force_mm, double seen_mm) {
  const double low = std::max({force_mm, seen_mm, 0.0});
  double from = 0.0;
  double sum = 0.0;
  for (const BeamSegment& s : beam.segments) {
    const double to = from + s.length_mm;
    const double start = std::max(from, low);
    if (start < to) {
      // Antiderivative of (x - a)(x - b) about the middle: exact, without cancellation.
      const double middle = 0.5 * (start + to);
      const double half = 0.5 * (to - start);
      sum += 2.0 * half * ((middle - force_mm) * (middle - seen_mm) + half * half / 3.0) / stiffness_nmm2(s);
    }
    from = to;
  }
  return sum;
}

double WallError::largest_mm() const { return most_left_mm >= -most_over_mm ? most_left_mm : most_over_mm; }

namespace {

struct Edge {
  const Section& section;
  const Tooth& tooth;
  const ForceLaw& law;
  const ToolBeam& beam;
  double fz = 0.0, wall = 0.0, lag = 0.0;  // lag per height
};

/// Bending at a height above the lower end of contact while an edge at that height is at the wall.
double bend_at(const Edge& e, double above) {
  constexpr double kStraight = 1e-9;
  const double seen = e.section.from_tip_mm + above;
  const double pitch = 2.0 * kPi / e.tooth.teeth;
  const double entry = e.section.arc.entry_rad - kReach;
  const double exit = e.section.arc.exit_rad + kReach;
  const double ap = e.section.ap_mm;
  const auto integral = [&](double low, double high, double turned) {
    double sum = 0.0;
    for (std::size_t i = 0; i < kNode.size(); ++i) {
      const double at = 0.5 * (low + high) + 0.5 * (high - low) * kNode[i];
      const double angle = turned + e.lag * (above - at);
      const double place = e.section.from_tip_mm + at;
      sum += 0.5 * (high - low) * kWeight[i] * force_y(e.tooth, e.law, e.fz, angle, place) *
             bending_mm_n(e.beam, place, seen);
    }
    return sum;
  };
  double bend = 0.0;
  // Teeth at wall + k pitch + lag (above - z): those whose edge is in the arc somewhere along the contact.
  const double reach = std::abs(e.lag) * ap;
  const auto first = static_cast<int>(std::floor((entry - e.wall - reach) / pitch));
  const auto last = static_cast<int>(std::ceil((exit - e.wall + reach) / pitch));
  for (int k = first; k <= last; ++k) {
    const double turned = e.wall + pitch * k;
    if (std::abs(e.lag) * ap < kStraight) {
      if (turned >= entry && turned <= exit) bend += integral(0.0, ap, turned);
      continue;
    }
    const double at_exit = above - (exit - turned) / e.lag;
    const double at_entry = above - (entry - turned) / e.lag;
    const double low = std::max(0.0, std::min(at_exit, at_entry));
    const double high = std::min(ap, std::max(at_exit, at_entry));
    if (low < high) bend += integral(low, high, turned);
  }
  return bend;
}

}  // namespace

Result<WallError> wall_error(const Section& section, const Tooth& tooth, const ForceLaw& law, double fz_mm,
                             WallSide side, const ToolBeam& beam) {
  if (auto ok = check_positive({{"fz_mm", fz_mm}}); !ok) return fail(ok.error());
  if (auto ok = check_shape(section, tooth, law); !ok) return fail(ok.error());
  WallError out;
  if (!(section.ap_mm > 0.0)) return out;
  const double wall = side == WallSide::kLeft ? 0.0 : kPi;
  if (section.arc.entry_rad > wall + kReach || section.arc.exit_rad < wall - kReach)
    return fail(Diagnostic{.code = "MECH-DOMAIN",
                           .message = "the arc does not reach the wall",
                           .path = "arc",
                           .expected = side == WallSide::kLeft ? "entry at 0" : "exit at pi"});
  const Edge edge{
      section, tooth, law, beam, fz_mm, wall, helix_lag_rad(1.0, tooth.cutting_diameter_mm, tooth.helix_rad)};
  // Towards the wall is +y on the left and -y on the right; material is left when the tool gives way from it.
  const double away = side == WallSide::kLeft ? -1.0 : 1.0;
  for (std::size_t i = 0; i < WallError::kHeights; ++i) {
    const double above =
        section.ap_mm * static_cast<double>(i) / static_cast<double>(WallError::kHeights - 1);
    out.height_mm[i] = section.from_tip_mm + above;
    out.error_mm[i] = away * bend_at(edge, above);
    out.most_left_mm = std::max(out.most_left_mm, out.error_mm[i]);
    out.most_over_mm = std::min(out.most_over_mm, out.error_mm[i]);
  }
  return out;
}

}  // namespace capstan::mechanics
