#pragma once

#include <vector>

#include "planner/model/plan/edit/restrictions.h"

// Which of several edits holds.

namespace capstan::model {

/// The edit that sets or pins a value of a step: of several that mean the step the one that names it most
/// closely - its own name or id before its feature's, that before a pattern, of two patterns the one with
/// more letters, any of them before all steps -, of equally close ones the last; null: none does.
[[nodiscard]] const Edit* deciding(const std::vector<Edit>& edits, EditOf of, const StepNames& step);

/// Whether an edit bounds a size of tools, and so which of them may be chosen.
[[nodiscard]] bool is_tool_limit(const Edit& e);

/// Whether two edits differ in nothing but where they are from.
[[nodiscard]] bool says_the_same(const Edit& a, const Edit& b);

}  // namespace capstan::model
