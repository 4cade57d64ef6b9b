#include <algorithm>
#include <cmath>

#include "planner/ground/base/text.h"
#include "planner/model/plan/clearances.h"
#include "rules/strategy/action.h"

// Wider holes below a narrower one: milled from above by a head on a neck that goes down through it.

namespace capstan::rules {
namespace {

using model::CutterClass;
using model::HoleBottom;
using model::ProposedStep;
using model::StrategyKind;
using model::TypeId;

bool is_open(const Making& m) { return m.context.core_depth_mm >= m.shape.depth_mm - 1e-4; }

/// From the top of the narrow hole to the far end.
double down_mm(const Making& m) {
  return m.context.core_height_mm + m.shape.depth_mm + m.context.stock_above_mm;
}

// A drill a little narrower than the hole above opens the way to the far end, where that hole stops short.
Made open_below(const Making& m) {
  const double d = m.context.core_diameter_mm;
  if (is_open(m)) return no("the narrow hole is open to the far end");
  if (m.shape.bottom != HoleBottom::kThrough) return no("a drill's point would go into the bottom");
  ProposedStep s;
  const double hi = d - m.number("under_mm");
  s.depth_mm = m.shape.depth_mm;
  s.tool.classes = {CutterClass::kTwistDrill};
  s.tool.diameter_max_mm = hi;
  s.tool.diameter_min_mm = m.number("of_diameter") * d;
  if (!(s.tool.diameter_min_mm <= hi))
    return no("no drill is a little narrower than a hole of " + mm_text(d));
  s.tool.reach_mm = down_mm(m) + kDrillTip * hi + kReachClearanceMm;
  s.tool.depth_of_cut_mm = s.tool.reach_mm;
  s.why.text = "opens the way to the far end through the hole of " + mm_text(d);
  return s;
}

/// Requirement of a head on a neck that makes `widest` below the narrow hole.
Made through_the_hole(const Making& m, double widest) {
  const double hole = m.context.core_diameter_mm;
  if (!is_open(m) && !(m.hole_mm < hole - 1e-9)) return no("the narrow hole ends above its far end");
  const double open = std::min(hole, m.hole_mm > 0.0 ? m.hole_mm : hole);
  const double below = m.number("past_mm");
  ProposedStep s;
  s.start_diameter_mm = hole;
  s.strategy = StrategyKind::kContourSpiral;
  s.tool.diameter_max_mm = open - 2.0 * model::kHeadClearMm;
  s.tool.neck_step_min_mm = widest - hole + 2.0 * model::kNeckClearMm;
  s.tool.reach_mm = down_mm(m) + (m.shape.through ? below : 0.0) + kReachClearanceMm;
  const double neck = s.tool.diameter_max_mm - s.tool.neck_step_min_mm;
  if (!(neck > 0.0))
    return no("a head of " + mm_text(std::max(0.0, s.tool.diameter_max_mm)) + " that passes the hole of " +
              mm_text(hole) + " leaves no room for a neck: turn the piece over");
  s.why.text = "goes down and up in the middle of the hole of " + mm_text(hole) +
               ", its head cuts on circles below, neck at most " + mm_text(neck) +
               "; cuts under the overhang are not measured, the feed begins at half the start value";
  return s;
}

Made mill(const Making& m) {
  Made made = through_the_hole(m, m.known.diameter.middle());
  if (!made) return made;
  made->tool.classes = {CutterClass::kTSlotMill};
  // Three quarters of the head hang below a far end at first.
  const double past = m.number("past_mm");
  made->tool.cutting_width_max_mm =
      m.shape.through ? std::min(m.shape.depth_mm + past, past / 0.75) : m.shape.depth_mm;
  return made;
}

Made chamfer(const Making& m) {
  const auto& s = m.shape;
  if (!s.through) return no("the head of a back countersink stands below the cone: there must be air");
  Made made = through_the_hole(m, s.bottom_diameter_mm);
  if (!made) return made;
  made->tool.classes = {CutterClass::kBackCountersink};
  made->tool.point_angle_rad =
      2.0 * std::atan2(0.5 * (s.bottom_diameter_mm - s.diameter.nominal_mm), s.depth_mm);
  return made;
}

}  // namespace

std::vector<Action> back_actions() {
  const ActionParameter past{"past_mm", 5.0, "through holes: most that the head stands below the far end"};
  return {
      {"back_open",
       TypeId::kDrilling,
       {{"under_mm", 0.2, "narrower than the hole above, so that its wall is not touched"},
        {"of_diameter", 0.9, "narrowest drill by the hole above"}},
       open_below},
      {"back_mill", TypeId::kBottomAndSideFinishMilling, {past}, mill},
      {"back_chamfer", TypeId::kBottomAndSideFinishMilling, {past}, chamfer},
  };
}

}  // namespace capstan::rules
