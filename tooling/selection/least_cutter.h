#pragma once

#include <optional>

#include "planner/model/plan/cutter/cutter.h"
#include "planner/model/plan/requirement.h"
#include "planner/model/plan/resources/machine.h"
#include "planner/model/plan/resources/material.h"
#include "tooling/selection/select.h"

namespace capstan::tooling {

/// The least cutter that meets a requirement on this machine, for a shop to buy or load: of the first class
/// that will do, of a size that the generic series have where one lies within the limits, as long as asked
/// for, all else as the nearest generic cutter. Nothing where no cutter would do: the machine, or the
/// material, excludes it.
[[nodiscard]] std::optional<model::Candidate> needed_cutter(const model::ToolRequirement& requirement,
                                                            const model::WorkMaterial& material,
                                                            const model::Machine& machine,
                                                            const Preferences& preferences);

}  // namespace capstan::tooling
