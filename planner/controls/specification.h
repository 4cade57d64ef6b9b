#pragma once

#include <vector>

#include "planner/controls/dialect.h"
#include "planner/model/plan/plan.h"

namespace capstan::controls {

/// The property (safety.md) of findings on a plan's own statements: the program says what the plan does.
inline constexpr int kSaysWhatThePlanDoes = 33;

/// Whether a plan, as its file has it, tells a control what it must know, once and no more.
///
/// Under-specified  FIT-OPEN, an error: decisions are open. No control closes them; late binding does.
/// Missing          FIT-MISSING, an error: a workingstep's cutter, feed, path or work offset.
/// Contradictory    FIT-CONTRADICTION, an error: two statements of one value that exclude each other.
/// Over-specified   FIT-OVER, a note: what follows from other values, or what the control does not use
///                  (B-splines, broadcasts). FIT-COMPENSATION, an error: a path of the contact, which the
///                  control cannot offset.
/// One finding for each code and workingstep or technology.
/// `part`: of some of its workingsteps only; what others leave open is not asked.
[[nodiscard]] std::vector<model::Finding> specification(const model::Plan& plan, const Conformance& control,
                                                        bool part = false);

}  // namespace capstan::controls
