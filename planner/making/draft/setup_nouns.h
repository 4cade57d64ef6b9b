#pragma once

#include <cstddef>
#include "planner/ground/geometry/placement.h"

#include "planner/model/nouns/arena/model.h"
#include "planner/model/nouns/forward.h"

namespace capstan::draft {

/// Height of a set-up's security plane above the raw piece if the file states none, mm. Default, unsourced.
inline constexpr double kSecurityAboveMm = 10.0;

/// The nouns of a set-up that planning makes: its number counts from 1, `raw` is the raw piece in workpiece
/// coordinates.
[[nodiscard]] model::Ref<model::Setup> add_setup(model::Model& m, std::size_t number,
                                                 const geometry::Box3& raw,
                                                 const geometry::Placement& workpiece_in_setup);

}  // namespace capstan::draft
