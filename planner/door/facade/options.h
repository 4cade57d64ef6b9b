#pragma once

#include <string>
#include <vector>

#include "capstan/capstan.h"
#include "planner/door/service/request.h"
#include "planner/ground/base/result.h"

namespace capstan::facade {

/// The request that the caller's options mean. Fails  as service::set, OPTION-VALUE for options that
/// contradict each other.
[[nodiscard]] Result<service::Request> request_of(const PlanOptions& options);

/// The names of the service's options that PlanOptions has fields for.
[[nodiscard]] std::vector<std::string> option_names();

}  // namespace capstan::facade
