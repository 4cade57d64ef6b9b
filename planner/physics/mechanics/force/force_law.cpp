#include "planner/physics/mechanics/force/force_law.h"

#include <algorithm>
#include <cmath>

namespace capstan::mechanics {

const model::MechanisticSet* measured_set(const model::WorkMaterial& material, model::Substrate substrate) {
  const auto it = std::find_if(
      material.mechanistic.begin(), material.mechanistic.end(),
      [&](const auto& set) { return set.substrate == model::to_text(substrate) && set.ktc_n_mm2 > 0.0; });
  return it == material.mechanistic.end() ? nullptr : &*it;
}

double ForceMargin::factor() const {
  return std::exp(deviations * std::hypot(std::log(spread), std::log(wear), std::log(override_up)));
}

ForceMargin kienzle_margin(const model::WorkMaterial& material, const MarginAsked& asked) {
  return {.spread = std::max(kForceUncertaintyFactor, 1.0 + material.kc_uncertainty),
          .override_up = std::pow(asked.feed_up, 1.0 - material.mc),
          .deviations = asked.deviations};
}

ForceMargin force_margin(const model::WorkMaterial& material, model::Substrate substrate,
                         const MarginAsked& asked) {
  const model::MechanisticSet* set = measured_set(material, substrate);
  if (set == nullptr) return kienzle_margin(material, asked);
  return {.spread = set->uncertainty > 0.0 ? 1.0 + set->uncertainty : kForceUncertaintyFactor,
          .override_up = asked.feed_up,
          .deviations = asked.deviations};
}

bool is_milled(model::TypeId operation, const model::Cutter& cutter) {
  if (!model::is_a(operation, model::TypeId::kDrillingTypeOperation)) return true;
  const bool mills = model::has(cutter.cutter_class, model::CutterTrait::kEndMill);
  return mills && model::is_a(operation, model::TypeId::kThreadDrilling);
}

std::string force_source(const model::WorkMaterial& material, model::Substrate substrate, bool milled) {
  const model::MechanisticSet* set = milled ? measured_set(material, substrate) : nullptr;
  if (set != nullptr) {
    return "measured coefficients of " + material.id + " for " + std::string(model::to_text(substrate)) +
           (set->source.empty() ? std::string() : " (" + set->source + ")");
  }
  std::string source;
  for (const auto& [field, from] : material.sources) {
    if (field == "kc11_n_mm2") source = " (" + from + ")";
  }
  return "Kienzle's kc1.1 and mc of " + material.id + source;
}

WorkMaterial milled_with(const model::WorkMaterial& material, const model::Cutter& cutter) {
  const bool end_mill = model::has(cutter.cutter_class, model::CutterTrait::kEndMill) ||
                        model::has(cutter.cutter_class, model::CutterTrait::kBall);
  const bool raked = end_mill && material.iso_group != "H";
  const double share = raked ? 1.0 - kForcePerDegreeOfRake * kEndMillRakeDeg : 1.0;
  return {share * material.kc11_n_mm2, material.mc};
}

ForceLaw force_law(const model::WorkMaterial& material, const model::Cutter& cutter) {
  ForceLaw law{.kienzle = milled_with(material, cutter)};
  if (const model::MechanisticSet* set = measured_set(material, cutter.substrate))
    law.mechanistic = CuttingCoefficients{set->ktc_n_mm2, set->kte_n_mm,  set->krc_n_mm2,
                                          set->kre_n_mm,  set->kac_n_mm2, set->kae_n_mm};
  law.uncertainty_factor = force_margin(material, cutter.substrate).spread;
  return law;
}

Tooth tooth_of(const model::Cutter& cutter) {
  return {.cutting_diameter_mm = cutter.cutting_diameter_mm,
          .corner_radius_mm = model::end_radius_mm(cutter),
          .helix_rad = cutter.helix_rad,
          .lead_angle_rad = cutter.lead_angle_rad,
          .taper_angle_rad = model::flank_lean_rad(cutter),
          .runout_mm = cutter.runout_mm,
          .teeth = std::max(1, cutter.teeth)};
}

}  // namespace capstan::mechanics
