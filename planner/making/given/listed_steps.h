#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "planner/ground/base/job.h"
#include "planner/ground/base/result.h"
#include "planner/making/draft/draft.h"
#include "planner/model/plan/plan.h"

namespace capstan::given {

/// What to re-open before planning, although the file binds it. Each value includes those below it.
enum class Reopen : std::uint8_t { kNothing, kTechnology, kTools, kOperations, kAll };

/// Set-ups and steps that the file states, and the plan with what listing them changed.
struct Listed {
  model::Plan plan;
  std::vector<draft::SetupDraft> setups;
  std::vector<draft::StepDraft> steps;  ///< in the order of the workplan
};

inline constexpr std::size_t kAllSteps = static_cast<std::size_t>(-1);

/// Gives the set-ups and workingsteps of the plan's file. Of the plan it changes: a set-up where the file has
/// none, re-opened values, and what safety forces (PIP-CHANGED). Steps without an operation are left to the
/// rules; steps that are not understood become unplanned (PIP-UNHANDLED). `unreadable`: by feature and
/// workingstep, what the file states wrongly. `grown_mm` as piece::Piece. `most`: the first so many steps
/// only. Fails  as model::placement for a set-up without a valid placement.
[[nodiscard]] Result<Listed> list_steps(model::Plan plan, Reopen reopen,
                                        const std::map<model::AnyRef, std::string>& unreadable,
                                        double grown_mm, Job& job, std::size_t most = kAllSteps);

/// What a plan's workplan executes, in order, as `list_steps` lists it; nothing is said of what is not
/// understood.
[[nodiscard]] std::vector<model::AnyRef> steps_in_order(const model::Plan& plan);

/// A plan and its set-ups, once the security planes clear the material.
struct Raised {
  model::Plan plan;
  std::vector<draft::SetupDraft> setups;
};

/// The security planes lie above the raw piece, every feature that is cut and what holds the piece; a given
/// one that does not is raised (PIP-SECPLANE), in the set-ups and in the nouns.
[[nodiscard]] Raised raise_security_planes(model::Plan plan, std::vector<draft::SetupDraft> setups,
                                           const std::vector<draft::StepDraft>& steps, Job& job);

}  // namespace capstan::given
