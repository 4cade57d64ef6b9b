#pragma once

#include <string>

#include "planner/model/features/shape.h"
#include "rules/engine/fact.h"
#include "rules/facts/passage.h"
#include "rules/rules.h"

namespace capstan::rules {

/// The facts of one feature for the rules, and the measures its steps need.
struct FeatureFacts {
  Facts facts;
  Passage passage;             ///< areas only
  model::Toleranced diameter;  ///< holes: with the general tolerance if none is stated
  std::string notes;           ///< assumptions, for the reason: "no tolerance stated, taken as IT13; "
};

/// Frame   plain numbers of the shape; no placement enters.
[[nodiscard]] FeatureFacts facts_of(const model::FeatureShape& shape, const Context& context);

/// The stated tolerance, or the general one if none is stated.
[[nodiscard]] model::Toleranced tolerance_or_general(const model::Toleranced& t, const Context& context);

/// Sizes that standard machine reamers (H7) come in: 1 to 20 mm by 0.5, to 32 by 1, to 50 by 5 and the even
/// ones. Source  default, unsourced: a cautious reading of DIN 212 and DIN 208 assortments.
[[nodiscard]] bool is_reamer_size(double diameter_mm);

}  // namespace capstan::rules
