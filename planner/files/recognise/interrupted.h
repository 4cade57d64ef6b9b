#pragma once

#include "planner/files/recognise/prismatic.h"

namespace capstan::recognise {

/// Joins features that another one cut in two: of one kind, on the same surfaces, and open to a common
/// feature. Two that have material between them, as slots in the two ends of a part, stay two.
void join_interrupted(const Context& context, Recognition& found);

}  // namespace capstan::recognise
