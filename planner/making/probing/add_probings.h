#pragma once

#include <vector>

#include "planner/ground/base/job.h"
#include "planner/making/draft/bans.h"
#include "planner/making/draft/draft.h"
#include "planner/making/piece/demands.h"
#include "planner/making/piece/piece.h"

// Measuring in the process: a workpiece_probing between the steps of a feature.

namespace capstan::probing {

/// The steps with those that measure.
struct Added {
  std::vector<draft::StepDraft> steps;
  std::vector<draft::GivenUp> given_up;  ///< chains that need a measurement which cannot be made
};

/// Puts what is to be measured before the steps that want it, once the order is known: a workpiece_probing
/// per touch, start and direction in workpiece coordinates, the distance expected from the start until the
/// ball touches (its radius taken off, and what later steps still take off).
///
/// Measured is the datum that the position refers to, where that is a hole, a pocket or an outside made
/// before in the same set-up, else the feature itself: of a hole, a pocket or an outside opposite walls in x
/// and in y, of a slot across, of a face its level. Where no start is known to be free and no wall known to
/// be there, nothing is proposed, and the chain is given up (by hand where the probe's ball does not come).
/// What is measured by hand is said (PIP-PROBE).
[[nodiscard]] Added add_probings(model::Plan& plan, std::vector<draft::StepDraft> steps,
                                 const piece::Shapes& shapes, const piece::Demands& demands, Job& job);

}  // namespace capstan::probing
