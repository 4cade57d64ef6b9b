#pragma once

#include <string>
#include <vector>

#include "planner/making/draft/draft.h"
#include "planner/making/propose/choose.h"
#include "planner/model/plan/plan.h"

namespace capstan::propose {

/// Whether it is known which of these cutters are loaded.
[[nodiscard]] bool magazine_known(const std::vector<model::Cutter>& cutters);

/// A tool that few steps use gives way where others of the plan can do all it does, and the estimated time
/// that costs is less than the tool's change (and loading, where the magazine is known). Least-used tools
/// first; until nothing changes. Each change is in the ledger with its figures. Gives the ids that are used
/// then, each once.
///
/// With thrift a tool gives way whatever that costs, up to kMostForFewerS of a step, and to any class that
/// the rules name for the step; `back`: the pockets that are free then are filled again, the greatest gain
/// first.
struct Sharing {
  bool magazine_known = false;
  int batch = 1;  ///< pieces
  Thrift thrift = Thrift::kNone;
  bool back = false;
};
[[nodiscard]] std::vector<std::string> share_tools(model::Plan& plan, std::vector<draft::StepDraft>& steps,
                                                   const Sharing& how);

}  // namespace capstan::propose
