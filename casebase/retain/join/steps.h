#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "casebase/casebase.h"

/// What a log is joined with: the workingsteps of a plan, or of a sheet that describes a program that no plan
/// made.
namespace capstan::casebase::retain {

struct PartRange {
  long first = 0, last = 0;
};

/// One workingstep as it was to be cut.
struct Step {
  std::string id;  ///< persistent id of the workingstep
  int tool = 0;    ///< number of its tool in the program; 0: not known
  /// The case without what was observed. vc and fz of 0: the log says them.
  Case planned;
  std::vector<std::string> characteristics;  ///< of the inspection, that belong to it beside its own id
  std::vector<PartRange> parts;              ///< that were cut so; empty: all

  [[nodiscard]] bool is_for(std::string_view part) const;
};

/// The steps of a plan that make cases. Others are reported as notes (CASE-STEP).
[[nodiscard]] std::vector<Step> steps_of(const model::Plan& plan, Job& job);

/// Steps of a program that was not planned here, as a table: a step per row, its columns those of the cases'
/// CSV (`to_csv`) and `tool`, `characteristics` (names, blanks between them), `parts` ("1-9 20"). Needed are
/// operation, material_group, tool_class, machine_class, workingstep. Where vc_m_min and fz_mm are left out
/// or empty, they are taken from the log. Lines that begin with # are remarks.
///
/// Fails   LOG-SHEET with file and line: a column that is missing or unknown, a cell that cannot be.
[[nodiscard]] Result<std::vector<Step>> read_sheet(std::string_view text, const std::string& file);

}  // namespace capstan::casebase::retain
