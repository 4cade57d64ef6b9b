#pragma once

#include <cstdint>
#include <istream>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "casebase/retain/join/join.h"

/// A log as cases, in one call: read, split by workingstep, joined with what was planned and measured.
namespace capstan::casebase::retain {

enum class LogFormat : std::uint8_t {
  kTrace,     ///< `read_trace`
  kCsv,       ///< `read_table`
  kLinuxcnc,  ///< `read_linuxcnc`
  kTimes,     ///< `read_times`: no log, but times that somebody summed up, of several parts
  kWear,      ///< `read_wear`: no log, but the wear of edges over their cutting time
};
/// The format of a word ("trace", "csv", "linuxcnc", "times", "wear"), and the words, for people.
[[nodiscard]] std::optional<LogFormat> log_format_of(std::string_view word);
inline constexpr std::string_view kLogFormats = "trace, csv, linuxcnc, times or wear";

struct ImportOptions {
  std::optional<LogUnits> units = {};      ///< where names do not say; nothing: those of the format
  std::vector<std::string> columns = {};   ///< of tables without a first row of names
  double period_s = 0.001;                 ///< of LinuxCNC's servo thread; its default
  std::vector<Trigger> triggers = {};      ///< what makes a step a bad case
  const ProgramMarks* marks = nullptr;     ///< of the program; null: not known
  std::vector<Inspected> inspection = {};  ///< of these parts
};

/// A trigger of a text "lag_mm>0.05" or "load_percent>90:0.5" (for 0.5 s); nothing for another text.
[[nodiscard]] std::optional<Trigger> trigger_of(std::string_view text);

/// The cases of a log. Fails as the readers do, and LOG-JOIN when no step of the log makes a case.
/// Memory   grows with the steps of the log and not with its length, but for `kTimes` and `kWear`, which are
/// read whole.
[[nodiscard]] Result<std::vector<Case>> import_log(std::istream& in, LogFormat format,
                                                   std::span<const Step> steps, const LogFrom& from,
                                                   const ImportOptions& options, Job& job);

}  // namespace capstan::casebase::retain
