#pragma once

#include <string_view>
#include <vector>

#include "planner/model/plan/edit/edit.h"
#include "planner/model/plan/plan.h"

// The edits that a plan was made with, as rows of its provenance, which every form of a plan keeps.

namespace capstan::model {

[[nodiscard]] Provenance provenance_of(const Edit& e);
[[nodiscard]] bool is_edit(const Provenance& p);
/// In order; rows that hold no edit are left out.
[[nodiscard]] std::vector<Edit> edits_of(const Plan& plan);

/// The row of provenance that names the file of edits. It says all edits that there are: a value that an edit
/// held before, and none holds now, is open again.
inline constexpr std::string_view kEditsFile = "edits";
[[nodiscard]] bool edits_are_all(const std::vector<Provenance>& inputs);

}  // namespace capstan::model
