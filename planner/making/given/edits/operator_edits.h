#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "planner/ground/base/job.h"
#include "planner/ground/base/result.h"
#include "planner/model/plan/edit/edit.h"
#include "planner/model/plan/plan.h"

// What a person decides of a plan: set into its nouns, bound by the operator and pinned.

namespace capstan::given {

/// Opens what the steps of a plan state and the operator's limits and prohibitions do not allow, with what
/// depends on it, so that it is chosen anew; the first `cut` that the plan executes are cut and stay. Warns
/// EDIT-OPENED.
///
/// Fails  EDIT-CONFLICT where a pinned value breaks one, EDIT-KEPT where the file brings what stays: an
///        operation, a strategy, a tool whose path comes with it.
[[nodiscard]] Status open_beyond_edits(model::Plan& plan, const std::vector<model::Edit>& edits,
                                       const std::vector<model::Cutter>& library, std::size_t cut, Job& job);

/// What was set.
struct Taken {
  std::vector<model::Edit> edits;  ///< as taken: tools by their name, pins with the values that they hold
  bool opened = false;             ///< something that depends on them is to be planned anew
};

/// Sets the values of the edits (set, pin) into the steps of a plan: bound by the operator, pinned, with the
/// edit as the reason; of several that mean a step the one that names it most closely (model::deciding), so
/// that none is set twice. Opens what depends on a value that changed: by the ledger, and of a tool also the
/// cuts of the later steps of its feature, which meet what it leaves. `all`: a value that an edit held and
/// none holds now is open again. `machine`: that the plan is made for. Notes EDIT-YIELDS, EDIT-TAPS.
///
/// Fails  EDIT-NOTHING for a pattern that names no feature and no step, with those that there are;
///        NAME-UNKNOWN for a tool that neither library nor plan has; EDIT-VALUE for a value that a step has
///        not, or that machine, control or cutter cannot have (value_limits.h); EDIT-CONFLICT for a value
///        that another edit rules out.
[[nodiscard]] Result<Taken> take_edits(model::Plan& plan, const std::vector<model::Edit>& edits,
                                       const std::vector<model::Cutter>& library,
                                       const model::Machine& machine, bool all, Job& job);

/// What of a plan breaks an edit, an error for each step; notes a depth beyond what is cut (EDIT-DEPTH).
[[nodiscard]] std::vector<model::Finding> broken_edits(const model::Plan& plan,
                                                       const std::vector<model::Edit>& edits);

}  // namespace capstan::given
