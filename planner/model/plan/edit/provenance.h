#pragma once

#include <vector>

#include "planner/model/plan/edit/edit.h"
#include "planner/model/plan/plan.h"

// The edits that a plan was made with, as rows of its provenance, which every form of a plan keeps.

namespace capstan::model {

[[nodiscard]] Provenance provenance_of(const Edit& e);
[[nodiscard]] bool is_edit(const Provenance& p);
/// In order; rows that hold no edit are left out.
[[nodiscard]] std::vector<Edit> edits_of(const Plan& plan);

}  // namespace capstan::model
