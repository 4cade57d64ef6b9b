#pragma once

#include <vector>

#include "planner/door/app/show/query.h"
#include "planner/model/nouns/arena/model.h"

namespace capstan::app {

/// The objects for which the condition holds, in order. A missing value compares as false; a list fulfils a
/// condition if one of its items does; numbers are equal within a billionth.
/// Fails  INS-PATH: an attribute that none of the objects has, a comparison that its value does not allow.
[[nodiscard]] Result<std::vector<model::AnyRef>> objects_where(const model::Model& m,
                                                               const std::vector<model::AnyRef>& objects,
                                                               const Query& query,
                                                               const Condition& condition);

}  // namespace capstan::app
