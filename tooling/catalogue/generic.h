#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "planner/ground/base/job.h"
#include "planner/ground/base/result.h"
#include "planner/model/plan/cutter.h"
#include "planner/model/plan/material.h"

namespace capstan::tooling {

/// The generic library: tooling/data/cutters.yaml expanded, some 450 sizes, ids "generic/<series>/<size>".
/// None can be bought by this name; every number says "default: ..." in Cutter::sources.
/// Presets: one per shipped material, and one per ISO 513 group for materials of other tables.
[[nodiscard]] Result<std::vector<model::Cutter>> generic_library();
/// The same, made once.
[[nodiscard]] const Result<std::vector<model::Cutter>>& shared_generic_library();

/// As above from texts of the same form.
/// Fails  DATA-*, and what `check_cutters` finds.
[[nodiscard]] Result<std::vector<model::Cutter>> expand_series(
    std::string_view text, const std::string& file, const std::vector<model::WorkMaterial>& materials,
    Job& job);

}  // namespace capstan::tooling
