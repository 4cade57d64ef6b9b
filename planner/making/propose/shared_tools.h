#pragma once

#include <string>
#include <vector>

#include "planner/making/draft/draft.h"
#include "planner/model/plan/plan.h"

namespace capstan::propose {

/// Whether it is known which of these cutters are loaded.
[[nodiscard]] bool magazine_known(const std::vector<model::Cutter>& cutters);

/// A tool that few steps use gives way where others of the plan can do all it does, and the estimated time
/// that costs is less than the tool's change (and loading, where the magazine is known). Least-used tools
/// first; until nothing changes. Each change is in the ledger with its figures. Gives the ids that are used
/// then, each once. `batch`: pieces.
[[nodiscard]] std::vector<std::string> share_tools(model::Plan& plan, std::vector<draft::StepDraft>& steps,
                                                   bool magazine_known, int batch);

}  // namespace capstan::propose
