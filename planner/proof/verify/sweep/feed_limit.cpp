#include <algorithm>
#include <cmath>
#include <numbers>

#include "planner/model/plan/borne_feed.h"
#include "planner/proof/verify/sweep/step_checks.h"

namespace capstan::verify {

using model::CutterClass;

bool works_along_axis(const model::Cutter& c) {
  switch (c.cutter_class) {
    case CutterClass::kTwistDrill:
    case CutterClass::kCenterDrill:
    case CutterClass::kSpotDrill:
    case CutterClass::kReamer:
    case CutterClass::kTap:
    case CutterClass::kBoringTool:
    case CutterClass::kCountersink:
    case CutterClass::kCounterbore:
    case CutterClass::kGunDrill:
    case CutterClass::kBackCounterbore:
    case CutterClass::kBackCountersink:
      return true;
    default:
      return false;
  }
}

FeedLimit feed_limit(const model::Cutter& c, const model::WorkMaterial& material) {
  const double d = c.cutting_diameter_mm;
  const int teeth = std::max(1, c.teeth);
  FeedLimit out;
  out.per_revolution = works_along_axis(c);
  const model::BorneFeed borne = model::borne_feed(c, material);
  const std::string by_preset = "1.5 times the tool's start value for " + material.id;
  if (c.fz_max_mm > 0.0) {
    out.mm = borne.mm * (out.per_revolution ? teeth : 1);
    out.source = borne.by_preset ? by_preset : "the tool's own limit";
    return out;
  }
  // Shares of the diameter with a cap: default, unsourced; above what catalogues recommend for steel.
  switch (c.cutter_class) {
    case CutterClass::kReamer:
      out.mm = std::clamp(0.1 * d, 0.1, 1.5);
      break;
    case CutterClass::kFacemill:
      out.mm = 0.4;
      break;
    default:
      out.mm = out.per_revolution ? std::clamp(0.04 * d, 0.02, 0.8) : std::clamp(0.02 * d, 0.01, 0.3);
  }
  out.source = "default, unsourced";
  const double start = borne.mm * (out.per_revolution ? teeth : 1);
  if (start > out.mm) {
    out.mm = start;
    out.source = by_preset;
  }
  return out;
}

model::SpindlePoint spindle_at(const model::Spindle& s, double rpm) {
  model::SpindlePoint out{.rpm = rpm};
  if (s.curve.empty()) return out;
  const auto filled = [](model::SpindlePoint p) {
    const double omega = p.rpm * 2.0 * std::numbers::pi / 60.0;
    if (p.power_w <= 0.0) p.power_w = p.torque_nm * omega;
    if (p.torque_nm <= 0.0 && omega > 0.0) p.torque_nm = p.power_w / omega;
    return p;
  };
  const model::SpindlePoint first = filled(s.curve.front());
  if (rpm <= first.rpm) {
    out.torque_nm = first.torque_nm;
    out.power_w = first.rpm > 0.0 ? first.power_w * rpm / first.rpm : first.power_w;
    return out;
  }
  for (std::size_t i = 1; i < s.curve.size(); ++i) {
    const model::SpindlePoint a = filled(s.curve[i - 1]);
    const model::SpindlePoint b = filled(s.curve[i]);
    if (rpm > b.rpm) continue;
    const double t = b.rpm > a.rpm ? (rpm - a.rpm) / (b.rpm - a.rpm) : 1.0;
    out.power_w = a.power_w + t * (b.power_w - a.power_w);
    out.torque_nm = a.torque_nm + t * (b.torque_nm - a.torque_nm);
    return out;
  }
  const model::SpindlePoint last = filled(s.curve.back());
  out.power_w = last.power_w;
  out.torque_nm = last.power_w / (rpm * 2.0 * std::numbers::pi / 60.0);
  return out;
}

}  // namespace capstan::verify
