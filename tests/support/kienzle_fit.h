#pragma once

#include <algorithm>
#include <cmath>
#include <vector>

#include "planner/ground/base/result.h"
#include "planner/physics/mechanics/force/kienzle.h"

/// Kienzle's law fitted to the tables of tool makers: how near the law is to them.
namespace capstan::testing {

using mechanics::specific_force_n_mm2;
using mechanics::WorkMaterial;

/// One row of a table of specific cutting force.
struct SpecificForcePoint {
  double h_mm = 0.0;
  double kc_n_mm2 = 0.0;
};

struct KienzleFit {
  WorkMaterial work;
  double max_relative_error = 0.0;  ///< largest |fit / table - 1|
};

/// Least squares of log kc over log h.
///
/// Needs     two points of different h, all positive and finite; the argument is what the table's
///           argument is (some tables state feed per tooth, not chip thickness).
/// Fails     MECH-FIT-POINTS.
[[nodiscard]] inline Result<KienzleFit> fit_kienzle(const std::vector<SpecificForcePoint>& points) {
  double mean_x = 0.0;
  double mean_y = 0.0;
  for (const auto& p : points) {
    if (!(std::isfinite(p.h_mm) && p.h_mm > 0.0 && std::isfinite(p.kc_n_mm2) && p.kc_n_mm2 > 0.0)) {
      return fail("MECH-FIT-POINTS", "a point of specific cutting force is not positive and finite");
    }
    mean_x += std::log(p.h_mm);
    mean_y += std::log(p.kc_n_mm2);
  }
  const auto n = static_cast<double>(points.size());
  mean_x /= n;
  mean_y /= n;
  double sxx = 0.0;
  double sxy = 0.0;
  for (const auto& p : points) {
    const double dx = std::log(p.h_mm) - mean_x;
    sxx += dx * dx;
    sxy += dx * (std::log(p.kc_n_mm2) - mean_y);
  }
  if (!(sxx > 0.0)) return fail("MECH-FIT-POINTS", "a Kienzle fit needs two different chip thicknesses");
  const double slope = sxy / sxx;
  KienzleFit fit{.work = {.kc11_n_mm2 = std::exp(mean_y - slope * mean_x), .mc = -slope}};
  for (const auto& p : points) {
    const double ratio = specific_force_n_mm2(fit.work, p.h_mm) / p.kc_n_mm2;
    fit.max_relative_error = std::max(fit.max_relative_error, std::abs(ratio - 1.0));
  }
  return fit;
}

}  // namespace capstan::testing
