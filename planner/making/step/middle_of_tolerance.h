#pragma once

#include "planner/model/features/shape.h"

namespace capstan::step {

/// Moves the walls of pockets, slots and outsides, and the floors of these and of steps, to the middle of
/// their tolerances. A hole's path does that by itself.
void aim_at_the_middle(model::FeatureShape& shape);

}  // namespace capstan::step
