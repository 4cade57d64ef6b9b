#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "planner/making/propose/choose.h"
#include "planner/model/plan/corner_rest.h"
#include "rules/rules.h"

namespace capstan::propose {

/// A chain with its cutters, and what it leaves in the corners.
struct InCorners {
  model::Proposal proposal;  ///< holds the chain that is chosen
  Chosen chosen;             ///< without a chain: there is none
  std::vector<model::Rejected> rejected;
  std::string drawn_square;  ///< corners that a mill leaves round, in words; empty: none
  std::optional<model::CornerRest> rest;
};

/// The widest radius that may stay in corners because a narrower mill takes long, mm. A radius that is stated
/// is asked for, 0 (`square`) as well: the depth alone says how far one may leave it, and not how wide an
/// open pocket is.
[[nodiscard]] double widest_for_time_mm(const model::FeatureShape& shape, bool square);

/// Chooses a chain for a shape as it is stated. Where none has its cutters, and the shape has inside corners,
/// or where these are drawn square: for the least radius that a chain makes, which is then rest material.
/// `p`: proposed for the shape as it is stated, `context` for its feature; else as `choose`.
[[nodiscard]] InCorners choose_in_corners(const Choice& choice, const rules::RuleBase& rules,
                                          const rules::Context& context, model::Proposal p,
                                          const model::FeatureShape& shape, const draft::Member& member,
                                          const std::vector<draft::StepDraft>& steps,
                                          const std::vector<std::string>& used, Job& job);

/// Why a shape finds no cutters that would with an empty magazine, and which these are; empty if it would not
/// either. `used`: by the steps of other shapes.
[[nodiscard]] std::string full_magazine(const Choice& choice, const rules::RuleBase& rules,
                                        const rules::Context& context, const model::Proposal& p,
                                        const model::FeatureShape& shape, const draft::Member& member,
                                        const std::vector<std::string>& used);

}  // namespace capstan::propose
