#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "casebase/retain/lines.h"
#include "casebase/retain/log.h"

/// What the readers of logs share.
namespace capstan::casebase::retain {

[[nodiscard]] std::string_view without_blanks(std::string_view text);

/// Puts the value of one cell into a reading. What is wrong with it: no number, out of range; the reading is
/// not to be used then. Texts point into `cell`.
[[nodiscard]] std::optional<std::string> put(Reading& r, const Column& column, std::string_view cell);

/// What was read of a log, at its end; `out` knows what its readings say, and how many there are.
/// Fails   LOG-TEXT, LOG-FORMAT (as `Lines`, `LostLines`); LOG-EMPTY no reading.
[[nodiscard]] Result<LogEnd> ended(const Lines& lines, const LostLines& lost, LogEnd out,
                                   const std::string& expected, Job& job);

/// Holds times together: readings that go back in time are refused.
class Clock {
 public:
  [[nodiscard]] std::optional<std::string> step(double t_s);

 private:
  std::optional<double> last_;
};

}  // namespace capstan::casebase::retain
