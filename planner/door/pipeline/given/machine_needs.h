#pragma once

#include "planner/door/pipeline/work.h"

// What the plan asks of a machine; only planner/door/pipeline/*.cpp include this.

namespace capstan::pipeline {

/// States at the main workplan what a machine must have for this plan (its_minimum_machine_params): the
/// fastest feed, speed, the largest power and torque at the motor with the margins of planning, axes, travel.
/// Where the file states its own, that stays.
void state_machine_needs(Work& w);

/// Marks which cutters are in the magazine (Cutter::loaded) and notes those that have to be loaded.
void tell_loading(Work& w);

}  // namespace capstan::pipeline
