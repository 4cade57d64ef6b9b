#pragma once

#include "planner/model/plan/edit/restrictions.h"

namespace capstan::model {

/// The names that a pattern of an edit may mean of a workingstep of a feature. They live as long as the
/// nouns.
[[nodiscard]] StepNames step_names(const Model& m, AnyRef step, AnyRef feature);
/// A feature's name; empty: it has none.
[[nodiscard]] std::string_view feature_name(const Model& m, AnyRef feature);

}  // namespace capstan::model
