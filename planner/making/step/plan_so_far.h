#pragma once

#include <vector>

#include "planner/making/draft/draft.h"
#include "planner/making/draft/recorded.h"
#include "planner/making/optimise/cut.h"
#include "planner/making/piece/demands.h"
#include "planner/making/piece/piece.h"
#include "planner/model/plan/plan.h"

namespace capstan::casebase {
class CaseBase;
}

namespace capstan::step {

/// The caller's choices for every step.
struct Wishes {
  optimise::Aim aim = optimise::Aim::kTime;
  double earning_per_min = 0.0;    ///< Aim::kProfit: earning of a machine minute above its cost
  double margin_deviations = 0.0;  ///< of loads against their limits
  bool constant_feeds =
      false;  ///< one feed for the whole path of a step: the largest that all its sections allow
  const casebase::CaseBase* cases = nullptr;  ///< null: no precedents
  const std::vector<model::Cutter>& library;
  const std::vector<model::Edit>* edits = nullptr;  ///< of the operator; null: none
};

/// The plan that a step is made for, as it is so far. Refers to what the caller keeps.
struct PlanSoFar {
  const model::Plan& plan;
  const std::vector<draft::SetupDraft>& setups;
  const std::vector<draft::StepDraft>& steps;  ///< in order of execution
  const piece::Piece& piece;
  const piece::Demands& demands;
  const draft::Recorded& recorded;
  const Wishes& wishes;
  std::size_t cut = 0;  ///< so many of the recorded steps are cut: they are not among the plan's
};

}  // namespace capstan::step
