#pragma once

#include <string>
#include <utility>
#include <vector>

#include "planner/model/plan/plan.h"

namespace capstan::json {

/// What is derived of a whole plan and written for readers that do not add up themselves: numbers of steps
/// and tool changes, and times in s. Times between steps only where the steps have paths.
[[nodiscard]] std::vector<std::pair<std::string, double>> summary_of(const model::Plan& plan);
/// Whether it is known of any tool that it is in the magazine.
[[nodiscard]] bool has_magazine(const model::Plan& plan);
/// Tools to be put into the magazine, by id; none where nothing is known of it.
[[nodiscard]] std::vector<std::string> to_load(const model::Plan& plan);

}  // namespace capstan::json
