#pragma once

#include <map>
#include <string>
#include <vector>

#include "planner/model/plan/plan.h"

namespace capstan::controls::gcode {

/// The measurements of the workplan by the step that they come before, in its order; those after the last
/// step under an unset handle.
[[nodiscard]] std::map<model::AnyRef, std::vector<model::AnyRef>> probings_before(const model::Plan& plan);

/// What is measured, in lines for a person: the first says all that must be known. mm.
[[nodiscard]] std::vector<std::string> probing_text(const model::Plan& plan, model::AnyRef probing);

/// What the operator does by what was measured, and when the program may go on: for a place the work offset
/// is corrected, for a depth the tool's length, a boring tool's slide is set. A mill's radius acts in the
/// plan only, so that a size that it left wrong asks for a new plan, and the sizes that are right are named.
struct Remedy {
  std::string message;                ///< "correct the work offset, then continue": for a message
  std::vector<std::string> comments;  ///< how, where that needs saying
};
[[nodiscard]] Remedy remedy_of(const model::Plan& plan, const std::vector<model::AnyRef>& probings,
                               model::AnyRef before);

}  // namespace capstan::controls::gcode
