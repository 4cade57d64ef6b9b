#pragma once

#include <string>

#include "planner/model/plan/plan.h"

namespace capstan::service {

/// How the piece lies in each set-up: zero, sides, how it is turned, pick-up, what holds it, security plane,
/// steps and least Z. Empty: the plan has no set-up.
[[nodiscard]] std::string setups_text(const model::Plan& plan);

/// A line per tool: number, name, kind, sizes, stick-out, the least Z of its tip, and how much of the life of
/// its edge is used. Empty: the plan has no tool.
[[nodiscard]] std::string tools_text(const model::Plan& plan);

}  // namespace capstan::service
