#pragma once

#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "planner/ground/base/job.h"
#include "planner/ground/memo/memo.h"
#include "planner/model/plan/cutter/cutter.h"
#include "planner/model/plan/order/cut_before.h"
#include "planner/model/plan/plan.h"
#include "planner/model/plan/resources/machine.h"

namespace capstan::verify {

/// A program as it was written, or as somebody else wrote it.
struct ProgramText {
  std::string file_name;   ///< as the user named it
  std::string text;        ///< RS274/NGC as LinuxCNC reads it
  std::string tool_table;  ///< LinuxCNC's .tbl; may be empty: then it is not judged
};

using model::CutBefore;

/// What a check read of a plan's features, for the check of a program of the very same plan
/// (sweep/target/target.h).
struct ReadPart;

/// What is wrong with a plan. Reads what the plan holds, computes everything else itself: stock, removal,
/// force bound, order. Findings come by step in the order of execution, then property, then move; equal
/// ones of a step are folded into the worst with their number.
///
/// Frame      each step's path in its set-up's frame.
/// Accuracy   walls of features: exact, within the tolerance and 1e-3 mm; floors and stock: a height map of
///            at most kMaximumCells cells, whose cell size is stated in the finding where it matters.
/// Cost       linear in the path's length in cells; no more than kMaximumCells heights per set-up. `known`
///            keeps what was found of steps: where the stock before a step, its cutter with shank and holder,
///            its sizes and moves are as in an earlier check, it is not swept again. The findings are the
///            same.
/// Part       steps of `before` get no finding, and features that later steps work on need not be done. The
///            life of a tool is judged without
///            its cuts before.
/// `part`     gets what was read of the part, unless the check ended before.
[[nodiscard]] std::vector<model::Finding> check_plan(const model::Plan& plan, Job& job,
                                                     memo::Memo* known = nullptr,
                                                     const CutBefore* before = nullptr,
                                                     std::shared_ptr<const ReadPart>* part = nullptr);

/// What is wrong with a program, alone or against the plan that it was written from. Steps are found by the
/// markers `(CAPSTAN STEP id="..." n=...)`; `Finding::move` is the line, counted from 1. `part`: what the
/// check of this very plan read of its part, with the same `known`; null: it is read.
[[nodiscard]] std::vector<model::Finding> check_program(const ProgramText& program, const model::Plan* plan,
                                                        const model::Machine& machine,
                                                        const std::vector<model::Cutter>& cutters, Job& job,
                                                        memo::Memo* known = nullptr,
                                                        const CutBefore* before = nullptr,
                                                        const ReadPart* part = nullptr);

/// What each property asks, one sentence; empty for a number that is not checked.
[[nodiscard]] std::string_view property_text(int number);

/// The code of the finding, an error, of a check that was stopped before its end.
inline constexpr std::string_view kStopped = "CHK-STOPPED";
/// That of a check that was stopped before it began.
[[nodiscard]] model::Finding not_begun();
/// The code of the finding, a warning, that faces of the CAD shape are not reached: the part is not whole.
inline constexpr std::string_view kFacesLeft = "CHK-SHAPE-FACES";

/// Largest height map of one set-up.
inline constexpr long kMaximumCells = 1000000;

}  // namespace capstan::verify
