#pragma once

#include <cstddef>

#include "planner/model/plan/plan.h"

namespace capstan::model {

/// What was cut before a plan's steps, where these are a part of all: the first `steps` results of `plan`,
/// whose nouns the other plan has, too. Steps of the workplan that are in neither are still to come.
struct CutBefore {
  const Plan& plan;
  std::size_t steps = 0;
};

}  // namespace capstan::model
