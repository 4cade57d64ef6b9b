#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "casebase/retain/join/join.h"
#include "planner/door/service/request.h"
#include "planner/ground/base/job.h"
#include "planner/ground/base/result.h"
#include "planner/model/plan/plan.h"

/// Logs of machines kept as cases, for every caller: the command and the library.
namespace capstan::service {

/// What the period of a log may be, s.
inline constexpr double kLeastPeriodS = 1e-6, kMostPeriodS = 1.0;

/// What is known of logs beside the logs.
struct LogImport {
  std::string format, plan, program, inspection;  ///< a word (retain::kLogFormats); files
  std::vector<std::string> parts;                 ///< numbers of the parts: one per file, or none
  std::string machine;                            ///< serial number
  std::string unit;                   ///< mm or inch, where a log does not say; empty: its format's
  std::vector<std::string> triggers;  ///< "lag_mm>0.05:0.2"
  std::vector<std::string> columns;
  double period_s = 0.001;  ///< of LinuxCNC's servo thread, kLeastPeriodS to kMostPeriodS
};

/// The steps of a plan's file, or of a sheet (`casebase::retain::read_sheet`); the plan, where it is one.
struct PlannedSteps {
  std::optional<model::Plan> plan;
  std::vector<casebase::retain::Step> steps;
};
[[nodiscard]] Result<PlannedSteps> read_steps(const std::string& path, Job& job);
/// The markers of a plan's program. Fails LOG-PROGRAM.
[[nodiscard]] Result<casebase::retain::ProgramMarks> read_marks(const std::string& path,
                                                                const PlannedSteps& planned);

/// What came of an import.
struct ImportedLogs {
  std::size_t cases = 0;  ///< that the logs make
  std::size_t added = 0;  ///< that were not there before
  std::size_t held = 0;   ///< in the base now
};

/// Keeps what logs show of a plan's workingsteps as cases of a base (file or URI; made where there is none):
/// all cases of all logs, or none.
/// Fails   USAGE-IMPORT for a wrong word or no log, kUsage; as the readers (retain/join/import.h),
/// kUnreadable; as
///         `CaseBase::add`, kImpossible.
[[nodiscard]] Outcome<ImportedLogs> import_logs(const std::string& base, const std::vector<std::string>& logs,
                                                const LogImport& asked, Job& job);

}  // namespace capstan::service
