#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "planner/ground/base/job.h"
#include "planner/ground/base/result.h"
#include "planner/making/draft/draft.h"
#include "planner/model/plan/plan.h"

// Which fixture holds each set-up, where, and what the operator is told about it.

namespace capstan::workholding {

/// What the piece is to be held by.
struct Wish {
  std::string how;         ///< "auto", the id of a fixture, or a file; empty or "none": not planned
  bool asked_now = false;  ///< somebody says so now: what the plan said before does not count
  /// As the plan said when it was read.
  const std::vector<std::pair<model::Ref<model::Setup>, model::Workholding>>& recorded;
};

/// What holds each set-up.
struct Held {
  std::vector<model::Workholding> holdings;  ///< by set-up; without solids where it is not planned
  bool planned = true;                       ///< false: nothing was asked for, or the file cannot be read now
  std::optional<model::Provenance> note;     ///< that nothing is planned, where the plan does not say it yet
};

/// Holds each set-up as wished: by what the plan recorded, by the fixture or the file that is named, or by
/// the first of the shipped fixtures that keeps out of the way of all cuts. Says of which set-up nothing is
/// known (PIP-HOLDING).
/// Fails  HOLD-KIND for a clamp without a plate, HOLD-SETUP for a set-up that the file names and the plan has
///        not, as `place`, and as reading the file.
[[nodiscard]] Result<Held> hold(const model::Plan& plan, const std::vector<draft::SetupDraft>& setups,
                                const std::vector<draft::StepDraft>& steps, const Wish& wish, Job& job);

/// Writes the holding of set-up `at`, where it has one: an instruction of the workpiece's set-up, the fixture
/// used, and what must not be entered where one block says it. `by`: what was asked for.
void write_nouns(model::Plan& plan, const std::vector<draft::SetupDraft>& setups, std::size_t at,
                 const std::string& by);

}  // namespace capstan::workholding
