#include "tooling/selection/selections.h"

#include "planner/ground/memo/packed.h"

namespace capstan::tooling {

const model::Selection& Selections::of(const model::ToolRequirement& requirement,
                                       const Preferences& preferences) {
  // An answer holds some ten cutters, about 50 kB. Default, unsourced: a part has fewer kinds of steps.
  constexpr std::size_t kMost = 256;
  std::string question;
  memo::pack(question, requirement);
  memo::pack(question, preferences);
  if (const auto known = known_.find(question); known != known_.end()) return known->second;
  if (known_.size() >= kMost) known_.clear();
  return known_.emplace(std::move(question), select(requirement, library_, material_, machine_, preferences))
      .first->second;
}

}  // namespace capstan::tooling
