#pragma once

#include <vector>

#include "planner/model/plan/resources/workholding.h"
#include "planner/proof/verify/findings.h"
#include "planner/proof/verify/moves.h"
#include "planner/proof/verify/sweep/grid/grid.h"

namespace capstan::verify {

/// Whether the piece stays held through one set-up: how much of each pressing solid touches it, before the
/// first step and after each: 31.
class Grip {
 public:
  Grip(const model::Workholding& holding, const Grid& grid, const StepMoves& first, Findings& findings);
  /// After a step: what it took away in front of a jaw or under a clamp.
  void after(const StepMoves& step, const Grid& grid, Findings& findings);

 private:
  [[nodiscard]] double contact(const model::FixtureSolid& s, const Grid& grid) const;  ///< mm2
  const model::Workholding& holding_;
  std::vector<double> area_;  ///< of each solid, so far
};

}  // namespace capstan::verify
