#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "planner/ground/base/job.h"
#include "planner/ground/base/result.h"

/// Tables that come after the cut: what was measured of the parts, and times that somebody summed up.
namespace capstan::casebase::retain {

/// One measured characteristic of one part. mm; flatness and the like have no nominal.
struct Inspected {
  std::string part;            ///< its number
  std::string characteristic;  ///< its name in the inspection plan: "DIAMETER5"
  std::string type;            ///< "Diameter", "Position"; may be empty
  bool has_nominal = false;
  double nominal_mm = 0.0, upper_mm = 0.0, lower_mm = 0.0;  ///< the limits: deviations from the nominal
  double value_mm = 0.0;
  bool toleranced = false;  ///< both limits are stated
  std::uint64_t line = 0;
};

/// Comma- or semicolon-separated; the first row names the columns, of which part, characteristic and value
/// are needed:
///
///     part, part_index, part_number, serial | characteristic, designator, feature | type
///     nominal | tol_plus, upper | tol_minus, lower | value, actual, measured | unit (mm, in)
///
/// A name may end in _mm or _in. A cell of the column `unit` goes before that; `mm` is meant where nothing
/// says more, or what `unit_mm` says (25.4: inches). Columns of other names are passed over.
/// Rows without a value, or with a part of the row that is no number, are left out and warned of (LOG-LINES).
/// Fails   LOG-COLUMNS; LOG-FORMAT too many such rows; LOG-EMPTY; LOG-TEXT.
[[nodiscard]] Result<std::vector<Inspected>> read_inspection(std::string_view text, const std::string& file,
                                                             double unit_mm, Job& job);

/// One row of a summary of times: a tool or workingstep of a part.
struct Timed {
  std::string part, workingstep;
  int tool = 0;
  double spindle_rpm = 0.0, feed_mm_min = 0.0;  ///< as somebody noted them; 0: not stated
  double path_mm = 0.0;                         ///< at feed
  int blocks = 0;
  double active_s = 0.0, moving_s = 0.0;  ///< tool in the spindle; of it with a feed above zero
  std::uint64_t line = 0;
};

/// Like read_inspection. Columns: part, tool or workingstep, and executed_active_s, active_s or
/// executed_feeding_s, moving_s are needed; spindle_rpm, main_feed or feed, feed_length or path, feed_blocks
/// or blocks; lengths and feeds end in their unit (`_in`, `_ipm`, `_mm`, `_mm_min`).
[[nodiscard]] Result<std::vector<Timed>> read_times(std::string_view text, const std::string& file, Job& job);

}  // namespace capstan::casebase::retain
