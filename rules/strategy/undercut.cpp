#include <algorithm>
#include <cmath>

#include "planner/ground/base/text.h"
#include "rules/strategy/action.h"

// Slots under an overhang: an upright slot through the mouth first, then a form cutter along the course.

namespace capstan::rules {
namespace {

using model::CutterClass;
using model::ProposedStep;
using model::StrategyKind;
using model::TypeId;

/// Half widths at the mouth and on the floor, height of the wide part.
struct Section {
  double mouth = 0.0, widest = 0.0, height = 0.0;
  bool leaning = false;
};

tl::expected<Section, std::string> section_of(const Making& m) {
  const auto& q = m.shape.slot_profile;
  if (q.size() < 2 || !(q.front().y > q.back().y + 1e-6))
    return tl::unexpected(std::string("the slot does not widen below its mouth"));
  if (!m.shape.open)
    return tl::unexpected(std::string("a form cutter under the mouth needs an open end to enter by"));
  return Section{q.back().y, q.front().y, q[1].x, std::abs(q[1].y - q.front().y) > 1e-9};
}

ProposedStep begin(const Making& m) {
  ProposedStep s;
  s.depth_mm = m.shape.depth_mm;
  s.tool.reach_mm = m.shape.depth_mm + m.context.stock_above_mm + kReachClearanceMm;
  return s;
}

// The mouth's width, down to the floor, by an end mill.
Made neck(const Making& m) {
  const auto q = section_of(m);
  if (!q) return no(q.error());
  ProposedStep s = begin(m);
  s.allowance_side_mm = m.number("allowance_side_mm");
  s.tool.classes = {CutterClass::kEndmill};
  s.tool.diameter_max_mm = m.number("of_passage") * 2.0 * (q->mouth - s.allowance_side_mm);
  s.tool.corner_radius_limited = true;
  if (!(s.tool.diameter_max_mm > 0.0)) return no("the allowance leaves no room for an end mill in the mouth");
  s.strategy = StrategyKind::kContourParallel;
  s.why.text = "the slot through the mouth of " + mm_text(2.0 * q->mouth) + ", before the form cutter";
  return s;
}

// The head under the overhang: no wider than the slot; its neck passes the mouth while the head is at a side.
Made form(const Making& m, CutterClass c, bool leaning) {
  const auto q = section_of(m);
  if (!q) return no(q.error());
  if (q->leaning != leaning)
    return no(leaning ? "the flanks do not lean" : "the flanks lean: that is a dovetail");
  ProposedStep s = begin(m);
  s.tool.classes = {c};
  s.tool.diameter_max_mm = 2.0 * q->widest;
  s.tool.diameter_min_mm = m.number("of_width") * 2.0 * q->widest;
  if (leaning) {
    s.tool.depth_of_cut_mm = q->height;
    s.tool.taper_angle_rad = std::atan((q->widest - q->mouth) / q->height);
  } else {
    s.tool.cutting_width_max_mm = q->height;
    s.tool.neck_diameter_max_mm = 2.0 * q->mouth - 0.2;
    // Below the mouth the head alone is in the way.
    s.tool.reach_mm = m.shape.depth_mm;
  }
  s.strategy = StrategyKind::kCenterMilling;
  s.why.text =
      "enters and leaves at its depth by the open end; cuts under the overhang are not measured, the feed is "
      "that of what stands beside the mouth, at half the start value";
  return s;
}

Made t_slot(const Making& m) { return form(m, CutterClass::kTSlotMill, false); }
Made dovetail(const Making& m) { return form(m, CutterClass::kDovetailMill, true); }

}  // namespace

std::vector<Action> undercut_actions() {
  const ActionParameter side{"allowance_side_mm", 0.0, "left on the mouth's walls"};
  const ActionParameter passage{"of_passage", 0.95, "largest end mill by the mouth"};
  const ActionParameter width{"of_width", 0.9, "narrowest form cutter by the slot's widest place"};
  return {
      {"t_slot_rough", TypeId::kBottomAndSideRoughMilling, {side, passage}, neck},
      {"t_slot_finish", TypeId::kBottomAndSideFinishMilling, {width}, t_slot},
      {"dovetail_rough", TypeId::kBottomAndSideRoughMilling, {side, passage}, neck},
      {"dovetail_finish", TypeId::kBottomAndSideFinishMilling, {width}, dovetail},
  };
}

}  // namespace capstan::rules
