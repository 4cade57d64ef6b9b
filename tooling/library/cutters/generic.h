#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "planner/ground/base/job.h"
#include "planner/ground/base/result.h"
#include "planner/model/plan/cutter/cutter.h"
#include "planner/model/plan/resources/material.h"
#include "tooling/shop/data/tree.h"

namespace capstan::tooling {

enum class Sizes { kMetric, kMetricAndInch };

/// The generic library: tooling/data/cutters.yaml and series/*.yaml there expanded, some 1000 sizes, with
/// inch/*.yaml 360 more, ids "generic/<series>/<size>". None can be bought by this name; every number says
/// "default: ..." in Cutter::sources. Presets: one per shipped material, and one per ISO 513 group for
/// materials of other tables.
[[nodiscard]] Result<std::vector<model::Cutter>> generic_library(Sizes sizes = Sizes::kMetric);
/// What a list of tools is named by that is the generic library, and that with inch sizes (data/inch/*.yaml).
inline constexpr std::string_view kGeneric = "generic", kGenericInch = "generic-inch";
/// The one of metric sizes, made once.
[[nodiscard]] const Result<std::vector<model::Cutter>>& shared_generic_library();

/// Name, in the source of a generic preset, of the speed of the material it is made for.
inline constexpr std::string_view kMaterialsSpeed = "the material's";

/// Adds start values for a material that is not shipped to cutters of a generic series: its speed in the same
/// proportion as the group's, the group's feed. Those that it added for a card of that id before, in cutters
/// that a plan has, become those of this card. Of a shipped material it changes nothing.
[[nodiscard]] Status add_start_values(const model::WorkMaterial& own, std::vector<model::Cutter>& library);

/// A file of series: its name and what stands in it.
struct SeriesFile {
  std::string name;
  Node root;
};

/// As `generic_library`, from files of the same form: the first has the tables (holding, edges, feeds) that
/// the series of all lean on. Fails  DATA-*, and what `check_cutters` finds.
[[nodiscard]] Result<std::vector<model::Cutter>> expand_series(
    const std::vector<SeriesFile>& files, const std::vector<model::WorkMaterial>& materials, Job& job);

}  // namespace capstan::tooling
