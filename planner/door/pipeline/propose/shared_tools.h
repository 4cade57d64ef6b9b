#pragma once

#include "planner/door/pipeline/work.h"
#include "tooling/selection/select.h"

// Tools over the whole plan; only planner/door/pipeline/*.cpp include this.

namespace capstan::pipeline {

/// What a proposed step removes, as selection asks: from the feature's geometry, rest machining and islands
/// not taken off (more, not less).
[[nodiscard]] tooling::Preferences preferences_of(const Work& w, const model::ProposedStep& step,
                                                  const model::FeatureShape& shape);

/// A tool that few steps use gives way where others of the plan can do all it does, and the estimated time
/// that costs is less than the tool's change (and loading, where the magazine is known). Least-used tools
/// first; until nothing changes. Each change is in the ledger with its figures.
void share_tools(Work& w);

}  // namespace capstan::pipeline
