#pragma once

#include <map>
#include <string>
#include <utility>
#include <vector>

#include "planner/making/piece/demands.h"
#include "planner/making/propose/choose.h"
#include "planner/model/plan/needed_tool.h"
#include "rules/rules.h"

// Features without bound operations: what the rules say, which cutters there are.

namespace capstan::propose {

/// Input of proposing: rules, demands, unreadable features, choice of cutters.
struct Sources {
  const rules::RuleBase& rules;
  const piece::Demands& demands;
  const std::map<model::AnyRef, std::string>& unreadable;  ///< by feature: what its file states wrongly
  const Choice& choice;
  bool reopened = false;  ///< operations that the file binds are proposed anew
};

/// Drafts of a plan: those of its file, and what was proposed.
struct Drafts {
  std::vector<draft::SetupDraft> setups;
  std::vector<draft::StepDraft> steps;
  std::vector<std::string> used;               ///< ids of the cutters that steps use, each once
  std::vector<model::NeededTool> needed = {};  ///< what features lack that no cutter fits
};

/// The drafts with the proposed steps of features that have none. Writes their nouns into `plan`, and the
/// features that are not planned (PIP-UNPLANNED).
struct Proposed {
  Drafts drafts;
  std::vector<std::pair<model::AnyRef, std::string>> left_out;  ///< features that cannot be made, with why
  bool again = false;  ///< a feature was left out that other proposals assumed as made: plan again
  bool full = false;   ///< a feature found no cutter because the magazine was full
};
[[nodiscard]] Proposed propose_missing(model::Plan& plan, Drafts given, const Sources& sources, Job& job);

}  // namespace capstan::propose
