#pragma once

#include <vector>

#include "planner/door/service/options.h"

namespace capstan::service {

/// The options that say of a CAD file what it does not say itself: which body, which holes are tapped, how
/// far it is planned.
[[nodiscard]] std::vector<Option> cad_options();

}  // namespace capstan::service
