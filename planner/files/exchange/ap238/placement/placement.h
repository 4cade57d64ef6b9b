#pragma once

#include <string>
#include <vector>

#include "planner/files/exchange/ap238/read/reader.h"
#include "planner/model/plan/plan.h"

namespace capstan::exchange::ap238 {

/// Features have different placements in the two standards. The rows of the mapping do not convert them;
/// these two functions do.
///
///     model (ISO 14649)   origin on top, z out of the material, the depth is a surface; slots and steps too,
///                         their travel any direction in the plane
///     ISO 10303-238       holes and pockets: origin at the start of a course of travel, whose length is the
///                         depth; 'depth end' says that the bottom is at its end, so that the origin is on
///                         top. Slots and steps: origin at the profile's, z along the travel, y out of the
///                         material
///
/// A depth surface ('maximum feature limit') may be stated beside the course of travel, as in the standard's
/// own examples; if the two differ the surface decides, with a warning. Profiles and paths whose placement is
/// the feature's own instance have none. Elements derived only because AP238 requires them are marked by the
/// name of their direction, and dropped when read.

/// An operation that a workingstep carries out on a feature, and that the feature does not list among its
/// own. AP238 knows a feature's operations by workingsteps, so a record says it (`records.h`).
struct Unlisted {
  model::AnyRef feature, operation;
};

/// Before writing. `plan` is a copy. `losses`: features that could not be turned, whose placement or depth
/// therefore is not what AP238 means by it.
[[nodiscard]] std::vector<Unlisted> to_ap238(model::Plan& plan, std::vector<std::string>& losses);
/// After everything that the project and the features lead to was read.
void to_model(Reader& reader);

}  // namespace capstan::exchange::ap238
