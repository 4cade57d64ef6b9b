#pragma once

#include <span>
#include <string>
#include <vector>

#include "casebase/casebase.h"
#include "casebase/retain/executed.h"
#include "casebase/retain/inspection.h"
#include "casebase/retain/join/steps.h"
#include "casebase/retain/program_marks.h"

/// What was executed and measured, joined with the plan that it was cut by: cases.
namespace capstan::casebase::retain {

/// Where a log is from, as the caller knows it. Empty: not known.
struct LogFrom {
  std::string part = {};     ///< number of the part
  std::string machine = {};  ///< serial number of the machine
  std::string file = {};
  std::string inspection = {};  ///< file of what was measured, where there is one
  bool dated = false;           ///< the log's times are seconds since 1970-01-01 UTC
};

/// `Executed::run` of times that were summed up over a part: of no run, and recorded of the right program.
inline constexpr int kSummedUp = 0;

/// Gives the markers of a program the ids that the plan has. Fails LOG-PROGRAM when the program has no
/// markers, or those of another plan: other ids or tools.
[[nodiscard]] Status match(ProgramMarks& marks, const model::Plan& plan, const std::string& file);

/// A case of each step that the log shows whole, with its observed figures: executed time (moving: waits for
/// the operator are not the cut's), peak of the following error and of the spindle's load, the load over
/// time. A step is found by its id, or where the log names none by a tool that one step uses alone. A step in
/// which an event was kept (`Trigger`) is a bad case; the verdict of others is not known.
///
/// Where a step states no speed or feed, those that held longest are its own. Where it has a length of path
/// and predicts no time, the length over that feed is what was predicted.
///
/// Told as notes (LOG-STEP), as a warning where the log ends within a step (`Executed::cut_off`), and left
/// out: what belongs to no step, or to one of several; steps that are shown in part only (the log begins or
/// ends within, or has gaps of more than 2 % of the time: default, unsourced); a run without a named step
/// that shows fewer than half of the tools: it is one of another program, or was broken off.
[[nodiscard]] std::vector<Case> cases_of(std::span<const Step> steps, const std::vector<Executed>& executed,
                                         const ProgramMarks* marks, const LogFrom& from, Job& job);

/// Adds what was measured of the part to the cases of one log: the row's characteristic is one of a step's,
/// or the id of a workingstep, or of one and a remark ("HOLE1_WS.1/diameter"). Diameters, widths and lengths
/// with a nominal give the deviation of size, depths that of depth, positions that of place; of several
/// values their mean, and their spread as standard deviation. Of roughnesses the largest Ra counts. Sizes
/// (depths) of several nominals in one step are no size of it: those of the nominal that the step asks for
/// count, and the others are told. A value beyond its limits, of whatever kind, or an Ra above what the step
/// asks for, makes a bad case, a kept one within them a good one, unless the log made it bad. Rows of other
/// parts are
/// passed over; others that find no case, or of which a case keeps nothing, are reported by name and line
/// (LOG-STEP).
void add_inspection(std::span<const Inspected> rows, std::span<const Step> steps, const LogFrom& from,
                    std::vector<Case>& cases, Job& job);

/// A case of each edge of a table of wear: its readings over its cutting time as `wear_series_mm`, the last
/// of them as `wear_mm`, the time that it cut. An edge without a serial number is called by the file and its
/// part. The step is the one that the rows name, or whose tool they name, or the only one for their part.
/// Feed and speed that the table states are what was executed, as measured; what it does not state is taken
/// from the step, as entered. The verdict is not known. The case has no path and no predicted time: the time
/// is the edge's, not the step's.
///
/// Told as notes (LOG-STEP) and left out: an edge of no step, or of several, for its wear is of none of them;
/// one without a reading after it cut; one of which the table states another speed, feed or depth than the
/// step, by more than 1 % (default, unsourced).
[[nodiscard]] std::vector<Case> cases_of_wear(std::span<const Step> steps, std::span<const Worn> rows,
                                              const LogFrom& from, Job& job);

}  // namespace capstan::casebase::retain
