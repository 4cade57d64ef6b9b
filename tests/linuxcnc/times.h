#pragma once

#include <string>
#include <vector>

#include "planner/ground/base/result.h"
#include "planner/model/plan/plan.h"
#include "tests/linuxcnc/simulator.h"

namespace capstan::linuxcnc {

/// How long the machine moved for one step of a program, s.
struct StepSeconds {
  std::string id;
  double path_s = 0.0;    ///< the path itself: cutting, and rapids from its first point to its last; dwells
  double link_s = 0.0;    ///< from the step before, which had the same tool
  double change_s = 0.0;  ///< to the place of tool changes and from there; nothing where the tool stays
};

/// The time of a program on the simulated machine, by step.
///
/// Counted is each servo period in which the machine moves, for the line that it executes, and each dwell
/// (G4) that the path asks for. Not counted is what the simulation has no machine for: the tool changer (it
/// answers at once), and the wait for the spindle after its start.
[[nodiscard]] std::vector<StepSeconds> measured(const std::string& program, const Record& record);

/// The same of a plan, as `motion` predicts it; `change_s` is zero: it is part of the machine's tool change
/// time. The links are predicted for the whole plan only.
struct Predicted {
  std::vector<StepSeconds> steps;  ///< link_s: 0
  double link_s = 0.0;
};
[[nodiscard]] Result<Predicted> predicted(const model::Plan& plan);

/// One program, on the machine and as predicted.
struct Comparison {
  double measured_s = 0.0, predicted_s = 0.0;  ///< paths and links
  double change_s = 0.0;                       ///< measured ways to tool changes and back, in neither
  std::string table;                           ///< step by step, for people
  [[nodiscard]] double error() const { return predicted_s / measured_s - 1.0; }
};
/// Nothing predicted: only what was measured.
[[nodiscard]] Comparison compare(const std::vector<StepSeconds>& measured, const Predicted& predicted);

/// Work offsets that keep every tool of the plan within the travel of its machine's Z axis, as `run` takes
/// them. Where the travel is too short, as high as it goes.
[[nodiscard]] std::vector<std::string> offsets_for(const model::Plan& plan);

}  // namespace capstan::linuxcnc
