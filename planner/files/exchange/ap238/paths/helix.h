#pragma once

#include <string>
#include <vector>

#include "planner/model/plan/plan.h"

namespace capstan::exchange::ap238 {

/// AP238 has no HELIX: a trimmed one is written as a polyline with via_helix_points, turn by turn, and its
/// name says which helix it was; one that does not turn about z, as points within a micrometre. One
/// that would take more points than a path may have moves is left out, which `losses` says. `plan` is a copy.
void helices_to_via_points(model::Plan& plan, std::vector<std::string>& losses);

/// The other way round, where the name and the points still say the same.
void via_points_to_helices(model::Plan& plan);

}  // namespace capstan::exchange::ap238
