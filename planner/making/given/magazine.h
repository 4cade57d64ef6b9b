#pragma once

#include <string>
#include <vector>

#include "planner/ground/base/job.h"
#include "planner/ground/base/result.h"
#include "planner/model/plan/plan.h"

namespace capstan::given {

/// Holds the tools of a plan against what is in the magazine (of `library`, Cutter::pocket > 0).
///
/// A tool that is there (same class and diameter, or the same id) keeps its decisions and takes pocket and
/// length from the table; one that is not is re-opened, and with it, by the ledger, what depends on it.
/// `library` then has the plan's tools as they are loaded, and the loaded ones that it does not name.
/// Gives what was re-opened, one sentence each, in the order of the plan.
/// Fails  LATE-TOOL for a tool of the plan that is there and whose length the table does not tell
///        (model::offset_fault). A loaded tool like that which the plan does not name is not used.
[[nodiscard]] Result<std::vector<std::string>> match_loaded(model::Plan& plan,
                                                            std::vector<model::Cutter>& library, Job& job);

/// The cutter of the magazine (Cutter::loaded, a pocket) that is this one by class and every size that both
/// know, whatever it is called; of several a measured one, then that of the same name, then of the same
/// number, then of the lowest; null when none is.
[[nodiscard]] const model::Cutter* loaded_like(const std::vector<model::Cutter>& library,
                                               const model::Cutter& wanted);

/// The tool is as long as it is in the magazine, and stands out no farther; the line of the machine's tool
/// table goes with it.
void take_length(const model::Cutter& loaded, model::Cutter& into);

}  // namespace capstan::given
