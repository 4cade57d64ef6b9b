#pragma once

#include <string_view>

#include "planner/model/plan/cutter/cutter.h"

namespace capstan::model {

/// Whether somebody stated the value of a cutter's field; the key "*" states all fields.
[[nodiscard]] bool is_stated(const Cutter& c, std::string_view field);

}  // namespace capstan::model
