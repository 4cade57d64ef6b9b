#pragma once

#include <string>
#include <vector>

#include "rules/engine/table.h"
#include "rules/facts/facts.h"

namespace capstan::rules {

/// Tables that turn what is asked beside sizes into what a chain must be like. Each asks about `shape` and
/// one demand, so that the tables of chains need not repeat every roughness for every grade.
///
/// Values  as_grade: the chain is chosen as if the size had this ISO 286 grade, when that is the finer one;
///         machined: 1: a hole's wall is placed by the axes of the machine, not by a drill before: no reamer;
///         probe: 1: the feature (or its datum) is measured before the last step, and the operator corrects
///         the work offset by what is found.
inline constexpr std::string_view kDemandTables[] = {"texture", "position", "form"};
inline constexpr int kNoGrade = 19;  ///< as_grade of a row that asks for none

/// What texture and geometric tolerances add to one feature's facts.
struct Demand {
  std::string cannot;          ///< a row that says that nothing here makes it
  std::string text;            ///< the rows that asked for something, with id and source; for the reason
  const Row* probe = nullptr;  ///< the row that wants probing, if any
};

/// Asks the demand tables (those that there are) and narrows `known`: it_grade, reamer.
[[nodiscard]] Demand apply_demands(const RuleBase& base, FeatureFacts& known);

}  // namespace capstan::rules
