#pragma once

#include <vector>

#include "planner/ground/base/result.h"
#include "planner/model/plan/edit/edit.h"
#include "planner/model/plan/plan.h"

// The names that edits use, before anything is planned.

namespace capstan::service {

/// Whether names that edits use are known before anything is planned: tools (a number only where the library
/// or the plan has numbers), kinds of operations, strategies.
/// Fails  NAME-UNKNOWN with those that may be meant; EDIT-NUMBER for a tool number that nothing gives yet.
[[nodiscard]] Status known_names(const std::vector<model::Edit>& edits,
                                 const std::vector<model::Cutter>& library, const model::Plan& plan);

/// The edits with each tool that is forbidden by its number (T5) under its name: that of the library's
/// numbers, else of the plan's. A number belongs to one table, and plans are made with others. Where an edit
/// is from keeps the number: "--forbid (T5)".
[[nodiscard]] std::vector<model::Edit> with_tool_names(std::vector<model::Edit> edits,
                                                       const std::vector<model::Cutter>& library,
                                                       const model::Plan& plan);

}  // namespace capstan::service
