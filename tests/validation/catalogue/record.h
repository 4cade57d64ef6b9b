#pragma once

#include <optional>
#include <string>
#include <vector>

#include "tests/sweep/sweep.h"

// The record of the sweep's cases, docs/validation/catalogue_times.csv: a row for each plan.

namespace capstan::validation::catalogue {

/// What became of a case, as the record keeps it: times to a tenth of a second.
struct Row {
  std::string machine, feature, material;
  double plan_s = 0.0;       ///< 0: a feature of it is not made
  double catalogue_s = 0.0;  ///< 0: the catalogue has no such tool
  std::size_t not_made = 0;  ///< features
  std::string clearing;      ///< of areas for which both were tried: "rings", "constant engagement" or "both"
  std::string broken;        ///< what the plan promises and does not keep, its beginning
  std::string refused;       ///< the first reason, its beginning
  [[nodiscard]] bool whole() const { return not_made == 0; }
  [[nodiscard]] double ratio() const { return whole() && catalogue_s > 0.0 ? plan_s / catalogue_s : 0.0; }
  friend bool operator==(const Row&, const Row&) = default;
};

[[nodiscard]] Row row_of(const testing::sweep::Case& c, const testing::sweep::Outcome& o);
/// The row of a case; nothing where the record has none.
[[nodiscard]] std::optional<Row> row_for(const std::vector<Row>& record, const testing::sweep::Case& c);

/// Names, then a line for each row.
[[nodiscard]] std::string written(const std::vector<Row>& rows);
/// Throws std::runtime_error at a row that is not as `written` writes it.
[[nodiscard]] std::vector<Row> read(const std::string& text);

/// Where a case that is planned now is apart from its row by more than rounding, in words; empty: nowhere.
[[nodiscard]] std::string apart(const Row& recorded, const Row& now);

}  // namespace capstan::validation::catalogue
