#pragma once

#include <vector>

#include "planner/door/service/options.h"

namespace capstan::service {

/// The options that tell the state of a running machine, beside its tools and what was measured.
[[nodiscard]] std::vector<Option> state_options();

}  // namespace capstan::service
