#pragma once

#include <optional>
#include <set>
#include <string>
#include <utility>

#include "planner/making/optimise/feeds.h"
#include "planner/making/step/path/attempt.h"

// What the plan reports of the cases that a step's cut leans on.

namespace capstan::step {

/// Counts of what cases changed in a plan, for one line at its end.
struct CaseTally {
  int leaning = 0;  ///< steps that start from near cases
  int proven = 0;   ///< of these, from tuned values
  int lowered = 0;  ///< of these, below failed ones
  int weighed = 0;  ///< steps near which there are cases that change nothing
  int none = 0;     ///< steps without a case near
  /// Chains and cutters that would be taken if they had not failed before, with their features.
  std::set<std::pair<model::AnyRef, std::string>> behind;
  /// Cutting time of those that lean: as planned; and by the table, scheduled along the same path where depth
  /// and width stay, else about, by the nominal rates.
  double with_s = 0.0, without_s = 0.0;
};

/// Beside speed and feed of the step that was put into the plan last: what they would be without the cases,
/// and which cases were near. Warns (CASE-BAD-NEAR) where failed cuts lowered them, put a chain or
/// cutter behind another, or are near values that stay as the file states them; CASE-INVALID where a step
/// makes no question. `asked`: what the step's feeds were scheduled by. Adds to `told`. Nothing where there
/// is no case base.
void tell_cases(model::Plan& plan, const PlanSoFar& p, const draft::StepDraft& step, const PathWithCut& made,
                const optimise::FeedQuestion& asked, Cuts& cuts, CaseTally& told, Job& job);

/// One line for the plan (CASE-USED); nothing where no step was asked.
void tell_all_cases(const CaseTally& told, Job& job);

}  // namespace capstan::step
