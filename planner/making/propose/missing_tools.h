#pragma once

#include <vector>

#include "planner/making/propose/choose.h"
#include "planner/model/plan/needed_tool.h"

namespace capstan::propose {

/// The tools that a shape lacks which no chain can make with the cutters there are: those of the chain that
/// lacks the fewest, of equal ones the first. Empty where tools alone do not help: every chain fails for
/// another reason.
[[nodiscard]] std::vector<model::NeededTool> needed_tools(const Choice& choice, const model::Proposal& p,
                                                          const model::FeatureShape& shape,
                                                          const draft::Member& member,
                                                          const std::vector<std::string>& used);

}  // namespace capstan::propose
