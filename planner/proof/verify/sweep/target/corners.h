#pragma once

#include <optional>
#include <vector>

#include "planner/model/plan/corner_rest.h"
#include "planner/proof/verify/sweep/target/target.h"

namespace capstan::verify {

/// Where a mill of this radius leaves the corners of an area, and nowhere else, `more` wider; frame of the
/// area. Corners at the open side of a pocket keep nothing: the mill runs out there. `open`: the pocket's
/// reach, else empty. `rounded`: also corners that are drawn with a radius of their own; else sharp ones
/// only.
[[nodiscard]] geometry::Region in_corners(const geometry::Region& area, const geometry::Region& open,
                                          double radius_mm, double more_mm, bool rounded);

/// The plan's record of rest material in a form's corners; its radius is that of the mills at most.
[[nodiscard]] std::optional<model::CornerRest> recorded_rest(const model::Plan& plan, const PartShapes& part,
                                                             const volumes::Form& form, const Asked& asked);

/// Records that planning does not write: of no feature that is made, of another stated radius, larger than
/// what the mills of the feature leave (CHK-REST-RECORD). `partly`: a feature of the record may be made in
/// steps that are not the plan's.
void check_corner_records(const model::Plan& plan, const PartShapes& part, const std::vector<Asked>& asked,
                          bool partly, Findings& out);

}  // namespace capstan::verify
