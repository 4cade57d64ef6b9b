#include "planner/model/plan/resources/by_cases.h"

#include <algorithm>

#include "planner/model/plan/resources/specific_force.h"

namespace capstan::model {

bool corrected_by_cases(const WorkMaterial& card) {
  const auto by = [](const auto& one) { return by_cases(one); };
  return std::any_of(card.mechanistic.begin(), card.mechanistic.end(), by) ||
         std::any_of(card.life.begin(), card.life.end(), by);
}

WorkMaterial without_cases(WorkMaterial card) {
  std::erase_if(card.mechanistic, [](const MechanisticSet& set) { return by_cases(set); });
  std::erase_if(card.life, [](const ToolLifeLaw& law) { return by_cases(law); });
  return card;
}

bool kienzle_by_cases(const WorkMaterial& card, Substrate substrate) {
  const MechanisticSet* held = measured_set(card, substrate);
  if (held == nullptr || !by_cases(*held)) return false;
  return std::none_of(card.mechanistic.begin(), card.mechanistic.end(), [&](const MechanisticSet& set) {
    return !by_cases(set) && set.substrate == to_text(substrate) && set.ktc_n_mm2 > 0.0;
  });
}

}  // namespace capstan::model
