#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "planner/ground/base/job.h"
#include "planner/ground/base/result.h"
#include "tooling/library/records/records.h"

namespace capstan::tooling {

/// So many entries of a library are reported one by one, then their number: what a person still reads.
/// Default, unsourced.
inline constexpr std::size_t kEntriesShown = 20;

/// What reading or writing a format may need beside the file.
struct FormatOptions {
  /// For formats that do not state their unit (LinuxCNC tables, some CSV): 1 or 25.4.
  std::optional<double> mm_per_unit;
  /// CSV: column title -> symbol or field, as saved by an earlier import; a file's text.
  std::string column_map;
  /// Of writing: the file's path, whose ending says which of a format's forms is wanted; empty: the usual
  /// one.
  std::string to = {};
};

struct Imported {
  ToolLibrary library;
  LossReport report;
};
struct Exported {
  std::string bytes;
  LossReport report;
  /// Files that belong to it: their paths from its folder, and bytes.
  std::vector<std::pair<std::string, std::string>> beside = {};
};

/// A file format of tool libraries. `read` and `write` are null where the format is one-way.
///
/// Fails   each bad input with one Diagnostic that names file, line or element, what was expected and what to
///         do; entries that cannot be used are reported in LossReport::dropped, not as failures.
struct Format {
  std::string_view name;                  ///< "fusion", "csv", "linuxcnc", "iso13399", "freecad", ...
  std::string_view title;                 ///< for people
  std::vector<std::string_view> endings;  ///< ".tools", ".json"; the first one is written
  bool (*recognises)(std::string_view bytes, std::string_view file) = nullptr;  ///< decides by content
  Result<Imported> (*read)(std::string_view bytes, const std::string& file, const FormatOptions& options,
                           Job& job) = nullptr;
  Result<Exported> (*write)(const ToolLibrary& library, const FormatOptions& options, Job& job) = nullptr;
};

/// All formats, in the order their contents are tried.
[[nodiscard]] const std::vector<Format>& formats();
[[nodiscard]] const Format* find_format(std::string_view name);

/// Reads a library from a file or, for formats of many files (FreeCAD), a folder. The format is found by
/// content.
/// Fails  FILE-*, LIBRARY-KIND, and as the format.
[[nodiscard]] Result<Imported> import_library(const std::string& path, const FormatOptions& options,
                                              Job& job);

/// The cutters for planning: assemblies first, then items without one; each value with its source, missing
/// ones completed as in `complete.h`. Items of no known class are left out; `report` says so.
/// Fails  what `check_cutters` finds.
[[nodiscard]] Result<std::vector<model::Cutter>> cutters_of(
    const ToolLibrary& library, LossReport& report, Job& job,
    std::optional<bool> offsets_against_reference = std::nullopt);
/// The other way: a cutter's fields as records, nothing invented.
[[nodiscard]] ToolLibrary library_of(const std::vector<model::Cutter>& cutters, std::string name);

}  // namespace capstan::tooling
