#pragma once

#include <map>
#include <string>
#include <vector>

#include "tests/linuxcnc/simulator.h"

namespace capstan::linuxcnc {

/// How a scenario of scenarios.py ended.
struct Outcome {
  int mark = 0;                         ///< of its samples (Record::mark)
  double x_mm = 0, y_mm = 0, z_mm = 0;  ///< of the machine at its end
  double rpm = 0;                       ///< commanded
  int tool = 0;                         ///< in the spindle
  std::vector<std::string> said;        ///< on the control's screen
  std::vector<int> bound, cut;          ///< workingsteps in the order of the journal
};

/// All scenarios, run one after the other on one simulated machine.
struct Scenarios {
  std::string absent;  ///< why there is no LinuxCNC to ask; empty: there is
  std::string failed;  ///< why they did not all run; empty: they did
  std::map<std::string, Outcome> outcomes;
  Record record;  ///< where the machine did anything
  /// What the command says of the cases of the first scenario: imported, and told (`cases trace`).
  std::string cases;
  bool cases_failed = false;
};

/// Run when it is asked for first, a minute and a half.
[[nodiscard]] const Scenarios& scenarios();

}  // namespace capstan::linuxcnc
