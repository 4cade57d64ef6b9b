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

/// What the operator corrects by what was measured: the work offset for a place; for a size what the tool of
/// the step after it is set by.
struct Remedy {
  std::string message;  ///< "set T5 to what is missing": for a message
  std::string comment;  ///< how, where that needs saying
};
[[nodiscard]] Remedy remedy_of(const model::Plan& plan, const std::vector<model::AnyRef>& probings,
                               model::AnyRef before);

}  // namespace capstan::output
