#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "planner/making/optimise/cut.h"
#include "planner/making/step/plan_so_far.h"
#include "planner/making/toolpath/path_job.h"

// Rings outwards or inwards, or constant engagement: which steps may have which, what each would take, and
// how the choice stands in the plan.

namespace capstan::step {

/// How an area is cleared.
enum class Clearing : std::uint8_t {
  kOutwards,            ///< rings from a bore or a slot in the middle to the wall
  kInwards,             ///< rings from a ramp along the wall to the middle
  kConstantEngagement,  ///< passes of one arc of contact
};

/// A way of clearing an area that was compared with others by its time.
struct StrategyChoice {
  Clearing way = Clearing::kOutwards;
  std::string taken;                  ///< "constant engagement 1.2 mm wide, 10 mm deep: 1 min 10 s"
  std::vector<model::Rejected> lost;  ///< the others, with their times or why they are not possible
};

/// True if planning chose an explicit strategy for the step, that is a path of constant engagement. ISO 14649
/// has no noun for it; a file's own explicit strategy brings its path.
[[nodiscard]] bool engages_constantly(const model::Plan& plan, const draft::StepDraft& step);

/// Whether a step may have either way: it roughs between walls with an upright end mill, climbing, its
/// technology, depth and width are open, and no file states its strategy. Material that a wider cutter left
/// is for rings. `job` is prepared.
[[nodiscard]] bool may_engage_constantly(const PlanSoFar& p, const draft::StepDraft& step,
                                         const toolpath::PathJob& job);

/// Whether a step that may have either of these may have rings inwards, too: its area is closed and not round
/// (a ramp along it would leave a core), its cutter ramps, and no way in is stated.
[[nodiscard]] bool may_ring_inwards(const PlanSoFar& p, const draft::StepDraft& step,
                                    const toolpath::PathJob& job);

/// About how long a cut takes to remove a volume, s: the volume by the removal rate and, between walls, the
/// ramp down to the bottom at the feed of a slot and the cutter's steepest slope. In an area less than two
/// cutters wide passes of constant engagement are crescents, whose mean width is 2 / pi of their largest
/// (derived). Returns, links and corners are not in it.
[[nodiscard]] double estimated_seconds(const optimise::CutQuestion& question, const optimise::CutAnswer& cut,
                                       double volume_mm3, bool walled);

/// Whether a way is enough quicker than another to be taken in its place.
[[nodiscard]] bool worthwhile(double seconds, double than_s);

/// Why a way that keeps the limits lost against one that takes `best_s`: "takes 1 min 20 s against 1 min 10
/// s"
[[nodiscard]] std::string slower_text(double seconds, double best_s);

/// The same of a way that was only estimated.
[[nodiscard]] std::string estimate_text(double about_s, double best_s);

/// "constant engagement 1.2 mm wide, 10 mm deep"
[[nodiscard]] std::string words_of(Clearing way, const optimise::CutAnswer& cut);

/// Puts the choice into noun and ledger.
void record_strategy(model::Plan& plan, const draft::StepDraft& step, const StrategyChoice& choice);

}  // namespace capstan::step
