#pragma once

#include <string>
#include <vector>

#include "planner/door/pipeline/work.h"

// Which chain of a proposal is taken; only planner/door/pipeline/*.cpp include this.

namespace capstan::pipeline {

struct Chosen {
  const std::vector<model::ProposedStep>* chain = nullptr;  ///< null: none
  std::string key;                                          ///< draft::key_of
  std::vector<model::Selection> tools;                      ///< one per step
};

/// The first chain that was not tried in vain and whose every step finds a cutter; why the others do not.
[[nodiscard]] Chosen choose(Work& w, const model::Proposal& p, const model::FeatureShape& shape,
                            const Member& member, const std::vector<model::Cutter>& library,
                            std::vector<model::Rejected>& rejected);

/// A chain by its steps: "centre + drill + ream [hole.ream.it7]".
[[nodiscard]] std::string chain_text(const std::vector<model::ProposedStep>& chain,
                                     const model::FeatureShape& shape);
/// What the chains after the chosen one would take, by the estimate that also ranks cutters, against the
/// chosen one.
[[nodiscard]] std::vector<model::Rejected> alternatives(Work& w, const model::Proposal& p,
                                                        const model::FeatureShape& shape,
                                                        const Chosen& chosen,
                                                        const std::vector<model::Cutter>& library);

}  // namespace capstan::pipeline
