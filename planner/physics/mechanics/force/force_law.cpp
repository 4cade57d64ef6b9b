#include "planner/physics/mechanics/force/force_law.h"

#include <algorithm>
#include <cmath>

#include "planner/model/plan/resources/specific_force.h"

namespace capstan::mechanics {

using model::measured_set;

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
  return {model::kienzle_share(material, cutter) * material.kc11_n_mm2, material.mc};
}

namespace {

// The axial force of a set holds for any helix; that of Kienzle's law grows with it. Taken for 45 degrees,
// the steepest of usual mills.
constexpr double kSteepHelixTangent = 1.0;

/// The tangent at this chip to the force per length of edge, kc1.1 h^(1 - mc), of an end mill or a face mill,
/// whichever is more. That force bends downwards, so that its tangent is nowhere below it.
model::MechanisticSet tangent_of(const model::WorkMaterial& m, double chip_mm) {
  const double kc = m.kc11_n_mm2 * std::pow(chip_mm, -m.mc);
  model::MechanisticSet set;
  set.ktc_n_mm2 = (1.0 - m.mc) * kc;
  set.kte_n_mm = m.mc * kc * chip_mm;
  set.krc_n_mm2 = kRadialToTangentialRatio * set.ktc_n_mm2;
  set.kre_n_mm = kRadialToTangentialRatio * set.kte_n_mm;
  set.kac_n_mm2 = kAxialToTangentialRatio * kSteepHelixTangent * set.ktc_n_mm2;
  set.kae_n_mm = kAxialToTangentialRatio * kSteepHelixTangent * set.kte_n_mm;
  return set;
}

}  // namespace

model::MechanisticSet corrected_set(const model::WorkMaterial& material, model::Substrate substrate,
                                    const SetCorrection& by) {
  const model::MechanisticSet* before = measured_set(material, substrate);
  model::MechanisticSet set = before != nullptr ? *before : tangent_of(material, by.chip_mm);
  for (double* k :
       {&set.ktc_n_mm2, &set.kte_n_mm, &set.krc_n_mm2, &set.kre_n_mm, &set.kac_n_mm2, &set.kae_n_mm})
    *k *= by.factor;
  set.substrate = model::to_text(substrate);
  set.uncertainty = by.spread - 1.0;
  set.source = by.source;
  return set;
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
