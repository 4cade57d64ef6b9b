#pragma once

#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "planner/making/optimise/cut.h"
#include "planner/making/optimise/feeds.h"
#include "planner/making/step/path/stocks.h"
#include "planner/making/step/plan_so_far.h"
#include "planner/making/toolpath/path_job.h"

// Passes over a surface.

namespace capstan::step {

/// Sets up the question for speed and feed of a pass over a surface. Depth and width are those measured along
/// the path; roughing left them and they are no choice. The optimiser is asked for the median section by
/// removed volume; each other section gets a feed of its own (CutQuestion::as_measured).
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

/// True if the step finishes in passes side by side with the round of its cutter: a freeform surface, a slot
/// whose section is not square, a hole that narrows downwards. Such a pass is as deep as what roughing left
/// where it runs, whatever the feature's depth.
[[nodiscard]] bool finishes_in_passes(const model::Model& m, const draft::StepDraft& step,
                                      const model::FeatureShape& shape);

using MakePath = std::function<Result<toolpath::GeneratedPath>(const toolpath::PathJob&)>;
/// Makes the passes over a surface, which need no speed and feed, and completes the question with the
/// sections that they cut. The stock is not changed.
[[nodiscard]] Result<toolpath::GeneratedPath> pass_over(const PlanSoFar& p, const draft::StepDraft& step,
                                                        const toolpath::PathJob& path, Stocks& stocks,
                                                        optimise::CutQuestion& q, const MakePath& make);

/// How far the tip of a cutter bends, mm/N, where that is why it was not taken.
[[nodiscard]] std::optional<double> bent_too_much(const model::Cutter& cutter, std::string_view why_not);
/// Why a ball that is to finish a surface is not tried: it bends so much more than one that bends too much,
/// `bent_mm_n`. A path over a surface takes seconds, and a slender ball is no remedy. Empty: it is tried.
[[nodiscard]] std::optional<std::string> surely_bends(const model::Model& m, const draft::StepDraft& step,
                                                      std::size_t candidate, std::optional<double> bent_mm_n);

}  // namespace capstan::step
