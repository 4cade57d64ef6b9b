#pragma once

#include <string>
#include <vector>

#include "planner/pipeline/work.h"

// Which chain of a proposal is taken; only planner/pipeline/*.cpp include this.

namespace capstan::pipeline {

struct Chosen {
  const std::vector<model::ProposedStep>* chain = nullptr;  ///< null: none
  std::string key;                                          ///< Tries::key_of
  std::vector<model::Selection> tools;                      ///< one per step
};

/// The first chain that was not tried in vain and whose every step finds a cutter; why the others do not.
[[nodiscard]] Chosen choose(Work& w, const model::Proposal& p, const model::FeatureShape& shape,
                            const Member& member, const std::vector<model::Cutter>& library,
                            std::vector<model::Rejected>& rejected);

}  // namespace capstan::pipeline
