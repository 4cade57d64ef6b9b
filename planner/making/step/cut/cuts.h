#pragma once

#include <map>
#include <string>
#include <tuple>
#include <utility>

#include "planner/ground/base/job.h"
#include "planner/making/draft/draft.h"
#include "planner/making/optimise/cut.h"
#include "planner/making/optimise/feeds.h"
#include "planner/making/toolpath/path_job.h"

// The optimiser, asked once for each question, in all tries at a plan.

namespace capstan::step {

/// Cut answers, found by the whole question: cutter, machine, material, limits and given values. A cutter
/// that sticks out farther in another step is another question, although its id is the same.
class KnownCuts {
 public:
  /// Null where this was not asked before. Valid until the next `keep`.
  [[nodiscard]] const optimise::CutAnswer* find(const optimise::CutQuestion& q) const;
  void keep(const optimise::CutQuestion& q, const optimise::CutAnswer& a);
  /// What paths asked about before have in common with those that are asked about next.
  [[nodiscard]] optimise::KnownFeeds& feeds() { return feeds_; }

 private:
  using Shelf = std::tuple<std::string, double, double, double, double, double>;
  static Shelf shelf_of(const optimise::CutQuestion& q);
  std::multimap<Shelf, std::pair<optimise::CutQuestion, optimise::CutAnswer>> answers_;
  optimise::KnownFeeds feeds_;
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
  /// For `optimise::feeds` and `split_moves`.
  [[nodiscard]] optimise::KnownFeeds& known_feeds() { return known_.feeds(); }

 private:
  KnownCuts& known_;
  optimise::Options options_;
  Job& job_;
};

/// Bounds the feed of passes under an overhang, whose sections are not measured along the path. Where both
/// edges of the head or its whole front cut (PathJob::both_edges_share, front_share), the loads of that cut
/// must stay within torque and power. Torques of the two edges add up; their forces across the neck oppose
/// each other. The whole front cuts as in a slot. A thin last pass (PathJob::last_share) may bend the neck by
/// `at_wall_mm`, and takes beside its width what the others were bent. No feed is below the least chip of
/// the cutter. Returns the loads of the middle pass of a slot; else the answer's.
/// Fails  PIP-INFEASIBLE where no feed holds the limits.
[[nodiscard]] Result<model::StepLoads> hold_under_overhang(const optimise::CutQuestion& q,
                                                           const optimise::CutAnswer& answer,
                                                           double at_wall_mm, toolpath::PathJob& job);

}  // namespace capstan::step
