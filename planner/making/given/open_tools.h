#pragma once

#include <string>
#include <vector>

#include "planner/ground/base/job.h"
#include "planner/making/draft/draft.h"
#include "planner/making/piece/demands.h"
#include "planner/making/piece/piece.h"
#include "planner/model/plan/plan.h"
#include "rules/rules.h"

// Cutters for the operations of a file: the given ones as they are, the open ones chosen.

namespace capstan::given {

/// What cutters are chosen from, and by what.
struct Choice {
  const std::vector<model::Cutter>& library;
  const std::vector<model::Cutter>& usable;  ///< of the library
  const rules::RuleBase& rules;
  const piece::Piece& piece;
  const piece::Demands& demands;
  const std::vector<model::Cutter>& recorded;  ///< what the plan said of its cutters when it was read
};

/// Gives each step of the file its cutter; in `plan`, the tools that were chosen and the steps that find none
/// (PIP-NO-TOOL). `used`: ids of the cutters that steps use, each once.
void select_open_tools(model::Plan& plan, std::vector<draft::StepDraft>& steps,
                       std::vector<std::string>& used, const Choice& choice, Job& job);

/// A tool stands out by one length all through a plan, and is as long: as far as the deepest of its steps
/// needs. The steps before and after that bend as much.
void stand_out_alike(std::vector<draft::StepDraft>& steps);

}  // namespace capstan::given
