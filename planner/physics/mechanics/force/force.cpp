#include "planner/physics/mechanics/force/force.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>

namespace capstan::mechanics {
namespace {

constexpr double kPi = std::numbers::pi;
constexpr double kNoLagRad = 1e-6;  // below, a helix is straight to within rounding

struct Plane {
  double x = 0.0;
  double y = 0.0;
};

/// Largest resultant over one tooth pitch. `per_tooth(from, to)` is the integral of the force per unit of
/// depth over the angles from..to of an edge, divided by lag; `at(angle)` the force per unit of depth.
template <class Integral, class At>
double peak_per_depth(int teeth, double lag, const ImmersionArc& arc, int samples, const Integral& integral,
                      const At& at) {
  const double pitch = 2.0 * kPi / teeth;
  const bool straight = lag < kNoLagRad;
  const auto resultant = [&](double tip) {
    Plane sum;
    // Tips whose edge reaches into the arc: entry .. exit + lag (past a turn, for a long helix).
    double angle = tip - pitch * std::floor((tip - arc.entry_rad) / pitch);
    for (; angle <= arc.exit_rad + lag; angle += pitch) {
      if (straight) {
        const Plane f = at(angle);
        sum.x += f.x;
        sum.y += f.y;
        continue;
      }
      const double from = std::max(arc.entry_rad, angle - lag);
      const double to = std::min(arc.exit_rad, angle);
      if (from >= to) continue;
      const Plane f = integral(from, to);
      sum.x += f.x / lag;
      sum.y += f.y / lag;
    }
    return std::hypot(sum.x, sum.y);
  };
  double peak = 0.0;
  for (int i = 0; i < samples; ++i) {
    peak = std::max(peak, resultant(arc.entry_rad + pitch * i / samples));
  }
  // Extremes also sit where a tooth enters or leaves; just inside, so that rounding cannot lose the tooth.
  for (const double corner : {arc.exit_rad, arc.entry_rad + lag, arc.exit_rad + lag}) {
    peak = std::max({peak, resultant(corner), resultant(corner - 1e-9)});
  }
  return peak;
}

}  // namespace

ForceVector mean_milling_force(const CuttingCoefficients& k, int teeth, double ap_mm, double fz_mm,
                               const ImmersionArc& arc) {
  const double chip = teeth * ap_mm * fz_mm / (8.0 * kPi);
  const double edge = teeth * ap_mm / (2.0 * kPi);
  const auto primitive = [&](double p) {
    const double sin2 = std::sin(2.0 * p);
    const double cos2 = std::cos(2.0 * p);
    return ForceVector{chip * (k.ktc_n_mm2 * cos2 - k.krc_n_mm2 * (2.0 * p - sin2)) +
                           edge * (-k.kte_n_mm * std::sin(p) + k.kre_n_mm * std::cos(p)),
                       chip * (k.ktc_n_mm2 * (2.0 * p - sin2) + k.krc_n_mm2 * cos2) -
                           edge * (k.kte_n_mm * std::cos(p) + k.kre_n_mm * std::sin(p)),
                       edge * (-k.kac_n_mm2 * fz_mm * std::cos(p) + k.kae_n_mm * p)};
  };
  const ForceVector a = primitive(arc.entry_rad);
  const ForceVector b = primitive(arc.exit_rad);
  return {b.fx_n - a.fx_n, b.fy_n - a.fy_n, b.fz_n - a.fz_n};
}

double peak_milling_force_n(const CuttingCoefficients& k, int teeth, double ap_mm, double fz_mm,
                            double diameter_mm, double helix_rad, const ImmersionArc& arc) {
  const auto at = [&](double a) {
    const double h = fz_mm * std::sin(a);
    const double ft = k.ktc_n_mm2 * h + k.kte_n_mm;
    const double fr = k.krc_n_mm2 * h + k.kre_n_mm;
    return Plane{-ft * std::cos(a) - fr * std::sin(a), ft * std::sin(a) - fr * std::cos(a)};
  };
  const auto primitive = [&](double a) {
    const double half_sin2 = 0.5 * std::sin(a) * std::sin(a);
    const double area = 0.5 * a - 0.25 * std::sin(2.0 * a);
    return Plane{-fz_mm * (k.ktc_n_mm2 * half_sin2 + k.krc_n_mm2 * area) - k.kte_n_mm * std::sin(a) +
                     k.kre_n_mm * std::cos(a),
                 fz_mm * (k.ktc_n_mm2 * area - k.krc_n_mm2 * half_sin2) - k.kte_n_mm * std::cos(a) -
                     k.kre_n_mm * std::sin(a)};
  };
  const auto integral = [&](double from, double to) {
    const Plane a = primitive(from);
    const Plane b = primitive(to);
    return Plane{b.x - a.x, b.y - a.y};
  };
  const double lag = helix_lag_rad(ap_mm, diameter_mm, helix_rad);
  return ap_mm * peak_per_depth(teeth, lag, arc, 1024, integral, at);
}

double peak_kienzle_force_n(const WorkMaterial& work, double radial_ratio, int teeth, double ap_mm,
                            double fz_mm, double diameter_mm, double helix_rad, double sin_kappa,
                            const ImmersionArc& arc) {
  constexpr std::size_t kCells = 128;
  const double exponent = 1.0 - work.mc;
  const auto at = [&](double a) {
    const double ft = std::pow(std::max(std::sin(a), 0.0), exponent);
    const double fr = radial_ratio * ft;
    return Plane{-ft * std::cos(a) - fr * std::sin(a), ft * std::sin(a) - fr * std::cos(a)};
  };
  // Force on a grid over the arc, linear between, so that its running integral is quadratic between: as the
  // lag goes to nothing, its mean goes to the force, without a jump.
  const double step = (arc.exit_rad - arc.entry_rad) / static_cast<double>(kCells);
  std::array<Plane, kCells + 1> force;
  std::array<Plane, kCells + 1> running;
  force[0] = at(arc.entry_rad);
  running[0] = {};
  for (std::size_t i = 1; i <= kCells; ++i) {
    force[i] = at(arc.entry_rad + step * static_cast<double>(i));
    running[i] = {running[i - 1].x + 0.5 * step * (force[i - 1].x + force[i].x),
                  running[i - 1].y + 0.5 * step * (force[i - 1].y + force[i].y)};
  }
  const auto upto = [&](double a) {
    const double s = std::clamp((a - arc.entry_rad) / step, 0.0, static_cast<double>(kCells));
    const std::size_t i = std::min(static_cast<std::size_t>(s), kCells - 1);
    const double t = s - static_cast<double>(i);
    const double late = 0.5 * t * t;
    const double early = t - late;
    return Plane{running[i].x + step * (early * force[i].x + late * force[i + 1].x),
                 running[i].y + step * (early * force[i].y + late * force[i + 1].y)};
  };
  const auto integral = [&](double from, double to) {
    const Plane a = upto(from);
    const Plane b = upto(to);
    return Plane{b.x - a.x, b.y - a.y};
  };
  const double lag = helix_lag_rad(ap_mm, diameter_mm, helix_rad);
  const double per_depth = peak_per_depth(teeth, lag, arc, 180, integral, at);
  return work.kc11_n_mm2 * std::pow(fz_mm * sin_kappa, -work.mc) * fz_mm * ap_mm * per_depth;
}

}  // namespace capstan::mechanics
