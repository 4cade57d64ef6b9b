#pragma once

#include <map>
#include <string>
#include <tuple>
#include <utility>

#include "planner/ground/base/job.h"
#include "planner/making/draft/draft.h"
#include "planner/making/optimise/cut.h"
#include "planner/making/toolpath/path_job.h"

// The optimiser, asked once for each question, in all tries at a plan.

namespace capstan::step {

/// Answers by their whole question: cutter, machine, material, limits and what is given. Two cutters of one
/// id are two questions where they differ in anything, as one that stands out farther in another step does.
class KnownCuts {
 public:
  /// Null where this was not asked before. Valid until the next `keep`.
  [[nodiscard]] const optimise::CutAnswer* find(const optimise::CutQuestion& q) const;
  void keep(const optimise::CutQuestion& q, const optimise::CutAnswer& a);

 private:
  using Shelf = std::tuple<std::string, double, double, double, double, double>;
  static Shelf shelf_of(const optimise::CutQuestion& q);
  std::multimap<Shelf, std::pair<optimise::CutQuestion, optimise::CutAnswer>> answers_;
};

class Cuts {
 public:
  /// `known` and `job` are referred to.
  Cuts(KnownCuts& known, optimise::Options options, Job& job);
  Cuts(const Cuts&) = delete;
  Cuts& operator=(const Cuts&) = delete;
  [[nodiscard]] Result<optimise::CutAnswer> answer(const optimise::CutQuestion& q);
  /// As above; where a stated speed or feed that stays (StepDraft::keep_speed) allows no cut within the
  /// limits and one of its own would, it is let go of, in `q` too, and `let_go` says what and why.
  [[nodiscard]] Result<optimise::CutAnswer> answer(const draft::StepDraft& step, optimise::CutQuestion& q,
                                                   std::string& let_go);
  /// Of a face: the cut that covers it in one pass, where the cutter is wide enough for that and it takes
  /// less than the passes of the answer; else the answer.
  [[nodiscard]] optimise::CutAnswer in_one_pass(const optimise::CutQuestion& q, optimise::CutAnswer several);

 private:
  KnownCuts& known_;
  optimise::Options options_;
  Job& job_;
};

/// Cuts under an overhang are not measured: bounds the feed of the passes in which more than one edge of the
/// head cuts (PathJob::both_edges_share, front_share) by the loads of what they cut, so that torque and power
/// hold there, too. Of both edges at once these add up, while the forces across, which bend the neck, stand
/// against each other; the whole front is a slot. Gives the loads of the middle pass.
/// Fails  PIP-INFEASIBLE where no feed holds the limits.
[[nodiscard]] Result<model::StepLoads> hold_under_overhang(const optimise::CutQuestion& q,
                                                           const optimise::CutAnswer& answer,
                                                           toolpath::PathJob& job);

}  // namespace capstan::step
