#pragma once

#include "planner/model/nouns/arena/attribute.h"

namespace capstan::model {

/// Kinds that files put where the schema has another, and that lose nothing: a hole's depth as a length below
/// its top. What reads a plan takes them.
[[nodiscard]] inline bool may_stand_in(const Attribute& a, TypeId kind) {
  return a.name == "depth" && kind == TypeId::kTolerancedLengthMeasure;
}

}  // namespace capstan::model
