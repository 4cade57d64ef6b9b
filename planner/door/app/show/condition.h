#pragma once

#include <vector>

#include "planner/door/app/show/query.h"
#include "planner/model/nouns/arena/model.h"

namespace capstan::app {

/// Those objects of which the condition holds, in order. What is absent compares as false; a list holds when
/// one of its items does; numbers are equal within a billionth.
/// Fails  INS-PATH: an attribute that none of the objects has, a comparison that its value does not allow.
[[nodiscard]] Result<std::vector<model::AnyRef>> objects_where(const model::Model& m,
                                                               const std::vector<model::AnyRef>& objects,
                                                               const Query& query,
                                                               const Condition& condition);

}  // namespace capstan::app
