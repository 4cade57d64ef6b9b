#pragma once

#include "planner/model/features/shape.h"
#include "planner/model/plan/proposal.h"
#include "rules/rules.h"

namespace capstan::rules {

/// Puts before each chain that spots and drills the same for a drill of solid carbide: without a spot to five
/// diameters, else with a spot as blunt as that drill. It turns some four times as fast as one of HSS, and a
/// spot less is a tool change less; where there is none, the chain behind it is taken. Where the size leaves room
/// for its oversize, a drill with inserts will do, too (point_angle_most_rad: level).
/// Before each chain that spots with a drill that is none, and breaks the hole's edge with a step of its own:
/// the same with a spot of 90 degrees that is as deep as breaks the edge, and without that step.
void carbide_first(const model::FeatureShape& shape, const Context& context, model::Proposal& proposal);

}  // namespace capstan::rules
