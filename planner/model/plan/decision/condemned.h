#pragma once

#include <string>
#include <vector>

#include "planner/model/plan/plan.h"

namespace capstan::model {

/// One reason why a program made from a plan must not be run.
struct Condemnation {
  std::string step;  ///< persistent id, as step_id; empty: the whole plan
  std::string code;  ///< of the finding, "PIP-EXCESS", "PIP-NEEDED"
  std::string text;  ///< what is wrong, with the numbers, and what to do
  friend bool operator==(const Condemnation&, const Condemnation&) = default;
};

/// Why no program may be written of this plan; empty: it may. Condemned are
///
///     a finding of severity error                     its step, or the whole plan
///     a limit that a step exceeds                     StepResult::exceeded: by more than the
///                                                     pipeline's kTolerableExcess somewhere on its path. Up
///                                                     to that a step is not condemned; the check has its own
///                                                     bounds
///     a feature that is not planned, and needed       the steps of the features in Unplanned::needed_by,
///                                                     or the whole plan when none of them has a step and
///                                                     not all of them are left out with it
///
/// Lists each reason once, in the order of the plan's steps, reasons of the whole plan first. Command,
/// library and service call this, and nothing else, before they hand out a program.
[[nodiscard]] std::vector<Condemnation> condemned(const Plan& plan, const std::vector<Finding>& findings);

/// Whether one of them says that nobody knows what the plan is: its file states it in two ways, or states
/// wrongly what all of it rests on. No stop makes a program of such a plan fit to run: none is written, even
/// where the user allows programs that the check condemns.
[[nodiscard]] bool never_written(const std::vector<Condemnation>& reasons);

/// The name of a limit as sentences have it: "spindle torque" of "spindle_torque".
[[nodiscard]] std::string limit_words(std::string name);
/// "spindle torque 1.11 of 0.48 Nm at X12.4 Y30.1". Of a limit from below, whose value is the bound and whose
/// limit is what the cut has: "feed per tooth 0.004 mm, at least 0.01 mm".
[[nodiscard]] std::string text_of(const ExceededLimit& limit);
/// "step 5 SLOT: spindle torque 1.11 of 0.48 Nm at X12.4 Y30.1; use a smaller tool or depth".
[[nodiscard]] std::string text_of(const Plan& plan, const Condemnation& reason);
/// The first reason that says that nobody knows what the plan is (never_written), else the first that names a
/// step, for it says more than one of the whole plan, else the first. Needs one at least.
[[nodiscard]] const Condemnation& foremost(const std::vector<Condemnation>& reasons);
/// The text of the foremost reason, with "(and 2 more)". Needs one at least.
[[nodiscard]] std::string text_of(const Plan& plan, const std::vector<Condemnation>& reasons);

}  // namespace capstan::model
