#pragma once

#include <cstddef>

#include "planner/files/exchange/toolpaths/curves.h"
#include "planner/files/exchange/toolpaths/schedules.h"

namespace capstan::exchange {

/// Name of a point on a straight line that is there only because cross sections change. Other programs ignore
/// names of points; here they show that the line is one move.
inline constexpr const char* kSectionPoint = "section";

/// Joins the last `moves` of a path again where they meet in such a point, are straight on and have one feed
/// and speed. Sections and schedule are renumbered with the moves; those are of the whole path.
void join_at_section_points(const model::Model& m, model::AnyRef curve, const MoveParameters& moves,
                            StepPath& path);

}  // namespace capstan::exchange
