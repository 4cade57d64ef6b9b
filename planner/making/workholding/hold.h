#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "planner/ground/base/job.h"
#include "planner/ground/base/result.h"
#include "planner/making/draft/draft.h"
#include "planner/model/plan/plan.h"
#include "tooling/shop/fixtures/fixtures.h"

// The fixture of each set-up, its place, and the set-up instructions for the operator.

namespace capstan::workholding {

/// The workholding that the caller wants.
struct Wish {
  std::string how;         ///< "auto", the id of a fixture, or a file; empty or "none": not planned
  bool asked_now = false;  ///< the caller asks for it now: the workholding in the plan does not count
  /// As the plan said when it was read.
  const std::vector<std::pair<model::Ref<model::Setup>, model::Workholding>>& recorded;
  std::vector<tooling::Fixture> own = {};  ///< fixtures of the shop, which come before the shipped ones
};

/// Workholding of each set-up.
struct Held {
  std::vector<model::Workholding> holdings;  ///< by set-up; without solids where it is not planned
  bool planned = true;                       ///< false: none was requested, or the file cannot be read now
  std::optional<model::Provenance> note;     ///< that nothing is planned, where the plan does not say it yet
};

/// Holds each set-up as wished: as recorded in the plan, by the fixture or the file that is named, or by the
/// first shipped fixture that is clear of all cuts. Reports set-ups whose workholding is unknown
/// (PIP-HOLDING).
/// Fails  HOLD-KIND for a clamp without a plate, HOLD-SETUP for a set-up that the file names and the plan has
///        not, as `place`, and as reading the file.
[[nodiscard]] Result<Held> hold(const model::Plan& plan, const std::vector<draft::SetupDraft>& setups,
                                const std::vector<draft::StepDraft>& steps, const Wish& wish, Job& job);

/// Writes the workholding of set-up `at`, if it has one: an instruction of the workpiece's set-up, the
/// fixture used, and the area to avoid if one block can describe it. `by`: what the caller requested.
void write_nouns(model::Plan& plan, const std::vector<draft::SetupDraft>& setups, std::size_t at,
                 const std::string& by);

}  // namespace capstan::workholding
