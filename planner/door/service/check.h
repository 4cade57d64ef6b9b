#pragma once

#include <cstddef>
#include <functional>
#include <vector>

#include "planner/door/service/planning.h"
#include "planner/door/service/request.h"
#include "planner/ground/base/job.h"

namespace capstan::service {

/// Result of checking files.
struct CheckResult {
  std::vector<FileFinding> findings;
  std::size_t count = 0;      ///< findings without notes
  std::size_t schema = 0;     ///< deviations from the schema, if requested
  std::size_t checked = 0;    ///< plans and programs looked at
  std::size_t unplanned = 0;  ///< features that a file only names, and that cannot be planned
  // Further numbers for the last line (ending/last_line.h).
  std::size_t features = 0;      ///< of the plans, planned or not
  std::size_t left_out = 0;      ///< of these, not planned
  std::size_t planned_anew = 0;  ///< plans checked as they would be planned now: not all paths are in the
                                 ///< file, or values were edited
  std::size_t compared = 0;      ///< files that were compared with the schema only
  std::size_t errors = 0;        ///< of reading: what they are about is not checked
  [[nodiscard]] bool clean() const { return count == 0 && schema == 0 && unplanned == 0; }
};

/// Proves plans and programs safe, or lists their faults. The kind of each source is found by its content
/// (content_of). Programs are checked against the first plan, with the tool table among the sources.
///
/// `tell` (may be empty) is called for each finding, after all checks, file by file in the order of the
/// sources. Fails  APP-STOPPED when a stop came before anything was checked; later it is the finding
/// CHK-STOPPED.
///        APP-NOTHING when there is neither a plan nor a program; as the readers.
[[nodiscard]] Outcome<CheckResult> check(const Request& request, std::vector<Source> sources,
                                         const std::function<void(const FileFinding&)>& tell, Job& job);

}  // namespace capstan::service
