#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "planner/ground/base/job.h"
#include "planner/ground/base/result.h"

namespace capstan::tooling::csv {

/// The content of a column. Fields:
///   id group description class kind manufacturer product_id product_link comment unit number pocket carousel
///   in_stock price life_min life_used_min stick_out length not_stated
///   holder.id .description .manufacturer .product_id .product_link .gage .segments
///   preset preset.material .coolant .n .v_c .f_z .f_n .v_f .v_f_plunge .v_f_ramp .ramp-angle .stepdown
///   .stepover
///   offset.X .. offset.Q, property symbols (DC, LCF, ...); keep: kept as it is; ignore: left out
struct Column {
  std::string title, field;
  std::string unit;  ///< mm, in, deg; L: the tool's; empty: by the map or the column `unit`
};

/// The columns of a table, as found or as saved.
struct ColumnMap {
  char separator = ',';
  char decimal = '.';
  std::string unit;  ///< mm or in for lengths whose unit is stated nowhere else; may be empty
  std::vector<Column> columns;
};

/// The map by the titles: ours, those of Fusion's export, and common English and German words
/// ("Diameter [mm]", "Schneidenzahl").
[[nodiscard]] ColumnMap map_of_titles(const std::vector<std::string>& titles, char separator);
/// As it was saved (YAML, capstan_columns: 1).
/// Fails  DATA-*, with file and line.
[[nodiscard]] Result<ColumnMap> read_map(std::string_view text, const std::string& file, Job& job);
[[nodiscard]] std::string map_text(const ColumnMap& map);
/// Whether a field is one of a preset, of a tool's length (in the tool's unit), or text.
[[nodiscard]] bool is_known_field(std::string_view field);

}  // namespace capstan::tooling::csv
