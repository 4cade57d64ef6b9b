#pragma once

#include <string>
#include <vector>

#include "planner/ground/base/job.h"
#include "planner/model/plan/plan.h"
#include "planner/model/plan/resources/material.h"

namespace capstan::casebase {
class CaseBase;
}

namespace capstan::pipeline {

/// A material's card as measured cases of this machine correct it (casebase/tune/card.h).
struct CorrectedCard {
  std::string of;                       ///< the id of the card that it was made of
  model::WorkMaterial card;             ///< the plan's: what is taken is in it, with its source
  std::vector<model::Provenance> rows;  ///< what is taken, for the plan's record
  std::vector<Diagnostic> told;         ///< notes of what is taken, warnings of what is not believed
};

/// Force coefficients for milling, with the spread that margins take, and lives of edges. A card that no case
/// corrects stays as it is. Every margin still counts wear and override; only the spread is by evidence.
[[nodiscard]] CorrectedCard corrected_card(const casebase::CaseBase& cases, const model::WorkMaterial& card,
                                           const std::string& machine_id);

}  // namespace capstan::pipeline
