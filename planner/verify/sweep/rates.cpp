#include <algorithm>
#include <cmath>
#include <numbers>

#include "planner/mechanics/constants.h"
#include "planner/verify/sweep/step_checks.h"

namespace capstan::verify {

using geometry::Vec2;
using model::CutterClass;

namespace {

constexpr double kMeasured = 1.1;   ///< by which a rate measured on cells may be too large
constexpr double kTouchMm3 = 1e-6;  ///< less than this is not a cut
constexpr double kWritten = 0.005;  ///< by which feed and speed may be off through their decimals

/// How far the outermost point of the edge goes: on an arc farther than the centre. A volume divided by it is
/// the least width that can have been cut, whichever side of the arc it lies on.
double edge_length(const Move& m, double radius_mm) {
  const double arc = is_arc(m.kind) ? norm(xy(m.to) - m.centre) : 0.0;
  return length_of(m) * (arc > 1e-6 ? (arc + radius_mm) / arc : 1.0);
}

}  // namespace

void StepChecks::account(const Move& m, const Bite& bite) {
  const double length = length_of(m);
  const double rpm = std::abs(m.spindle_rpm);
  const bool axial = norm(xy(m.to) - xy(m.from)) < 1e-6 && !is_arc(m.kind);
  if (sum_.length_mm > 0.0 && (std::abs(sum_.feed_mm_min - m.feed_mm_min) > 0.01 * sum_.feed_mm_min ||
                               sum_.rpm != rpm || sum_.axial != axial)) {
    settle();
  }
  if (!(length > 0.0) || !(m.feed_mm_min > 0.0)) return;
  if (bite.volume_mm3 <= kTouchMm3) {
    settle();
    return;
  }
  if (sum_.length_mm == 0.0) sum_.where = m.where;
  sum_.length_mm += length;
  sum_.edge_mm += edge_length(m, radius_);
  sum_.volume_mm3 += bite.volume_mm3;
  sum_.minutes += length / m.feed_mm_min;
  sum_.depth_mm = std::max(sum_.depth_mm, bite.thickest_mm);
  sum_.feed_mm_min = m.feed_mm_min;
  sum_.rpm = rpm;
  sum_.axial = axial;
  if (sum_.length_mm > std::max(2.0, 0.5 * radius_)) settle();
}

void StepChecks::settle() {
  if (sum_.length_mm > std::max(0.5, 3.0 * grid_.cell()) && sum_.rpm > 0.0) {
    const int teeth = std::max(1, cutter_.teeth);
    const double d = std::max(1e-6, cutter_.cutting_diameter_mm);
    const double fz = sum_.feed_mm_min / (sum_.rpm * teeth);
    double width = d;
    double chip_mm =
        fz * std::sin(0.5 * (cutter_.point_angle_rad > 0.0 ? cutter_.point_angle_rad : std::numbers::pi));
    if (!sum_.axial && sum_.depth_mm > 0.0) {
      // The mean section and the depth give the width; width and feed give the chip (chord geometry).
      width = std::clamp(sum_.volume_mm3 / sum_.edge_mm / sum_.depth_mm, 0.01 * d, d);
      const double phi = std::acos(1.0 - 2.0 * width / d);
      chip_mm = 2.0 * fz * width / (d * phi);
    }
    if (sum_.axial || works_along_axis(cutter_)) axial_feed(fz);
    power(sum_.volume_mm3, sum_.minutes, chip_mm);
  }
  sum_ = {};
}

double StepChecks::feed_per_tooth(const Move& m) const {
  const double n = std::abs(m.spindle_rpm);
  return n > 0.0 ? m.feed_mm_min / (n * std::max(1, cutter_.teeth)) : 0.0;
}

void StepChecks::axial_feed(double fz) {
  const FeedLimit limit = feed_limit(cutter_);
  const double feed = limit.per_revolution ? fz * std::max(1, cutter_.teeth) : fz;
  if (feed <= limit.mm * (1.0 + kWritten)) return;
  out_.error(18, "CHK-FEED-TOOL", {step_.order + 1, step_.id, sum_.where},
             "a feed of " + mm(feed) + (limit.per_revolution ? " per revolution" : " per tooth") +
                 " along the axis; at most " + mm(limit.mm) + " (" + limit.source + ", diameter " +
                 mm(cutter_.cutting_diameter_mm) + ")",
             feed);
}

void StepChecks::chip(const Move& m, double thickest_mm, double fz, Vec2 where) {
  const FeedLimit limit = feed_limit(cutter_);
  if (limit.per_revolution || thickest_mm <= limit.mm * (1.0 + kWritten)) return;
  out_.error(18, "CHK-FEED-TOOL", at(m),
             "chips of up to " + mm(thickest_mm) + " at (" + plain(where.x) + ", " + plain(where.y) +
                 ") (feed per tooth " + mm(fz) + "); at most " + mm(limit.mm) + " (" + limit.source +
                 ", diameter " + mm(cutter_.cutting_diameter_mm) + ")",
             thickest_mm);
}

void StepChecks::power(double volume, double minutes, double chip_mm) {
  const model::WorkMaterial& w = plan_.material;
  const model::Spindle& spindle = plan_.machine.spindle;
  if (!(w.kc11_n_mm2 > 0.0) || spindle.curve.empty() || !(minutes > 0.0)) return;
  const double h =
      std::clamp(chip_mm, mechanics::kKienzleMinChipThicknessMm, mechanics::kKienzleMaxChipThicknessMm);
  double kc = w.kc11_n_mm2 * std::pow(h, -w.mc) * mechanics::kWearForceFactor;
  if (cutter_.cutter_class == CutterClass::kReamer) kc *= mechanics::kReamingFrictionFactor;
  const double power_w = kc * volume / minutes / 60000.0;  // N/mm2 mm3/min = N mm/min = 1/60000 W
  const double torque_nm = power_w / (sum_.rpm * 2.0 * std::numbers::pi / 60.0);
  const double efficiency =
      spindle.efficiency > 0.0 ? spindle.efficiency : mechanics::kDefaultSpindleEfficiency;
  const model::SpindlePoint limit = spindle_at(spindle, sum_.rpm);
  const Findings::Where where{step_.order + 1, step_.id, sum_.where};
  const std::string how =
      ": " + plain(volume / minutes) + " mm3/min at kc = " + plain(kc) + " N/mm2, worn edge";
  if (limit.power_w > 0.0 && power_w > kMeasured * limit.power_w * efficiency) {
    out_.error(17, "CHK-POWER", where,
               "cutting asks for " + plain(power_w) + " W of " + plain(limit.power_w * efficiency) +
                   " W at " + plain(sum_.rpm) + " rpm" + how,
               power_w);
  }
  if (limit.torque_nm > 0.0 && torque_nm > kMeasured * limit.torque_nm * efficiency) {
    out_.error(17, "CHK-TORQUE", where,
               "cutting asks for " + plain(torque_nm) + " Nm of " + plain(limit.torque_nm * efficiency) +
                   " Nm at " + plain(sum_.rpm) + " rpm" + how,
               torque_nm);
  }
}

}  // namespace capstan::verify
