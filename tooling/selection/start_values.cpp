#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "planner/ground/base/number.h"
#include "tooling/library/cutters/complete.h"
#include "tooling/library/cutters/generic.h"
#include "tooling/selection/limits.h"
#include "tooling/selection/select.h"
#include "tooling/shop/material/material.h"

namespace capstan::tooling {
namespace {

using model::Cutter;
using model::CutterClass;
using model::CuttingPreset;
using model::Machine;
using model::WorkMaterial;

/// Room for rounding when speeds are compared with limits.
constexpr double kSlack = 1e-9;
/// Start feed of a cutter without any preset, as a share of its diameter.
constexpr double kLeastFeedPerDiameter = 0.002;  // default, unsourced

/// The cutter's own presets first, from the material itself to its group; then those of its like.
const CuttingPreset* preset_for(const Cutter& c, const WorkMaterial& m) {
  const auto* own = model::preset_of(c, m, false);
  return own != nullptr ? own : model::preset_of(c, m, true);
}

double feed_limit(const Cutter& c, const Machine& m) {
  const double z = m.axes[2].feed_max_mm_min;
  return model::has(c.cutter_class, model::CutterTrait::kAlongAxis)
             ? z
             : std::min(m.axes[0].feed_max_mm_min, m.axes[1].feed_max_mm_min);
}

/// Holds the speed within a limit and says so, where it is told.
void limit_speed(double& rpm, double least, double most, const char* whose, bool told, std::string& text) {
  const double held = std::max(least, most > 0.0 ? std::min(rpm, most) : rpm);
  if (told && std::abs(held - rpm) > kSlack * rpm) {
    text += "; speed " + std::string(held < rpm ? "lowered" : "raised") + " from " + trimmed(rpm, 0) +
            " to " + trimmed(held, 0) + " 1/min by the " + whose;
  }
  rpm = held;
}

StartValues start_of(const Cutter& c, const WorkMaterial& material, const Machine& machine, bool told) {
  StartValues out;
  if (c.cutter_class == CutterClass::kTouchProbe) return out;  // it neither turns nor cuts
  const CuttingPreset* preset = preset_for(c, material);
  double vc = preset != nullptr ? preset->vc_m_min : 0.0;
  double fz = preset != nullptr ? preset->fz_mm : 0.0;
  std::string source = told && preset != nullptr ? preset->source.text() : std::string();
  if (vc <= 0.0) {
    vc = c.substrate == model::Substrate::kHss ? material.vc_hss_m_min : material.vc_carbide_m_min;
    source += (source.empty() ? "" : "; ") + std::string("vc: the material's");
  }
  // An own preset may state a speed alone: the feed of its like counts then.
  if (const double like = model::start_feed_mm(c, material); fz <= 0.0 && like > 0.0) {
    fz = like;
    source += "; fz: that of a cutter like it";
  }
  if (fz <= 0.0) {
    fz = c.fz_min_mm > 0.0 ? c.fz_min_mm : kLeastFeedPerDiameter * c.cutting_diameter_mm;
    source += std::string("; fz: ") +
              (c.fz_min_mm > 0.0 ? "the cutter's least" : "default, unsourced: 0.002 x diameter");
  }
  const bool tap = c.cutter_class == CutterClass::kTap;
  if (tap) fz = c.thread_pitch_mm / c.teeth;

  // Where the speed is the material's, its own source is the reason.
  if (source.find(kMaterialsSpeed) != std::string::npos) {
    const char* field = c.substrate == model::Substrate::kHss ? "vc_hss_m_min" : "vc_carbide_m_min";
    if (const std::string* from = source_of(material, field)) source += "; the material's speed: " + *from;
  }

  std::string text;
  const double turn_mm = std::numbers::pi * c.cutting_diameter_mm;
  double rpm = 1000.0 * vc / turn_mm;
  out.wanted_vc_m_min = vc;
  limit_speed(rpm, 0.0, c.maximum_speed_rpm, "tool", told, text);
  limit_speed(rpm, machine.spindle.rpm_min, machine.spindle.rpm_max, "spindle", told, text);
  const double largest = model::largest_tooth_feed_mm(c, material);
  if (!tap && largest > 0.0 && fz > largest) {
    const std::string* of = told ? source_of(c, "fz_max_mm") : nullptr;
    if (told)
      text += "; fz lowered from " + trimmed(fz, 4) + " to the cutter's largest, " + trimmed(largest, 4) +
              " mm" + (of != nullptr ? " (" + *of + ")" : std::string());
    fz = largest;
  }
  if (fz < c.fz_min_mm) fz = c.fz_min_mm;
  const double limit = feed_limit(c, machine);
  if (limit > 0.0 && fz * c.teeth * rpm > limit * (1.0 + kSlack)) {
    // Reduce the feed per tooth to the least that the cutter allows (a tap: not at all), then the spindle
    // speed.
    const double least = tap ? fz : c.fz_min_mm;
    fz = std::max(least, limit / (c.teeth * rpm));
    if (fz * c.teeth * rpm > limit) rpm = std::max(machine.spindle.rpm_min, limit / (fz * c.teeth));
    if (told) text += "; held to the axes' feed of " + trimmed(limit, 1) + " mm/min";
  }
  out.spindle_rpm = rpm;
  out.vc_m_min = rpm * turn_mm / 1000.0;
  out.fz_mm = fz;
  out.feed_mm_min = fz * c.teeth * rpm;
  if (!told) return out;
  out.why = {
      "tooling.start." + material.id,
      "vc " + trimmed(out.vc_m_min, 2) + " m/min, fz " + trimmed(fz, 4) + " mm in " + material.id + text,
      source};
  return out;
}

}  // namespace

StartValues start_values(const Cutter& c, const WorkMaterial& material, const Machine& machine) {
  return start_of(c, material, machine, true);
}

StartValues start_numbers(const Cutter& c, const WorkMaterial& material, const Machine& machine) {
  return start_of(c, material, machine, false);
}

}  // namespace capstan::tooling
