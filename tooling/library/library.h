#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "planner/ground/base/job.h"
#include "planner/ground/base/result.h"
#include "planner/model/plan/cutter/cutter.h"

namespace capstan::tooling {

struct LibraryOptions {
  /// Of a LinuxCNC tool table, which does not say: 1 or 25.4. Unset: millimetres, with a note.
  std::optional<double> mm_per_unit;
  /// Whether the Z of a machine's tool table count from a reference tool or gauge (Control). Unset: they do
  /// when one of them is negative.
  std::optional<bool> offsets_against_reference;
};

/// Loads a tool library from a file or folder, whose content decides its kind: our own list (YAML or JSON,
/// tooling/data/README.md), or any format of `tooling/library/formats` that can be read. "generic" is the
/// shipped one, "generic-inch" the same with inch sizes.
///
/// Fields that the file leaves out are completed from the generic series (see complete.h), each with its
/// source. Entries that cannot be used (no diameter, a kind that planning does not know) are left out, with a
/// warning that says which and why.
/// Fails  NAME-UNKNOWN for a text without folder and ending that is no file; FILE-*, LIBRARY-KIND, DATA-*,
/// TOOL-VALUE, TOOL-ID, TOOL-NUMBER, TBL-SYNTAX, with file and place, and
///        as the formats; every fault is reported to the job, the last is the result's.
[[nodiscard]] Result<std::vector<model::Cutter>> load_library(const std::string& path, Job& job,
                                                              const LibraryOptions& options = {});
[[nodiscard]] Result<std::vector<model::Cutter>> read_library(std::string_view text, const std::string& file,
                                                              Job& job, const LibraryOptions& options = {});

/// A LinuxCNC tool table: `T1 P1 D6 Z+80.5 ;6 mm end mill, 2 flutes`.
[[nodiscard]] Result<std::vector<model::Cutter>> read_tool_table(std::string_view text,
                                                                 const std::string& file, Job& job,
                                                                 const LibraryOptions& options = {});

}  // namespace capstan::tooling
