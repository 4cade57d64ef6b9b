#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "planner/door/pipeline/pipeline.h"
#include "planner/ground/base/job.h"
#include "planner/model/plan/plan.h"
#include "planner/model/plan/resources/material.h"

namespace capstan::casebase {
class CaseBase;
}

namespace capstan::pipeline {

/// A material's card as measured cases of this machine correct it (casebase/tune/card.h).
struct CorrectedCard {
  model::WorkMaterial of;               ///< the card that it was made of, without cases
  model::WorkMaterial card;             ///< the plan's: what is taken is in it, marked (model::by_cases)
  std::vector<model::Provenance> rows;  ///< what is taken, for the plan's record
  std::vector<Diagnostic> told;         ///< notes of what is taken, warnings of what is not believed
};

/// Force coefficients for milling, with the spread that margins take, and lives of edges. A card that no case
/// corrects stays as it is; of one that cases corrected before, the card before them counts. Every margin
/// still counts wear and override; only the spread is by evidence.
[[nodiscard]] CorrectedCard corrected_card(const casebase::CaseBase& cases, const model::WorkMaterial& card,
                                           const std::string& machine_id);

/// The row of a plan's record that says by which measured cases its card stands, as it is with what they put
/// into it: `state_of_card`. There is none where no case was measured on that machine in that material.
inline constexpr std::string_view kCardByCases = "card by cases";
/// What `CorrectedCard` would be made of, and what it gave: the same for the same cases, card and rules
/// (tune::kCardRules), numbers to nine digits. Reads no case, so that a plan can be held against 100,000 of
/// them in time. Empty where there is no case, or where not all of them could be `heard`.
[[nodiscard]] std::string state_of_card(const casebase::CaseBase& cases, const model::WorkMaterial& card,
                                        const std::string& machine_id,
                                        std::optional<std::size_t> heard = std::nullopt);

/// Of a plan whose card cases corrected: what it would be without any case, planned and checked once more,
/// quietly: its time as a row of the record and a note (CASE-WITHOUT), and each step that is another as an
/// alternative beside its speed; where that cannot be planned, the note says why. Costs as much as the
/// planning did. Nothing of another plan, and nothing where `job` is stopped or has a deadline.
void tell_without_cases(model::Plan& made, const model::Plan& read, const Inputs& inputs,
                        const Policy& policy, Job& job);

}  // namespace capstan::pipeline
