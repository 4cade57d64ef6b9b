#pragma once

#include <optional>

#include "planner/ground/base/job.h"
#include "planner/model/plan/cutter/cutter.h"
#include "tooling/library/records/records.h"

namespace capstan::tooling {

/// The lines of a machine's tool table, each kept word by word with the cutter that it is about.
class TableLines {
 public:
  /// `against_reference` as LibraryOptions::offsets_against_reference.
  TableLines(const ToolLibrary& library, std::optional<bool> against_reference);

  /// Gives the cutter its line, and its length where the line's Z is one (model::take_table_line). A length
  /// that the library states stays. Warns  TOOL-OFFSET where Z is no length: once for a table whose Z count
  /// from a reference, else for each tool.
  void give(const MachineEntry& entry, double mm_per_unit, model::Cutter& c, Job& job);

 private:
  const ToolLibrary& l_;
  int zeros_ = 0;  ///< lines of tools whose Z is 0, or not there
  bool against_reference_ = false, told_ = false;
  std::size_t doubted_ = 0;  ///< tools whose Z is no length, said so far
};

}  // namespace capstan::tooling
