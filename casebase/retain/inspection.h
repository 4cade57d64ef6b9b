#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "planner/ground/base/job.h"
#include "planner/ground/base/result.h"

/// Tables that come after the cut: what was measured of the parts, and times that somebody summed up.
namespace capstan::casebase::retain {

/// What a measured characteristic is about.
enum class Measures : std::uint8_t {
  kSize,       ///< a diameter, a width, a length: its deviation from the nominal, mm
  kDepth,      ///< a depth, a height: likewise
  kPlace,      ///< a position: its distance from the asked place, mm
  kRoughness,  ///< Ra, um
  kOther,      ///< flatness, angles, Rz and all else, of which a case keeps its verdict alone
};

/// Which of the sizes that a step's question states a size or a depth is.
enum class StatedSize : std::uint8_t {
  kUnsaid,  ///< any of them; of a depth, the depth
  kDiameter,
  kWidth,
  kUnstated,  ///< none: a length, or a height, which may be over another face
};

/// One measured characteristic of one part. mm, of kOther in one unit of its own; flatness and the like have
/// no nominal.
struct Inspected {
  std::string part;            ///< its number
  std::string characteristic;  ///< its name in the inspection plan: "DIAMETER5"
  std::string type;            ///< "Diameter", "Position"; may be empty
  Measures kind = Measures::kSize;
  StatedSize stated = StatedSize::kUnsaid;
  bool has_nominal = false;
  double nominal_mm = 0.0, upper_mm = 0.0, lower_mm = 0.0;  ///< the limits: deviations from the nominal
  double value_mm = 0.0;
  /// Both limits are stated; of a place the upper one at least, of kOther either (the other is infinite).
  bool toleranced = false;
  double ra_um = 0.0;                  ///< of kRoughness, in place of `value_mm`
  std::optional<double> ra_most = {};  ///< um; its upper limit, where the row states one
  std::uint64_t line = 0;
};

/// Comma- or semicolon-separated; the first row names the columns, of which part, characteristic and value
/// are needed:
///
///     part, part_index, part_number, serial | characteristic, designator, feature | type
///     nominal | tol_plus, upper | tol_minus, lower | value, actual, measured | unit (mm, in, um, uin)
///
/// What is measured is told by the type, or where there is none by what stands behind the characteristic's
/// last slash ("HOLE1_WS.1/depth"): diameter, width, length, size; depth, height; position, true position;
/// Ra, roughness. Any other type is of kOther, whatever its unit; a row that says nothing of it is a size. A
/// name may end in _mm, _in or _um. A cell of the column `unit` goes before that; where nothing says more a
/// length is in mm, or in what `unit_mm` says (25.4: inches), and a roughness in um. A roughness has an upper
/// limit alone: nominal and tol_plus together. Columns of other names are passed over. Rows without a value,
/// or with a part of the row that is no number, or a deviation that no case can have (record/fields.h), are
/// left out and warned of (LOG-LINES). Fails   LOG-COLUMNS; LOG-FORMAT too many such rows; LOG-EMPTY;
/// LOG-TEXT.
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

/// One row of a table of wear: an edge after a time in the cut.
struct Worn {
  std::string part;                    ///< or number of the test
  std::string edge;                    ///< serial number of the edge; empty: not stated
  std::string workingstep;             ///< may be empty
  int tool = 0;                        ///< number in the program; 0: not stated
  double time_s = 0.0;                 ///< in the cut, since the edge was new
  std::optional<double> wear_mm = {};  ///< VB; nothing: it was not read then
  /// As the table has them, of the cut; 0: not stated.
  double feed_per_turn_mm = 0.0, depth_mm = 0.0, rpm = 0.0;
  std::uint64_t line = 0;
};

/// Like read_inspection. Columns, of which part or edge, time and wear are needed:
///
///     part, part_index, part_number, serial, case, test | edge, tool_edge, tool_serial, insert
///     workingstep | tool, tool_number, t | time, cutting_time (_min, _s, _h) | vb, wear, flank_wear
///     feed, feed_per_turn | depth, doc, ap | spindle_rpm, rpm
///
/// Lengths may end in _mm, _in or _um, and are in mm, or in what `unit_mm` says, where they do not. A time
/// without a unit is in minutes, as lives are stated. An empty cell of wear: the edge was not read then.
/// A wear below 0 or above what a case can hold (record/fields.h), a time below 0 and one that goes back on
/// its edge are left out and warned of (LOG-LINES).
/// Fails   as read_inspection.
[[nodiscard]] Result<std::vector<Worn>> read_wear(std::string_view text, const std::string& file,
                                                  double unit_mm, Job& job);

}  // namespace capstan::casebase::retain
