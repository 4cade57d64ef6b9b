#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "planner/ground/vocabulary/cutter_class.h"
#include "planner/model/plan/plan.h"

namespace capstan::model {

/// A tool of which nobody stated what it is made of, and what the plan takes it to be. It stands in the
/// plan's provenance, which every form of a plan keeps: planning again takes the same.
struct AssumedToolMaterial {
  std::string tool;  ///< id of the cutter
  Substrate substrate = Substrate::kHss;
  std::string why;
  bool settled = false;  ///< by the caller (--assume)
};

/// Those of a plan, in the order of its provenance.
[[nodiscard]] std::vector<AssumedToolMaterial> assumed_tool_materials(const Plan& plan);
/// That of one cutter; nothing where its material is stated.
[[nodiscard]] std::optional<AssumedToolMaterial> assumed_material_of(const Plan& plan,
                                                                     std::string_view cutter);
/// The row of provenance that says it.
[[nodiscard]] Provenance provenance_of(const AssumedToolMaterial& a);
/// What a row of provenance says, if it is such a one.
[[nodiscard]] std::optional<AssumedToolMaterial> assumed_tool_material(const Provenance& p);

/// What the sources of a material begin with that the caller settled (--assume).
inline constexpr std::string_view kSettledBy = "settled: ";
/// How a tool table's comment says it: "assumed carbide". Who reads the table takes no statement from it.
inline constexpr std::string_view kAssumedWord = "assumed ";

}  // namespace capstan::model
