#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "planner/ground/base/job.h"
#include "planner/ground/base/result.h"
#include "rules/engine/box.h"
#include "rules/engine/fact.h"

namespace capstan::rules {

/// A number that a row gives, by name: "allowance_side_mm".
using Parameters = std::vector<std::pair<std::string, double>>;
[[nodiscard]] std::optional<double> find(const Parameters& p, std::string_view name);

/// One step of a chain: which action makes it, and the numbers that row gives it.
struct StepSpec {
  std::string action;
  Parameters parameters;
  friend bool operator==(const StepSpec&, const StepSpec&) = default;
};

/// One row: where the conditions hold, and what follows there. Exactly one of `chains` (alternatives, best
/// first), `cannot` (the reason) and `values` (numbers for another table's steps) is set.
struct Row {
  std::string id;
  int priority = 100;        ///< of the rows that hold, the lowest decides
  Box when;                  ///< over the table's facts; sides not asked about span the domain
  bool conditional = false;  ///< asks about anything at all
  std::vector<std::vector<StepSpec>> chains;
  std::string cannot;
  Parameters values;
  std::string text, source;
  std::string file;
  std::uint64_t line = 0;
  [[nodiscard]] bool concludes_as(const Row& other) const {
    return chains == other.chains && cannot == other.cannot && values == other.values;
  }
};

struct Table {
  std::string name;
  std::vector<std::size_t> facts;  ///< into fact_types()
  std::vector<Row> rows;           ///< by (priority, id)
  std::string file;
};

/// The best result of a process, to check rows against. Unset: no claim.
struct Capability {
  std::string action;
  std::optional<int> finest_grade;     ///< finest ISO 286 grade it holds
  std::optional<double> finest_ra_um;  ///< finest roughness Ra it makes
  std::optional<double> position_mm;   ///< smallest zone of position it keeps
  std::optional<double> form_mm;       ///< smallest zone of form and orientation it keeps
  std::string source;
};

/// All tables. Begin with `load_rules`.
struct RuleBase {
  std::vector<Table> tables;  ///< by name
  std::vector<Capability> capabilities;
  [[nodiscard]] const Table* table(std::string_view name) const;
  [[nodiscard]] const Capability* capability(std::string_view action) const;
};

/// The row that decides: among those whose conditions hold, the one of lowest priority number (then of lowest
/// id, which matters only in a table that `check` refuses). Null if none holds.
/// Needs   a value for each fact of the table; `missing_fact` gives one that is missing.
[[nodiscard]] const Row* decide(const Table& table, const Facts& facts);
/// The first fact of the table that is unknown or outside its domain; nothing if there is none.
[[nodiscard]] std::optional<std::size_t> missing_fact(const Table& table, const Facts& facts);

/// The shipped tables, with the rows of each *.yaml of `extra_directory` (when not empty) added; a row with
/// the id of a shipped one takes its place.
/// Fails   RULE-IO, RULE-SYNTAX, RULE-TABLE, RULE-FACT, RULE-ROW, with file and line.
[[nodiscard]] Result<RuleBase> load_rules(const std::string& extra_directory, Job& job);

/// As `load_rules`, from texts (name, text): for tests and for tables that come from elsewhere.
[[nodiscard]] Result<RuleBase> rules_from_texts(
    const std::vector<std::pair<std::string, std::string>>& named_texts);
/// The shipped tables' texts, by name.
[[nodiscard]] std::vector<std::pair<std::string, std::string>> shipped_texts();

}  // namespace capstan::rules
