#pragma once

#include "planner/ground/base/tables/separated.h"
#include "tooling/library/formats/csv/columns.h"
#include "tooling/library/formats/format.h"

namespace capstan::tooling::csv {

/// Where a library keeps the map it was read with: ToolLibrary::kept.
inline constexpr const char* kMapKey = "csv:map";

[[nodiscard]] Result<Imported> read(std::string_view bytes, const std::string& file,
                                    const FormatOptions& options, Job& job);
/// The rows below the titles, each cell by its column's meaning.
[[nodiscard]] Result<Imported> read_rows(const std::vector<SeparatedRow>& rows, const ColumnMap& map,
                                         const std::string& file, const FormatOptions& options, Job& job);
[[nodiscard]] Result<Exported> write(const ToolLibrary& library, const FormatOptions& options, Job& job);

/// "H6.5 L7.5 U9; H2 L9 U9": height, lower and upper diameter of each segment in the tool's unit.
[[nodiscard]] std::string segments_text(const std::vector<model::HolderSegment>& segments,
                                        double mm_per_unit);

}  // namespace capstan::tooling::csv
