#pragma once

#include <string>
#include <vector>

#include "rules/engine/table.h"
#include "rules/facts/facts.h"

namespace capstan::rules {

/// Tables that turn requirements beside sizes into properties of a chain. Each uses `shape` and one demand,
/// so that the tables of chains need not repeat every roughness for every grade.
///
/// Values  as_grade: the chain is chosen as if the size had this ISO 286 grade, when that is the finer one;
///         machined: 1: a hole's wall is placed by the axes of the machine, not by a drill before: no reamer;
///         probe: 1: the feature (or its datum) is measured before the last step, and the operator corrects
///         the work offset by what is found.
inline constexpr std::string_view kDemandTables[] = {"texture", "position", "form"};
inline constexpr int kNoGrade = 19;  ///< as_grade of a row that requires none

/// Additions of texture and geometric tolerances to one feature's facts.
struct Demand {
  std::string cannot;          ///< why no process here makes it; empty: one does
  std::string text;            ///< the rows with a requirement, with id and source; for the reason
  const Row* probe = nullptr;  ///< the row that requires probing, if any
};

/// Asks the demand tables (those that there are) and narrows `known`: it_grade, reamer.
[[nodiscard]] Demand apply_demands(const RuleBase& base, FeatureFacts& known);

}  // namespace capstan::rules
