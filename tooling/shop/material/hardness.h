#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "planner/ground/base/result.h"
#include "planner/model/plan/resources/material.h"
#include "tooling/shop/material/stated_words.h"

namespace capstan::tooling {

/// What a piece is said to be beside its grade: by its names, and by properties of the part.
struct Beside {
  std::vector<StatedHardness> hardness;
  std::vector<StatedState> states;
};

struct ChosenCard {
  model::WorkMaterial material;
  bool by_hardness = false;  ///< its card was chosen by a hardness, or held against one
};

/// The card for a piece that is as hard as stated: the material's own while it is as hard, else the softest
/// of the same grade, or of what it becomes by hardening (`harder` of the shipped table), that is as hard.
/// Of several that convert to Brinell for its group the hardest counts. WorkMaterial::sources then says so
/// beside "chosen". A card that states no hardness stands for what is clearly softer than the next one.
/// A state in words that means harder than the card, and gives no number, has no card.
///
/// named   what the texts call the material, for messages
/// Fails  MATERIAL-HARDNESS when the piece is harder than every card; MATERIAL-STATE for such a state.
[[nodiscard]] Result<ChosenCard> as_stated(const model::WorkMaterial& material, const std::string& named,
                                           const Beside& beside,
                                           const std::vector<model::WorkMaterial>& materials);

/// Whether the hardness says something of this material: there is a conversion for its group, and a card to
/// hold it against.
[[nodiscard]] bool is_used(const StatedHardness& stated, const ChosenCard& judged);

}  // namespace capstan::tooling
