#pragma once

#include <vector>

#include "planner/making/optimise/cut.h"
#include "planner/making/optimise/feeds.h"
#include "planner/making/step/path/stocks.h"
#include "planner/making/step/plan_so_far.h"
#include "planner/making/toolpath/path_job.h"

// Passes over a surface.

namespace capstan::step {

/// Asks for speed and feed of a pass over a surface by what it cuts. Its depth and width are what roughing
/// left there, and no choice: they are those of the sections measured along the path, of which the middle one
/// by removed volume is asked for; each of the others bears a feed of its own (CutQuestion::as_measured).
///
/// Speed is counted at the diameter whose wear, by Taylor's law, is that of all contact diameters d along the
/// path, and at least at that part of the largest one that may run faster than the table (kOverTable):
///
///     D = max((sum d^(1/n) s / sum s)^n, d_max / kOverTable),    d = 2 sqrt(t (2 r - t)) + D0 - 2 r
///
/// t being the top of the contact above the tip, s the length that a section stands for. Nothing changes
/// where no section cuts. Source    T v^(1/n) = C (mechanics::taylor_exponent), wear per way
/// summed: derived.
void ask_as_measured(const std::vector<optimise::CutSample>& samples, optimise::CutQuestion& q);

/// The passes over a surface, which need no speed and feed, and the question for what they cut of the stock;
/// the stock is left as it is.
[[nodiscard]] Result<toolpath::GeneratedPath> pass_over(const PlanSoFar& p, const draft::StepDraft& step,
                                                        const toolpath::PathJob& path, Stocks& stocks,
                                                        optimise::CutQuestion& q, Job& job);

}  // namespace capstan::step
