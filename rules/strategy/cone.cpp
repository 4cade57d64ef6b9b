#include <cmath>
#include <numbers>

#include "planner/ground/base/text.h"
#include "rules/strategy/action.h"

// Cones of holes: by a countersink straight down, or by a chamfer mill on a circle. Where the cone's foot is
// wider than the hole below it, a shoulder stays there, which a countersink's own cone would cut away: the
// foot is milled first, and the chamfer mill keeps its tip on it.

namespace capstan::rules {
namespace {

using model::CutterClass;
using model::ProposedStep;
using model::StrategyKind;
using model::TypeId;

constexpr double kSame = 1e-3;  // mm: a foot as wide as the hole below it

/// Half the full angle of the cone at the top of a hole.
double half_angle(const model::FeatureShape& s) {
  return std::atan(0.5 * (s.diameter.nominal_mm - s.bottom_diameter_mm) / s.depth_mm);
}

/// Whether the hole below the cone, or what earlier steps milled, is narrower than the cone's foot.
bool has_shoulder(const Making& m) {
  return m.hole_mm > 0.0 && m.hole_mm < m.shape.bottom_diameter_mm - kSame;
}

// The cone at the top of a hole, or at its bottom.
Made countersink(const Making& m) {
  const auto& s0 = m.shape;
  const bool at_top = m.known.facts.symbol("taper") == "countersink";
  if (at_top && has_shoulder(m)) {
    return no("a countersink of " + mm_text(s0.diameter.nominal_mm) +
              " cuts the shoulder away that stays between " + mm_text(s0.bottom_diameter_mm) +
              " at the cone's foot and the hole of " + mm_text(m.hole_mm));
  }
  const double half = at_top ? half_angle(s0) : 0.5 * std::numbers::pi - s0.bottom_angle_rad;
  const double d = s0.diameter.nominal_mm;
  const double apex = 0.5 * d / std::tan(half);  // of the sharp cone, below where it is d wide
  // Countersinks are flat at the tip: how deep one goes follows from the cutter chosen (depth 0). At the
  // bottom of a hole only a pointed tool makes the cone.
  ProposedStep s;
  s.depth_mm = at_top ? apex : s0.depth_mm + apex;
  s.start_diameter_mm = m.hole_mm;
  s.tool.reach_mm = s.depth_mm + m.context.stock_above_mm + kReachClearanceMm;
  s.tool.classes = {CutterClass::kCountersink, CutterClass::kChamferMill};
  if (!at_top) s.tool.classes = {CutterClass::kSpotDrill};
  s.tool.point_angle_rad = 2.0 * half;
  if (at_top) {
    s.tool.diameter_min_mm = d;
    s.tool.tip_diameter_max_mm = s0.bottom_diameter_mm;  // a wider tip would rest on the foot of the cone
    s.start_diameter_mm = s0.bottom_diameter_mm;
  } else {
    s.tool.diameter_max_mm = m.known.diameter.nominal_mm + m.known.diameter.lower_mm;
    s.tool.diameter_min_mm = 0.9 * d;
  }
  s.tool.depth_of_cut_mm = at_top ? s0.depth_mm : 0.0;
  if (at_top) s.depth_mm = 0.0;
  s.dwell_s = m.number("dwell_s");
  return s;
}

// The cone at the top of a hole, by a chamfer mill along its wall: any diameter, and its size is corrected by
// the tool's length.
Made countersink_mill(const Making& m) {
  const auto& s0 = m.shape;
  if (m.known.facts.symbol("taper") != "countersink") return no("only cones at the top of a hole are milled");
  if (has_shoulder(m)) {
    return no("the cone's foot of " + mm_text(s0.bottom_diameter_mm) + " is a shoulder around a hole of " +
              mm_text(m.hole_mm) + ", which is to be milled before");
  }
  const double width = 0.5 * (s0.diameter.nominal_mm - s0.bottom_diameter_mm);
  ProposedStep s =
      along_a_cone(m, {.depth_mm = s0.depth_mm, .width_mm = width, .angle_rad = 2.0 * half_angle(s0)});
  s.start_diameter_mm =
      m.context.core_diameter_mm;  // below the cone: room for the tip, or a shoulder under it
  s.allowance_side_mm = m.number("allowance_side_mm");
  if (s.allowance_side_mm >= width)
    return no("an allowance of " + mm_text(s.allowance_side_mm) + " leaves nothing of a cone " +
              mm_text(width) + " wide");
  return s;
}

}  // namespace

ProposedStep along_a_cone(const Making& m, const Bevel& bevel) {
  ProposedStep s;
  s.depth_mm = bevel.depth_mm;
  s.tool.classes = {CutterClass::kChamferMill, CutterClass::kCountersink};
  s.tool.point_angle_rad = bevel.angle_rad;
  s.tool.diameter_min_mm = 2.0 * bevel.width_mm;
  s.tool.depth_of_cut_mm = bevel.depth_mm;
  s.tool.reach_mm = bevel.depth_mm + m.context.stock_above_mm + kReachClearanceMm;
  s.strategy = StrategyKind::kContourParallel;
  return s;
}

std::vector<Action> cone_actions() {
  return {
      {"countersink",
       TypeId::kCounterSinking,
       {{"dwell_s", 0.5, "at the bottom, so that the last turn cleans up"}},
       countersink},
      {"countersink_mill",
       TypeId::kSideFinishMilling,
       {{"allowance_side_mm", 0.0, "left on the cone, across the axis"}},
       countersink_mill},
  };
}

}  // namespace capstan::rules
