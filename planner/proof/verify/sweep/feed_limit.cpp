#include <algorithm>
#include <cmath>
#include <numbers>

#include "planner/model/plan/preset_feeds.h"
#include "planner/proof/verify/copies/copies.h"
#include "planner/proof/verify/stated_values.h"
#include "planner/proof/verify/sweep/step_checks.h"

namespace capstan::verify {

using model::CutterClass;

bool works_along_axis(const model::Cutter& c) { return works_along_axis(c.cutter_class); }

namespace {

/// What the tool's own start values let it bear, mm per tooth.
struct ByPresets {
  double mm = 0.0;
  std::string source;
};

ByPresets by_presets(const model::Cutter& c, const model::WorkMaterial& m) {
  if (const auto* own = stated_for(c, m, false, Wanted::kFeed))
    return {model::kOverPreset * own->fz_mm,
            plain(model::kOverPreset) + " times the tool's start value for " + m.id};
  ByPresets out;
  if (m.iso_group.empty()) return out;
  const std::string group = model::of_group(m.iso_group);
  for (const model::CuttingPreset& p : c.presets) {
    const bool of_it = p.fz_mm > 0.0 && !model::borrowed(p) && p.source.ends_with(group);
    if (of_it && (out.mm == 0.0 || p.fz_mm < out.mm))
      out = {p.fz_mm,
             "the tool's start value for " + p.material_group.text() + ", of ISO group " + m.iso_group};
  }
  return out;
}

/// Whether the largest feed that the tool carries is only that of a generic cutter near it.
bool limit_assumed(const model::Cutter& c) {
  for (const auto& [field, source] : c.sources)
    if (field == "fz_max_mm" && source.starts_with(model::kAsGeneric)) return true;
  return false;
}

}  // namespace

FeedLimit feed_limit(const model::Cutter& c, const model::WorkMaterial& material) {
  const double d = c.cutting_diameter_mm;
  const int teeth = std::max(1, c.teeth);
  FeedLimit out;
  out.per_revolution = works_along_axis(c);
  const int per = out.per_revolution ? teeth : 1;
  const ByPresets own = by_presets(c, material);
  if (c.fz_max_mm > 0.0) {
    const bool more = limit_assumed(c) && own.mm > c.fz_max_mm;
    out.mm = per * (more ? own.mm : c.fz_max_mm);
    out.source = more ? own.source : "the tool's own limit";
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
  if (per * own.mm > out.mm) {
    out.mm = per * own.mm;
    out.source = own.source;
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
