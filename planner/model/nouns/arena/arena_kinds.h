#pragma once

#include "planner/model/nouns/arena/model.h"

namespace capstan::model::detail {

/// How objects of a concrete kind are made; throws std::logic_error for any other.
[[nodiscard]] ObjectKind object_kind(TypeId type);

}  // namespace capstan::model::detail
