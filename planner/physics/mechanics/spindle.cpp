#include "planner/physics/mechanics/spindle.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>

#include "planner/ground/base/number.h"
#include "planner/model/plan/resources/machine.h"

namespace capstan::mechanics {
namespace {

double power_w(double torque_nm, double rpm) { return torque_nm * 2.0 * std::numbers::pi * rpm / 60.0; }
double torque_nm(double power, double rpm) { return power * 60.0 / (2.0 * std::numbers::pi * rpm); }

SpindleCapacity capacity(double power, double torque, double rpm) {
  const double p = std::min(power, power_w(torque, rpm));
  return {p, std::min(torque, torque_nm(p, rpm))};
}

}  // namespace

Result<SpindleCurve> SpindleCurve::make(std::vector<SpindlePoint> points) {
  if (points.empty()) return fail("SPINDLE-CURVE", "the spindle has no (rpm, power, torque) point");
  double last = 0.0;
  for (SpindlePoint& p : points) {
    const std::string where = "at " + (std::isfinite(p.rpm) ? shortest(p.rpm) : "?") + " 1/min";
    if (!(std::isfinite(p.rpm) && p.rpm > last)) {
      return fail("SPINDLE-CURVE", "speeds are not positive and rising " + where);
    }
    if (!(std::isfinite(p.power_w) && std::isfinite(p.torque_nm) && p.power_w >= 0.0 && p.torque_nm >= 0.0 &&
          p.power_w + p.torque_nm > 0.0)) {
      return fail("SPINDLE-CURVE", "neither power nor torque is stated, or one is negative, " + where);
    }
    if (p.power_w == 0.0) p.power_w = power_w(p.torque_nm, p.rpm);
    if (p.torque_nm == 0.0) p.torque_nm = torque_nm(p.power_w, p.rpm);
    last = p.rpm;
  }
  return SpindleCurve(std::move(points));
}

Result<SpindleCapacity> SpindleCurve::at(double rpm) const {
  if (!(rpm >= min_rpm() && rpm <= max_rpm())) {
    return fail(Diagnostic{.code = "SPINDLE-RANGE",
                           .message = "no power is known at " +
                                      (std::isfinite(rpm) ? shortest(rpm) : std::string("?")) + " 1/min",
                           .expected = shortest(min_rpm()) + " to " + shortest(max_rpm()) + " 1/min"});
  }
  const auto above =
      std::find_if(points_.begin(), points_.end(), [&](const SpindlePoint& p) { return p.rpm >= rpm; });
  if (above->rpm == rpm) return capacity(above->power_w, above->torque_nm, rpm);
  const auto below = above - 1;
  const double t = (rpm - below->rpm) / (above->rpm - below->rpm);
  return capacity(below->power_w + t * (above->power_w - below->power_w),
                  below->torque_nm + t * (above->torque_nm - below->torque_nm), rpm);
}

Result<SpindleCurve> curve_of(const model::Spindle& spindle) {
  std::vector<SpindlePoint> points;
  points.reserve(spindle.curve.size());
  for (const model::SpindlePoint& p : spindle.curve) points.push_back({p.rpm, p.power_w, p.torque_nm});
  return SpindleCurve::make(std::move(points));
}

}  // namespace capstan::mechanics
