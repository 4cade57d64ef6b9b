#pragma once

#include <string_view>

#include "planner/model/plan/cutter/cutter.h"

namespace capstan::model {

/// Whether somebody said the value of a cutter's field; what counts for all fields stands under "*".
[[nodiscard]] bool is_stated(const Cutter& c, std::string_view field);

}  // namespace capstan::model
