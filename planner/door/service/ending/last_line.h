#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "planner/door/service/check.h"
#include "planner/door/service/options.h"
#include "planner/door/service/planning.h"

namespace capstan::service {

/// The fate of the programs that a call was to write.
enum class ProgramEnd : std::uint8_t {
  kNotAsked,   ///< no output is a program or a tool table
  kWritten,    ///< as planned
  kWithStops,  ///< condemned, and written with a stop before each condemned step
  kWithheld,   ///< condemned, and not written
};

/// How a call of `plan`, `bind` or `check` ended: all that its last line says.
struct Ending {
  Verb verb = Verb::kPlan;
  bool done = true;      ///< false: a fault ended it before there was anything to judge
  bool stopped = false;  ///< somebody stopped the call: the plan is not made, or not checked completely
  bool late = false;     ///< bind: past the deadline
  // The plan.
  std::size_t steps = 0, setups = 0, tools = 0;
  std::size_t to_load = 0;                      ///< tools that are not in the magazine, where others are
  std::optional<double> time_s = std::nullopt;  ///< nothing: not known
  std::string time_by_cases = {};               ///< "2 min 51 s +- 9.4 s"; empty: no case says
  std::size_t files = 0;                        ///< check: plans and programs that were looked at
  std::size_t features = 0;                     ///< that are planned, or should be
  std::size_t unplanned = 0;                    ///< of these
  // Results of the check.
  bool open = false;          ///< decisions are left open, so that nothing was checked
  std::size_t condemned = 0;  ///< reasons why it must not be run
  std::string why = {};       ///< what they say (model::text_of)
  bool faces_left = false;    ///< faces of the CAD shape are not reached (verify::kFacesLeft)
  std::size_t warned = 0;     ///< warnings of the check, which condemn nothing
  std::size_t unproved = 0;   ///< things that the check could not judge (Finding::unproved)
  std::size_t unread = 0;     ///< errors of reading (reading_errors): what they are about is not in the plan
  std::size_t planned_anew = 0;  ///< check: plans that were planned to be checked (CheckResult)
  std::size_t compared = 0;      ///< check: files compared with the schema, and not checked
  std::size_t schema = 0;        ///< check: deviations from the schema
  // Files that were written.
  ProgramEnd program = ProgramEnd::kNotAsked;
  bool strict = false;                  ///< nothing is written for its findings' sake (--strict)
  std::vector<std::string> wrote = {};  ///< files, each with what it cannot hold
};

/// The line that ends the call:
///
///     Safe: 21 steps, 10 tools, 4 min 29 s; wrote plan.p21
///     NOT SAFE: 3 findings, no program written; step 5 SLOT: spindle torque 1.11 of 0.48 Nm (and 2 more);
///     ... Safe, but not whole: 1 of 12 features is not planned; 21 steps, ... Not proven safe: 2 things are
///     not judged (see above); ... Not checked: decisions are left open; ... Stopped: no plan, no program
///
/// It says "Safe" only where all decisions are bound, all was checked to its end, nothing failed to be read,
/// and nothing condemns the plan or its program.
[[nodiscard]] std::string last_line(const Ending& end);

/// True if that line says "Safe", whole or not.
[[nodiscard]] bool calls_safe(const Ending& end);

/// Number of errors from that index on, without those of planning, which lists unplanned features itself
/// (Plan::unplanned).
[[nodiscard]] std::size_t reading_errors(const std::vector<Diagnostic>& said, std::size_t from = 0);

/// Takes the numbers of a plan: steps, set-ups, tools, time, features.
void take_plan(const model::Plan& plan, Ending& into);
/// Takes the result of checking a plan and its programs.
void take_verdict(const model::Plan& plan, const Verdict& verdict, Ending& into);
/// Takes the result of checking files.
void take_check(const CheckResult& result, Ending& into);

}  // namespace capstan::service
