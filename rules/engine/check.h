#pragma once

#include <string>
#include <vector>

#include "rules/engine/table.h"

namespace capstan::rules {

enum class RuleFault : std::uint8_t {
  kGap,            ///< a box of conditions for which no row (or only a catch-all row) decides
  kContradiction,  ///< rows of equal priority that overlap and conclude differently
  kDeadRow,        ///< a row that never decides: rows of better priority cover it
  kIncapable,      ///< a chain that does not hold a grade, roughness, position or form that its row accepts
  kNoTable,        ///< a kind of feature for which there is no table of chains
};
[[nodiscard]] std::string_view to_text(RuleFault f);
[[nodiscard]] std::string_view code_of(RuleFault f);  ///< "RULE-GAP", "RULE-DEAD-ROW", ... for diagnostics

/// One fault of the tables, with the box of conditions it concerns.
struct RuleFinding {
  RuleFault fault = RuleFault::kGap;
  std::string table;
  std::vector<std::string> rows;  ///< the ids concerned; empty for a gap
  std::string box;                ///< "bottom in {flat}, it_grade in [1, 7)"
  std::string file;
  std::uint64_t line = 0;
  /// "hole: gap: no row for diameter_mm in [0, 0.5)"
  [[nodiscard]] std::string text() const;
};

/// Kinds of feature (symbols of fact `shape`) and the table that decides their chains; each must be there.
/// Compounds, patterns and counterbored holes are made of these.
struct ShapeTable {
  std::string_view shape, table;
};
[[nodiscard]] const std::vector<ShapeTable>& shape_tables();

/// Proves the tables, by exact differences of boxes: no finding means that every combination of the facts
/// that a table names is decided by exactly one conclusion, that every row decides somewhere, and that each
/// chain holds what its row accepts, by the capabilities of its steps and the tables of demands.
/// Cost    rows^2 boxes per table in the worst case; the shipped tables take milliseconds.
[[nodiscard]] std::vector<RuleFinding> check_tables(const RuleBase& base);

/// As `check_tables`, and that each kind of feature has its table and each table that chains consult is
/// there.
[[nodiscard]] std::vector<RuleFinding> check(const RuleBase& base);

}  // namespace capstan::rules
