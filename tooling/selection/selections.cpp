#include "tooling/selection/selections.h"

#include "planner/ground/memo/packed.h"

namespace capstan::tooling {

const model::Selection& Selections::of(const model::ToolRequirement& requirement,
                                       const Preferences& preferences) {
  // Some 5 kB each. Default, unsourced: an answer holds ten cutters, and a part has fewer kinds of steps than
  // 256; asked for the fewest cutters, it holds all that fit.
  constexpr std::size_t kMostCutters = 2560;
  std::string question;
  memo::pack(question, requirement);
  memo::pack(question, preferences);
  if (const auto known = known_.find(question); known != known_.end()) return known->second;
  model::Selection answer = select(requirement, library_, material_, machine_, preferences);
  if (held_ + answer.ranked.size() > kMostCutters) {
    known_.clear();
    held_ = 0;
  }
  held_ += answer.ranked.size();
  return known_.emplace(std::move(question), std::move(answer)).first->second;
}

}  // namespace capstan::tooling
