#pragma once

#include <string>
#include <vector>

#include "planner/making/draft/draft.h"
#include "planner/making/optimise/cut.h"
#include "planner/making/step/plan_so_far.h"
#include "planner/model/features/shape.h"

// By which strategies cuts near a step were made. Cases order none: strategies are the rules'.

namespace capstan::step {

/// From this on a chain or a strategy is likelier to fail than to go well.
inline constexpr double kLikelierToFail = 0.5;

/// What near cuts by one strategy came to. Simulated cases do not count.
struct OfStrategy {
  std::string strategy;               ///< keyword
  int good = 0, bad = 0;              ///< cuts, each counted once
  double success = 0.0;               ///< probability, of the values of the question
  [[nodiscard]] bool failed() const;  ///< as often as repeats count, and likelier to fail than not
};

/// In the order of their keywords; none where there is no case base. `q`: as without cases.
[[nodiscard]] std::vector<OfStrategy> strategies_near(const PlanSoFar& p, const draft::StepDraft& step,
                                                      const model::FeatureShape& shape,
                                                      const optimise::CutQuestion& q);

}  // namespace capstan::step
