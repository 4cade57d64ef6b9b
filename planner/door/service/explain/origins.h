#pragma once

#include <string>
#include <string_view>

#include "planner/model/plan/plan.h"

namespace capstan::service {

/// The rows of a plan's record as a table with its heading: where its inputs come from, and what cases say of
/// it. The times of single steps are left to the table of steps. Empty where there are none.
[[nodiscard]] std::string origins_text(const model::Plan& plan);

/// Whether cases tell the time of any step.
[[nodiscard]] bool has_step_times(const model::Plan& plan);
/// The value of a row by its name (making/step/record/expected_by_cases.h), else `none`.
[[nodiscard]] std::string told_of_step(const model::Plan& plan, std::string_view row, std::string_view none);

}  // namespace capstan::service
