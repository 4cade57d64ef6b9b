#include "planner/model/plan/resources/specific_force.h"

#include <algorithm>
#include <cmath>

namespace capstan::model {

const MechanisticSet* measured_set(const WorkMaterial& material, Substrate substrate) {
  const auto it = std::find_if(
      material.mechanistic.begin(), material.mechanistic.end(),
      [&](const auto& set) { return set.substrate == to_text(substrate) && set.ktc_n_mm2 > 0.0; });
  return it == material.mechanistic.end() ? nullptr : &*it;
}

double kienzle_share(const WorkMaterial& material, const Cutter& cutter) {
  const bool end_mill =
      has(cutter.cutter_class, CutterTrait::kEndMill) || has(cutter.cutter_class, CutterTrait::kBall);
  const bool raked = end_mill && material.iso_group != "H";
  return raked ? 1.0 - kForcePerDegreeOfRake * kEndMillRakeDeg : 1.0;
}

double specific_force_n_mm2(const WorkMaterial& material, const Cutter& cutter, double chip_mm) {
  if (!(chip_mm > 0.0)) return 0.0;
  if (const MechanisticSet* set = measured_set(material, cutter.substrate))
    return set->ktc_n_mm2 + set->kte_n_mm / chip_mm;
  return kienzle_share(material, cutter) * material.kc11_n_mm2 * std::pow(chip_mm, -material.mc);
}

}  // namespace capstan::model
