#pragma once

#include <vector>

#include "planner/ground/base/job.h"
#include "planner/making/draft/bans.h"
#include "planner/making/draft/draft.h"
#include "planner/making/piece/demands.h"
#include "planner/making/piece/piece.h"

// Measuring in the process: a workpiece_probing between the steps of a feature.

namespace capstan::probing {

/// The steps with those that measure, and the plan with the nouns of these.
struct Added {
  model::Plan plan;
  std::vector<draft::StepDraft> steps;
  std::vector<draft::GivenUp> given_up;  ///< chains that need a measurement which cannot be made
};

/// Adds a workingstep of probing before each step that needs one, once the order is known: a
/// workpiece_probing per touch, with start and direction in workpiece coordinates. The expected distance is
/// that from the start to the touch: the ball's radius and the allowance of later steps are subtracted.
///
/// It measures the datum that the position refers to, if that is a hole, a pocket or an outside made before
/// in the same set-up; else the feature itself. Of a hole, a pocket or an outside it measures opposite walls
/// in x and in y, of a slot across, of a face its level. If no start is known to be free or no wall is known
/// to exist, it proposes nothing and gives up the chain (or measures by hand if the probe's ball does not
/// fit). Reports what is measured by hand (PIP-PROBE).
[[nodiscard]] Added add_probings(model::Plan plan, std::vector<draft::StepDraft> steps,
                                 const piece::Shapes& shapes, const piece::Demands& demands, Job& job);

}  // namespace capstan::probing
