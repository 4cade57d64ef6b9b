#pragma once

#include <optional>
#include <set>
#include <string>
#include <vector>

#include "planner/door/pipeline/pipeline.h"
#include "planner/model/plan/plan.h"

namespace capstan::late {

/// The card of the work's material as it is now; nothing where it has none: planning says why.
[[nodiscard]] std::optional<model::WorkMaterial> material_now(const model::Plan& plan,
                                                              const pipeline::Inputs& inputs);

/// How the material `now` is another than the plan was made for, by name or by what its card says, in words;
/// empty: it is the same, or there is none.
[[nodiscard]] std::string other_material(const model::Plan& plan,
                                         const std::optional<model::WorkMaterial>& now);

/// Speeds and feeds that planning chose, which another material asks anew: for the ledger to re-open. What a
/// file or the operator gave, and what is pinned, stays. `cut`: operations of steps that are cut already.
[[nodiscard]] std::vector<model::DecisionKey> planned_speeds(const model::Plan& plan,
                                                             const std::set<model::AnyRef>& cut);

}  // namespace capstan::late
