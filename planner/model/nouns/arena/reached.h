#pragma once

#include <span>
#include <vector>

#include "planner/model/nouns/arena/model.h"

namespace capstan::model {

/// The objects of a kind or below it that the roots reach: those of `reachable` (walk.h), in the same order.
/// Quicker where most of what is reached are points: it does not visit what holds no reference.
[[nodiscard]] std::vector<AnyRef> reached_of(const Model& model, std::span<const AnyRef> roots, TypeId kind);

}  // namespace capstan::model
