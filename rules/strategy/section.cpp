#include <algorithm>
#include <cmath>

#include "planner/ground/base/text.h"
#include "rules/strategy/action.h"

// Slots that are not square and holes that taper, by cutters that have not their form.

namespace capstan::rules {
namespace {

using model::CutterClass;
using model::ProposedStep;
using model::StrategyKind;
using model::TypeId;

ProposedStep begin(const Making& m) {
  ProposedStep s;
  s.depth_mm = m.shape.depth_mm;
  s.start_diameter_mm = m.hole_mm;
  s.tool.reach_mm = m.shape.depth_mm + m.context.stock_above_mm + kReachClearanceMm;
  s.tool.centre_cutting = !m.shape.open;  // or a ramp that the tool allows
  s.strategy = StrategyKind::kContourParallel;
  return s;
}

/// Half the slot's width at a height above its bottom.
double half_width(const Making& m, double height) {
  const auto& q = m.shape.slot_profile;
  for (std::size_t i = 1; i < q.size(); ++i) {
    if (q[i].x < height) continue;
    const double run = q[i].x - q[i - 1].x;
    return run > 0.0 ? q[i - 1].y + (height - q[i - 1].x) / run * (q[i].y - q[i - 1].y) : q[i].y;
  }
  return q.empty() ? 0.0 : q.back().y;
}

// An end mill in levels, each as wide as the section there lets it in.
Made section_rough(const Making& m) {
  ProposedStep s = begin(m);
  s.allowance_side_mm = m.number("allowance_side_mm");
  s.allowance_bottom_mm = m.number("allowance_bottom_mm");
  const double width = 2.0 * half_width(m, 0.5 * m.shape.depth_mm);
  s.tool.classes = {CutterClass::kEndmill};
  s.tool.diameter_max_mm = m.number("of_width") * (width - 2.0 * s.allowance_side_mm);
  if (!(s.tool.diameter_max_mm > 0.0)) return no("half way down the slot is too narrow to rough");
  s.why.text = "half way down the slot is " + mm_text(width) + " wide";
  return s;
}

// A ball that fits into the rounded bottom, in passes along the slot.
Made section_finish(const Making& m) {
  const double r = m.shape.slot_bottom_radius_mm;
  if (!(r > 0.0)) return no("a bottom without a radius has no ball end mill");
  ProposedStep s = begin(m);
  s.tool.classes = {CutterClass::kBallEndmill};
  s.tool.diameter_max_mm = m.number("of_radius") * 2.0 * r;
  s.why.text = "the bottom's radius of " + mm_text(r) + " limits the ball";
  return s;
}

Made right_way_up(const Making& m) {
  if (m.shape.bottom_diameter_mm > m.shape.diameter.nominal_mm)
    return no("the hole is wider below than above: that is not milled from above");
  ProposedStep s = begin(m);
  s.tool.centre_cutting = true;
  return s;
}

// A drill that stays within the taper's narrow end.
Made taper_drill(const Making& m) {
  auto made = right_way_up(m);
  if (!made) return made;
  ProposedStep& s = *made;
  const double hi = m.shape.bottom_diameter_mm - m.number("under_mm");
  const bool through = m.shape.bottom == model::HoleBottom::kThrough;
  const double tip = kDrillTip * hi;
  if (!(hi > 0.0)) return no("no drill is small enough for the narrow end");
  if (!through) s.depth_mm -= tip + m.number("leave_mm");
  if (!(s.depth_mm > 0.0))
    return no("the tip of a drill of " + mm_text(hi) + " is longer than the hole is deep");
  const Table* table = m.base.table("drill_depth");
  Facts facts = m.known.facts;
  facts.set("depth_ratio", (s.depth_mm + m.context.stock_above_mm) / (0.5 * hi));
  const Row* row = table == nullptr || missing_fact(*table, facts) ? nullptr : decide(*table, facts);
  if (row == nullptr || !row->cannot.empty())
    return no(row == nullptr ? "no row of drill_depth holds" : row->cannot + " [" + row->id + "]");
  s.peck = find(row->values, "peck").value_or(0.0) > 0.0;
  s.peck_retract_mm = find(row->values, "retract_mm").value_or(0.0);
  if (s.peck) s.operation = TypeId::kMultistepDrilling;
  s.strategy = StrategyKind::kNone;
  s.tool.classes = {CutterClass::kTwistDrill};
  s.tool.diameter_min_mm = 0.5 * hi;
  s.tool.diameter_max_mm = hi;
  s.tool.depth_of_cut_mm = s.depth_mm + tip + m.context.stock_above_mm;
  s.tool.reach_mm += tip;
  return made;
}

Made taper_mill(const Making& m, double side, double bottom, CutterClass c) {
  auto made = right_way_up(m);
  if (!made) return made;
  ProposedStep& s = *made;
  s.allowance_side_mm = side;
  s.allowance_bottom_mm = m.shape.bottom == model::HoleBottom::kThrough ? 0.0 : bottom;
  s.tool.classes = {c};
  s.tool.diameter_max_mm = m.number("of_diameter") * (m.shape.bottom_diameter_mm - 2.0 * side);
  if (!(s.tool.diameter_max_mm > 0.0)) return no("the narrow end leaves no room for a cutter");
  s.why.text = "the narrow end of " + mm_text(m.shape.bottom_diameter_mm) + " limits the cutter";
  return made;
}

Made taper_rough(const Making& m) {
  return taper_mill(m, m.number("allowance_side_mm"), m.number("allowance_bottom_mm"), CutterClass::kEndmill);
}
Made taper_levels(const Making& m) { return taper_mill(m, 0.0, 0.0, CutterClass::kEndmill); }
Made taper_finish(const Making& m) { return taper_mill(m, 0.0, 0.0, CutterClass::kBallEndmill); }

}  // namespace

std::vector<Action> section_actions() {
  const ActionParameter side{"allowance_side_mm", 0.0, "left on the walls"};
  const ActionParameter bottom{"allowance_bottom_mm", 0.0, "left on the floor"};
  const ActionParameter narrow_end{"of_diameter", 0.6, "largest cutter by the narrow end"};
  return {
      {"section_rough",
       TypeId::kBottomAndSideRoughMilling,
       {side, bottom, {"of_width", 0.7, "largest cutter by the width half way down"}},
       section_rough},
      {"section_finish",
       TypeId::kBottomAndSideFinishMilling,
       {{"of_radius", 1.0, "largest ball by the bottom's radius"}},
       section_finish},
      {"taper_drill",
       TypeId::kDrilling,
       {{"under_mm", 0.5, "left on the narrow end's diameter"},
        {"leave_mm", 0.2, "left between the drill's tip and a flat bottom"}},
       taper_drill},
      {"taper_rough", TypeId::kBottomAndSideRoughMilling, {side, bottom, narrow_end}, taper_rough},
      {"taper_levels", TypeId::kBottomAndSideFinishMilling, {narrow_end}, taper_levels},
      {"taper_finish", TypeId::kBottomAndSideFinishMilling, {narrow_end}, taper_finish},
  };
}

}  // namespace capstan::rules
