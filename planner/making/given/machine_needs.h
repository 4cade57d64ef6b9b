#pragma once

#include <vector>

#include "planner/ground/base/job.h"
#include "planner/model/plan/plan.h"

// Requirements of the plan on a machine.

namespace capstan::given {

/// States at the main workplan what a machine must have for this plan (its_minimum_machine_params): the
/// fastest feed, speed, the largest power and torque at the motor with the margins of planning, axes, travel.
/// Where the file states its own, that stays.
void state_machine_needs(model::Plan& plan);

/// The plan's cutters, those in the magazine marked (Cutter::loaded). Notes those that have to be loaded.
[[nodiscard]] std::vector<model::Cutter> loaded_of(const model::Plan& plan,
                                                   const std::vector<model::Cutter>& library, Job& job);

}  // namespace capstan::given
