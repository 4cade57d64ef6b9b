#pragma once

#include <optional>
#include <string>
#include <vector>

#include "planner/ground/base/result.h"
#include "planner/model/plan/cutter/cutter.h"
#include "planner/model/plan/edit/edit.h"
#include "planner/model/plan/resources/machine.h"
#include "planner/model/plan/resources/material.h"

namespace capstan::given {

/// Why no program of this machine can have a feed, speed or depth that a person sets, as a clause with the
/// limit: "above the 10000 mm/min of the axes of 'generic_vmc'"; nothing: it can. What a cut allows of it the
/// check of the plan says.
///
/// Feed   no more than the fastest linear axis, no less than a feed word of the control can say.
/// Speed  within the spindle's, no more than the cutter's own limit.
/// Depth  no less than the cutter cuts and does not smear (mechanics::least_depth_mm).
///
/// Of a limit (EditKind::kLimit) only what is too low is wrong: no feed or speed could keep it.
///
/// cutter   null: it is open
[[nodiscard]] std::optional<std::string> beyond(const model::Edit& e, const model::Machine& machine,
                                                const model::WorkMaterial& material,
                                                const model::Cutter* cutter);

/// The same of all feeds and speeds, before anything is planned. Fails  EDIT-VALUE with the edit, its value
/// and the limit.
///
/// file   the plan's or part's, for the message
[[nodiscard]] Status within_machine(const std::vector<model::Edit>& edits, const model::Machine& machine,
                                    const std::string& file);

}  // namespace capstan::given
