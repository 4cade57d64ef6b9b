#pragma once

#include <map>
#include <string>
#include <vector>

#include "tests/linuxcnc/simulator.h"

namespace capstan::linuxcnc {

/// Where the machine of machine/machine.ini stands when it is retracted, mm. Source: AXIS_Z.
inline constexpr double kRetracted = 101.6;

/// How a scenario of scenarios.py ended.
struct Outcome {
  int mark = 0;                         ///< of its samples (Record::mark)
  double x_mm = 0, y_mm = 0, z_mm = 0;  ///< of the machine at its end
  double rpm = 0;                       ///< commanded
  int tool = 0;                         ///< in the spindle
  std::vector<std::string> said;        ///< on the control's screen
  std::vector<int> bound, cut;          ///< workingsteps in the order of the journal
  std::vector<std::string> bound_ids;   ///< of those in `bound`
  std::vector<int> bound_tools;         ///< of those in `bound`
  double diameter_mm = 0;               ///< that was measured of a tool; 0: none was
  /// Ways of the plan's if and while statements: number of the question (M101 P), blank, the planner's words.
  std::vector<std::string> decided;
  std::string cannot;  ///< why the scenario cannot be on this computer; empty: it can
};

/// All scenarios, run one after the other on one simulated machine.
struct Scenarios {
  std::string absent;  ///< why there is no LinuxCNC to ask; empty: there is
  std::string failed;  ///< why they did not all run; empty: they did
  std::map<std::string, Outcome> outcomes;
  Record record;  ///< where the machine did anything
  /// What the command says of the cases of the first scenario: imported, and told (`cases trace`).
  std::string cases;
  /// What the machine did in the first scenario, whole, and what was broadcast of it: lines of JSON.
  Record first;
  std::string broadcast;
  bool cases_failed = false;
  /// What cases.py makes of the scenario in which the power went and of all behind it: the table, or why not.
  std::string cases_of_power_lost;
};

/// Run when it is asked for first, some five minutes.
[[nodiscard]] const Scenarios& scenarios();

/// Adds one sample of a record to another.
void add_sample(const Record& from, std::size_t sample, Record& to);
/// What the machine did in each workingstep of a scenario: each time that the spindle turned, until the tool
/// was retracted and it stood.
[[nodiscard]] std::vector<Record> workingsteps(const Record& record, int mark);

}  // namespace capstan::linuxcnc
