#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "planner/making/draft/bans.h"
#include "planner/making/draft/draft.h"
#include "planner/making/step/cut/ranking.h"
#include "planner/making/step/path/attempt.h"
#include "planner/making/step/path/equal_areas.h"
#include "planner/making/step/path/surface_rest.h"
#include "planner/making/step/plan_so_far.h"

// One step with one cutter: which strategy, how thick a cut; only planner/door/pipeline/*.cpp include this.

namespace capstan::pipeline {

/// Depth and width of a cut, for people.
[[nodiscard]] std::string sizes(const optimise::CutAnswer& a);
/// Whether a measured cut, whose feeds are open, exceeds a limit by more than step::kTolerableExcess.
[[nodiscard]] bool exceeds(const draft::StepDraft& step, const step::MeasuredCut& t);
/// The limit that a measured cut exceeds, in words.
[[nodiscard]] std::string excess_text(const step::MeasuredCut& t);

/// Tries cutters at steps. Refers to what the caller keeps; `plan` is that of `p`.
class TryCutter {
 public:
  TryCutter(model::Plan& plan, const step::PlanSoFar& p, const draft::Bans& bans, const step::Means& means)
      : plan_(plan), p_(p), bans_(bans), means_(means) {}

  /// How long a candidate's path takes, if it keeps the limits, s; nothing is kept or said of it.
  [[nodiscard]] std::optional<double> seconds_with(draft::StepDraft& step, std::size_t i);
  /// What a candidate's path over a surface takes and leaves, if it keeps the limits; nothing is said of it,
  /// and nothing is kept but by `keep_last`. `rest`: what the step is for; of that alone it tells what is
  /// left. Null: all of the surface.
  [[nodiscard]] std::optional<step::Roughed> roughed_with(draft::StepDraft& step, std::size_t i,
                                                          const step::SurfaceRest* rest = nullptr);
  /// Why the last try of these two kinds does not keep the limits, or has no path.
  [[nodiscard]] const std::string& why_not() const { return why_not_; }
  /// Keeps the try of the last `roughed_with`: where the step's next try is of the same candidate, it is
  /// taken and not made again.
  void keep_last() { kept_ = std::exchange(last_, std::nullopt); }
  /// Tries one of the candidates: rings outwards, and where the step may have them and they could be quicker
  /// rings inwards and constant engagement; takes the quickest of those that keep the limits. Only that one
  /// is removed from the stock. The stock is as it was at `keep_last`, if that was called for this step.
  [[nodiscard]] Result<step::MeasuredCut> with_cutter(draft::StepDraft& step, std::size_t i);

 private:
  /// A try that keeps the limits, taken out of the stock again.
  struct Passed {
    model::AnyRef step;
    const model::Candidate* candidate = nullptr;  ///< of the step's; to know it again
    std::optional<bool> constant_engagement, inwards;
    step::MeasuredCut cut;
    std::vector<Diagnostic> said;
    step::Stocks::Undone removed;
  };
  /// A try of which nothing stays; `look` sees the cut while it is taken out of the stock. Gives the try,
  /// where it keeps the limits.
  template <class F>
  std::optional<Passed> in_passing(draft::StepDraft& step, std::size_t i, const F& look);
  Result<step::MeasuredCut> made_with(draft::StepDraft& step, std::size_t i);
  /// Rings, or constant engagement where that is worthwhile; of the others, it reports only what is recorded.
  /// Of an area that is equal to an earlier one the way that was chosen there is tried first, and taken where
  /// it comes out the same.
  Result<step::MeasuredCut> quickest_way(draft::StepDraft& step, std::size_t i, bool inwards,
                                         const std::optional<step::ConstantCut>& other);
  /// Tries one of the candidates, which the step has, with the strategy that it has: with a thinner cut, up
  /// to kMostThinner times, if a limit is exceeded along its path; takes the gentlest if none keeps the
  /// limits. Removes the cut from the stock, except for a proposed step that exceeds the limits.
  Result<step::MeasuredCut> with_strategy(draft::StepDraft& step, std::size_t i);

  model::Plan& plan_;
  const step::PlanSoFar& p_;
  const draft::Bans& bans_;
  const step::Means& means_;
  std::optional<Passed> last_, kept_;
  std::string why_not_;
  step::EqualAreas areas_;
};

}  // namespace capstan::pipeline
