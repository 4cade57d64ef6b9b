#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <istream>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "casebase/retain/items.h"
#include "planner/ground/base/job.h"
#include "planner/ground/base/result.h"

/// Readers of execution logs. Each gives what the log says, reading by reading, to a function: a log of any
/// length passes through in the memory of one line.
namespace capstan::casebase::retain {

/// What a log says at one moment: what it does not mention is as it was.
struct Reading {
  double t_s = 0.0;        ///< since the epoch of the log, which only differences count in
  std::uint64_t line = 0;  ///< of the log
  std::array<double, kNumbers> number = {};
  std::uint16_t has = 0;  ///< bit `index_of(item)`: the number is said
  std::optional<int> tool = {};
  std::optional<long> program_line = {};
  std::optional<bool> running = {};
  /// These live until the function returns.
  std::optional<std::string_view> workingstep = {}, program = {}, tool_instance = {};

  void set(Item i, double v) {
    number[index_of(i)] = v;
    has = static_cast<std::uint16_t>(has | 1U << index_of(i));
  }
  [[nodiscard]] bool says(Item i) const { return (has >> index_of(i) & 1U) != 0; }
};
using Sink = std::function<void(const Reading&)>;

/// What was read.
struct LogEnd {
  std::uint64_t lines = 0, readings = 0, lost = 0;
  bool says_running = false;  ///< some line states whether the program runs
  bool dated = false;         ///< times are seconds since 1970-01-01 UTC
};

/// A line per change, as MTConnect adapters send and the test bed of NIST keeps them:
///
///     2017-02-01T14:59:58.2812500Z|Spindle_Speed|12000
///     2017-02-01T14:59:58.2812500Z|Xact|12.5|Yact|-3.25
///
/// Items that `items.h` does not know are passed over, as are UNAVAILABLE and empty values. Lines that cannot
/// be read, or that go back in time, are left out and warned of (LOG-LINES).
/// Units   mm and mm/s (MTConnect's), unless a name says more or `units` does.
/// Fails   LOG-TEXT no text; LOG-FORMAT too many lines that are none of these; LOG-EMPTY no reading.
/// Source  MTConnect standard 1.4, part 1 (time stamps) and the adapter's protocol (SHDR).
[[nodiscard]] Result<LogEnd> read_trace(std::istream& in, const std::string& file, const LogUnits& units,
                                        const Sink& sink, Job& job);
inline constexpr LogUnits kTraceUnits = {1.0, 60.0};

/// A table, a reading per row: separated by commas, semicolons, tabs or blanks. The first row names the
/// columns (`items.h`) unless `columns` does; columns of other names are passed over and
/// told (LOG-COLUMNS); a column for time is
/// needed, in s or as a date of ISO 8601. Empty cells say nothing. Lines that begin with # are remarks.
/// Units   mm and mm/min, unless a name says more or `units` does.
/// Fails   as read_trace; LOG-COLUMNS no time, or a column twice.
[[nodiscard]] Result<LogEnd> read_table(std::istream& in, const std::string& file, const LogUnits& units,
                                        std::span<const std::string> columns, const Sink& sink, Job& job);

/// What LinuxCNC's `halsampler -t` writes: number of the sample, then the pins in the order in which they
/// were added. Without `columns` they are x, y, z, motion.current-vel (mm/s), motion.program-line and, as far
/// as the first row has them, the spindle's speed (1/min), the tool, a mark, the following error and
/// motion.motion-type, as examples/linuxcnc/machine records them. `period_s`: the period of the servo thread;
/// the column of the sample's number, which may have gaps (overruns), times the period is the time.
[[nodiscard]] Result<LogEnd> read_linuxcnc(std::istream& in, const std::string& file, const LogUnits& units,
                                           std::span<const std::string> columns, double period_s,
                                           const Sink& sink, Job& job);

/// Seconds since 1970-01-01 of "2017-02-01T14:59:58.28125Z"; nothing for another text. Leap seconds count as
/// the second that follows.
[[nodiscard]] std::optional<double> seconds_of(std::string_view stamp);
/// The inverse, to the second: "2017-02-01T14:59:58Z". Empty beyond the years 1970 to 9999.
[[nodiscard]] std::string stamp_of(double seconds);

}  // namespace capstan::casebase::retain
