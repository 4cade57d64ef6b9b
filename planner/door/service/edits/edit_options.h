#pragma once

#include <vector>

#include "planner/door/service/options.h"

namespace capstan::service {

/// The options by which a person edits a plan: a row for each kind of edit, and one for the file of them.
[[nodiscard]] std::vector<Option> edit_options();

}  // namespace capstan::service
