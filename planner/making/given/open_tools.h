#pragma once

#include <string>
#include <vector>

#include "planner/ground/base/job.h"
#include "planner/making/draft/draft.h"
#include "planner/making/given/tool_material.h"
#include "planner/making/piece/demands.h"
#include "planner/making/piece/piece.h"
#include "planner/model/plan/needed_tool.h"
#include "planner/model/plan/plan.h"
#include "rules/rules.h"
#include "tooling/library/cutters/holders.h"

// Cutters for the operations of a file: the given ones as they are, the open ones chosen.

namespace capstan::casebase {
class CaseBase;
}

namespace capstan::given {

/// The cutters to choose from, and the criteria.
struct Choice {
  const std::vector<model::Cutter>& library;
  const std::vector<model::Cutter>& usable;  ///< of the library
  const rules::RuleBase& rules;
  const piece::Piece& piece;
  const piece::Demands& demands;
  const std::vector<model::Cutter>& recorded;  ///< what the plan said of its cutters when it was read
  const ToolMaterialWish& materials;           ///< of tools whose file does not state it
  const tooling::ShopHolders& holders;         ///< of tools whose file does not state theirs
  const casebase::CaseBase* cases = nullptr;   ///< null: no precedents
  const std::vector<model::Edit>* edits = nullptr;  ///< of the operator; null: none
};

/// Gives each step of the file its cutter. Writes the chosen tools into `plan`, and reports the steps without
/// one (PIP-NO-TOOL). `used`: ids of the cutters that steps use, each once.
/// `needed` gets the tools that they lack.
void select_open_tools(model::Plan& plan, std::vector<draft::StepDraft>& steps,
                       std::vector<std::string>& used, std::vector<model::NeededTool>& needed,
                       const Choice& choice, Job& job);

/// Gives a tool one stick-out and length in the whole plan: the one that the deepest of its steps needs. It
/// bends accordingly in all its steps.
void stand_out_alike(std::vector<draft::StepDraft>& steps);

}  // namespace capstan::given
