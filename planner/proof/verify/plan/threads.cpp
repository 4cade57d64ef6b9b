#include <algorithm>
#include <cmath>
#include <numbers>

#include "planner/model/nouns/all.h"
#include "planner/proof/verify/copies/copies.h"
#include "planner/proof/verify/plan/plan_checks.h"
#include "planner/proof/verify/sweep/target/target.h"

// Heights hold no groove, so that of a thread mill the sweep sees its outline alone. Which thread it leaves
// follows from three numbers, each held against the pitch P that the file states:
//
//     pitch of its profiles    P: each row runs in the groove of the next
//     rise of its way          P for each turn of 2 pi, up counter-clockwise for a right-hand thread
//     its rows and its rise    together as long as the thread, less one pitch that runs out

namespace capstan::verify {

namespace {

using volumes::Bore;
using volumes::Form;

/// What two pitches may differ by, mm: written decimals. Over twenty profiles it is 0.02 mm. Default,
/// unsourced.
constexpr double kPitchMm = 0.001;
/// What the rise of a turn may be off, mm: two coordinates of three decimals on each half turn, derived.
constexpr double kRiseMm = 0.003;

/// The thread that a step makes; null: none, or none whose pitch is stated.
const Form* thread_of(const model::Plan& plan, const PartShapes& part, const StepMoves& s) {
  if (s.planned == nullptr || s.cutter == nullptr || !mills_threads(s.cutter->cutter_class)) return nullptr;
  const auto* ws = plan.model.get<model::MachiningWorkingstep>(s.planned->step);
  const PartShapes::Entry* e = ws != nullptr ? part.find(ws->its_feature) : nullptr;
  if (e == nullptr || e->shapes.empty()) return nullptr;
  const Form& first = e->shapes.front();
  return first.kind == model::ShapeKind::kThread && first.bore() != nullptr &&
                 first.bore()->thread_pitch_mm > 0.0
             ? &first
             : nullptr;
}

void check_profiles(const model::Cutter& c, const Bore& thread, const Findings::Where& at,
                    Findings& findings) {
  const double pitch = thread.thread_pitch_mm;
  if (c.thread_pitch_mm > 0.0) {
    if (std::abs(c.thread_pitch_mm - pitch) > kPitchMm)
      findings.error(11, "CHK-THREAD", at,
                     "the profiles of tool " + c.id + " have a pitch of " + mm(c.thread_pitch_mm) +
                         ", the thread " + mm(pitch) + ": take a thread mill of that pitch",
                     std::abs(c.thread_pitch_mm - pitch));
  } else if (c.maximum_depth_of_cut_mm >= 2.0 * pitch) {
    findings.unproved(Severity::kNote, 11, "CHK-THREAD-UNDECIDED", at,
                      "tool " + c.id + " has teeth over " + mm(c.maximum_depth_of_cut_mm) +
                          " and states no pitch: whether they cut the thread's of " + mm(pitch) +
                          " is not looked at");
  }
}

void check_helix(const StepMoves& s, const Bore& thread, Findings& findings) {
  const double pitch = thread.thread_pitch_mm;
  double low = 1e300, high = -1e300;
  for (const Move& m : s.moves) {
    const bool arc = m.kind == model::MoveKind::kArcCw || m.kind == model::MoveKind::kArcCcw;
    if (!arc || m.role != model::MoveRole::kCut) continue;
    low = std::min({low, m.from.z, m.to.z});
    high = std::max({high, m.from.z, m.to.z});
    const double turned = sweep_of(m);
    if (!(turned > 0.0)) continue;
    // Positive for a right-hand helix, whichever way along it.
    const double sense = m.kind == model::MoveKind::kArcCcw ? 1.0 : -1.0;
    const double rise = sense * (m.to.z - m.from.z) * 2.0 * std::numbers::pi / turned;
    const double wanted = thread.left_hand ? -pitch : pitch;
    if (std::abs(rise - wanted) <= kRiseMm) continue;
    findings.error(11, "CHK-THREAD", {s.order + 1, s.id, m.where},
                   "the way of the thread mill climbs " + mm(std::abs(rise)) + " in a turn, " +
                       (rise < 0.0 ? "left" : "right") + "-hand; the thread has a pitch of " + mm(pitch) +
                       ", " + (thread.left_hand ? "left" : "right") + "-hand",
                   std::abs(rise - wanted));
    return;
  }
  if (low > high) return;
  const double rows = s.cutter->maximum_depth_of_cut_mm;
  const double reached = high - low + (rows >= 2.0 * pitch ? rows : 0.0);
  if (reached >= thread.thread_depth_mm - pitch) return;
  findings.error(36, "CHK-THREAD-LENGTH", {s.order + 1, s.id, -1},
                 "the thread mill makes " + mm(reached) + " of the thread's " + mm(thread.thread_depth_mm) +
                     ": let it make more turns, or take one with more profiles",
                 thread.thread_depth_mm - reached);
}

}  // namespace

void check_threads(const model::Plan& plan, const PartShapes& part, const std::vector<StepMoves>& steps,
                   Findings& findings) {
  for (const StepMoves& s : steps) {
    const Form* thread = thread_of(plan, part, s);
    if (thread == nullptr) continue;
    check_profiles(*s.cutter, *thread->bore(), {s.order + 1, s.id, -1}, findings);
    check_helix(s, *thread->bore(), findings);
  }
}

}  // namespace capstan::verify
