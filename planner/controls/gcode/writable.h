#pragma once

#include <span>
#include <string_view>

#include "planner/ground/base/job.h"
#include "planner/ground/base/result.h"
#include "planner/model/plan/plan.h"

namespace capstan::controls::gcode {

/// Whether a program can be written for the plan at all: every step bound, every number finite, every tool in
/// the magazine under its own number, every set-up with one of the control's work offsets.
/// Fails and warns as `write` (writer.h).
[[nodiscard]] Status writable(const model::Plan& plan, std::span<const std::string_view> work_offsets,
                              Job& job);

}  // namespace capstan::controls::gcode
