#pragma once

#include <cmath>
#include <string>
#include <utility>
#include <vector>

namespace capstan::validation {

/// What of a table's power ours may be off by.
inline constexpr double kPowerBound = 0.25;

/// One cut by a published table of milling power and by ours, kW at the tool.
struct PowerRow {
  std::string source, material, row;
  double fz_mm = 0.0, table_kw = 0.0, ours_kw = 0.0;
  [[nodiscard]] double ratio() const { return ours_kw / table_kw; }
  [[nodiscard]] bool within() const { return std::abs(ratio() - 1.0) <= kPowerBound; }
};
[[nodiscard]] std::vector<PowerRow> power_rows();

/// Of one source: rows within the bound, and all.
[[nodiscard]] std::pair<int, int> rows_within(const std::vector<PowerRow>& rows, const std::string& source);

}  // namespace capstan::validation
