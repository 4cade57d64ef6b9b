#pragma once

#include <map>
#include <string>
#include <vector>

#include "planner/model/plan.h"

namespace capstan::output {

/// The measurements of the workplan by the step that they come before, in its order; those after the last
/// step under an unset handle.
[[nodiscard]] std::map<model::AnyRef, std::vector<model::AnyRef>> probings_before(const model::Plan& plan);

/// What is measured, in lines for a person: the first says all that must be known. mm.
[[nodiscard]] std::vector<std::string> probing_text(const model::Plan& plan, model::AnyRef probing);

}  // namespace capstan::output
