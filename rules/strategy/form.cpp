#include <algorithm>
#include <cmath>
#include <numbers>

#include "planner/ground/base/number.h"
#include "planner/ground/base/text.h"
#include "rules/strategy/action.h"

// Threads, chamfers and surfaces.

namespace capstan::rules {
namespace {

using model::CutterClass;
using model::ProposedStep;
using model::StrategyKind;
using model::TypeId;

/// The hole a thread is cut into: what is known of it, and whether it has the size a thread needs.
///
///     minor diameter of ISO metric threads  D1 = D - 1.0825 P
///
/// Source  ISO 724 (D1); upper limit D - 0.8 P: the widest 6H minor diameters of ISO 965-1 from M3 up lie
/// below
///         it (M3: 2.599 = 3 - 0.802 x 0.5).
tl::expected<double, std::string> core(const Making& m) {
  const double major = m.shape.thread_major_mm;
  const double p = m.shape.thread_pitch_mm;
  if (!(p > 0.0)) return tl::unexpected(std::string("the thread states no pitch"));
  if (!(major > 1.0825 * p)) return tl::unexpected(std::string("the pitch is too large for the diameter"));
  double d = m.context.core_diameter_mm > 0.0 ? m.context.core_diameter_mm : m.shape.diameter.nominal_mm;
  if (std::abs(d - major) < 1e-6 || !(d > 0.0)) return major - p;  // the hole is named by its thread
  if (d < major - 1.0825 * p - 0.01 || d > major - 0.8 * p) {
    return tl::unexpected("a hole of " + mm_text(d) + " is no core for M" + trimmed(major, 3) + "x" +
                          trimmed(p, 3) + " (" + mm_text(major - 1.0825 * p) + " to " +
                          mm_text(major - 0.8 * p) + ")");
  }
  return d;
}

Made tap(const Making& m) {
  if (!m.context.abilities.rigid_tapping) return no("the machine does not synchronise spindle and feed");
  const auto c = core(m);
  if (!c) return tl::unexpected(c.error());
  const double p = m.shape.thread_pitch_mm;
  // A tap with a spiral point and a long lead (form B) pushes its chips ahead: it is for holes that go
  // through.
  const double threads = m.number(m.shape.through ? "lead_pitches_through" : "lead_pitches");
  const double lead = threads * p;
  ProposedStep s;
  s.depth_mm = m.shape.thread_depth_mm + lead;  // of the tip
  s.start_diameter_mm = *c;
  s.tool.classes = {CutterClass::kTap};
  s.tool.diameter_exact_mm = m.shape.thread_major_mm;
  s.tool.thread_pitch_mm = p;
  s.tool.lead_threads_max = threads;
  s.lock_override = true;  // feed and spindle run in step
  s.tool.reach_mm = s.depth_mm + m.context.stock_above_mm + kReachClearanceMm;
  return s;
}

Made thread_mill(const Making& m) {
  const auto c = core(m);
  if (!c) return tl::unexpected(c.error());
  ProposedStep s;
  s.depth_mm = m.shape.thread_depth_mm;
  s.start_diameter_mm = *c;
  s.tool.classes = {CutterClass::kThreadMill};
  s.tool.diameter_max_mm = m.number("of_core") * *c;
  s.tool.thread_pitch_mm = m.shape.thread_pitch_mm;
  s.lock_override = true;
  s.tool.reach_mm = s.depth_mm + m.context.stock_above_mm + kReachClearanceMm;
  return s;
}

// Along the edge, with a cone whose flank has the chamfer's slope.
Made chamfer(const Making& m) {
  const double angle =
      m.shape.chamfer_angle_rad;  // against the plane: the cone's half angle is its complement
  const double depth = m.shape.chamfer_width_mm * std::tan(angle);
  return along_a_cone(
      m,
      {.depth_mm = depth, .width_mm = m.shape.chamfer_width_mm, .angle_rad = std::numbers::pi - 2.0 * angle});
}

// Along the edge, with a mill whose concave quarter round has the edge's radius.
Made edge_round(const Making& m) {
  const double r = m.shape.round_radius_mm;
  if (!(r > 0.0)) return no("the edge round states no radius");
  ProposedStep s;
  s.depth_mm = r;
  s.tool.classes = {CutterClass::kCornerRoundingMill};
  s.tool.corner_radius_exact_mm = r;
  s.tool.reach_mm = r + m.context.stock_above_mm + kReachClearanceMm;
  s.strategy = StrategyKind::kContourParallel;
  s.why.text = "a corner rounding mill of the edge's radius, its tip along the wall";
  return s;
}

// A bevel of 45 degrees along the upper edge, where the shop wants no sharp ones.
Made break_edge(const Making& m) {
  using model::ShapeKind;
  const double c = m.context.edge_break_mm;
  if (!(c > 0.0)) return no("no edge is required to be broken");
  const auto& s0 = m.shape;
  const bool closed = (s0.kind == ShapeKind::kPocket || s0.kind == ShapeKind::kHole) && !s0.open;
  if (!closed && s0.kind != ShapeKind::kOutside)
    return no("only the edges of closed pockets, holes and outside contours are broken");
  if (std::abs(s0.slope_rad) > 1e-6) return no("edges over leaning walls are not broken");
  if (c >= s0.depth_mm) return no("the feature is no deeper than the chamfer of its edge");
  ProposedStep s = along_a_cone(m, {.depth_mm = c, .width_mm = c, .angle_rad = 0.5 * std::numbers::pi});
  s.axial_depth_mm = c;
  s.why.text = "edges are broken by " + mm_text(c);
  return s;
}

// Measured in the machine before the step that can still correct it.
Made probe_feature(const Making& m) {
  ProposedStep s;
  s.depth_mm = m.shape.depth_mm;
  s.coolant = false;
  s.tool.classes = {CutterClass::kTouchProbe};
  s.tool.reach_mm = m.number("of_depth") * m.shape.depth_mm + m.context.stock_above_mm + kReachClearanceMm;
  s.why.text = "measured before the step that can still correct it";
  return s;
}

// A size measured in the machine between the last two cuts.
Made measure(const Making& m) {
  Made made = probe_feature(m);
  made->why.text =
      "its size is measured before the last cut, which is then set to what is missing: a boring tool on "
      "its slide, a depth or a cone by the tool's length, a width by planning the last step again with "
      "the diameter that the cutter cuts";
  return made;
}

// Never wider than a passage between walls lets in, nor than their inside corners do. Of sharp corners the
// last cutter's radius stays, and one twice as wide may come before it.
void fit_between_walls(const Making& m, double of_passage, double of_corner, double of_sharp,
                       ProposedStep& s) {
  if (!m.context.surface_walls) return;
  const auto narrow = [&](double diameter, std::string why) {
    if (s.tool.diameter_max_mm > 0.0 && s.tool.diameter_max_mm <= diameter) return;
    s.tool.diameter_max_mm = diameter;
    s.why.text = std::move(why);
  };
  const double left = s.allowance_side_mm;
  // A wall moved inwards by the allowance has corners that much tighter.
  const double corner = m.context.surface_corner_mm;
  if (corner > 0.0)
    narrow(2.0 * std::max(of_corner * corner - left, 0.5 * corner),
           "inside corners of radius " + trimmed(corner, 3) + " mm limit the cutter");
  const double sharp = of_sharp * m.context.surface_sharp_mm;
  if (sharp > 0.0)
    narrow(2.0 * sharp, "inside corners are drawn sharp: a radius of " + trimmed(sharp, 3) + " mm may stay " +
                            (of_sharp > 1.0 ? "until the finish" : "at most"));
  const double passage = m.context.surface_passage_mm;
  if (passage > 0.0)
    narrow(of_passage * std::max(passage - 2.0 * left, 0.5 * passage),
           "the narrowest passage between walls, " + trimmed(passage, 3) + " mm wide, limits the cutter");
}

// Beside a wall the cutter is free of it to its top; what the raw piece has above that is cut before.
double reach_on(const Making& m) {
  const double walls = m.context.surface_height_mm;
  return (walls > 0.0 ? walls : m.shape.depth_mm + m.context.stock_above_mm) + kReachClearanceMm;
}

Made freeform_rough(const Making& m) {
  constexpr double kOfPassage = 0.8, kOfSharp = 2.0;  // default, unsourced: as areas are roughed
  ProposedStep s;
  s.depth_mm = m.shape.depth_mm;
  s.allowance_side_mm = s.allowance_bottom_mm = m.number("allowance_mm");
  s.tool.classes = {CutterClass::kBullnoseEndmill, CutterClass::kEndmill, CutterClass::kBallEndmill};
  s.tool.reach_mm = reach_on(m);
  s.tool.centre_cutting = !m.shape.open;
  s.strategy = StrategyKind::kContourParallel;
  fit_between_walls(m, kOfPassage, 1.0, kOfSharp, s);
  return s;
}

// Walls and level floors, by an end mill that the walls' inside corners let in.
Made freeform_levels(const Making& m) {
  constexpr double kOfCorner = 0.9;  // so that it runs round the corner; default, unsourced
  ProposedStep s;
  s.depth_mm = m.shape.depth_mm;
  s.tool.classes = {CutterClass::kEndmill};
  s.tool.corner_radius_limited = true;
  s.tool.reach_mm = reach_on(m);
  s.strategy = StrategyKind::kContourParallel;
  fit_between_walls(m, 0.95, kOfCorner, kOfCorner, s);  // default, unsourced: as areas are finished
  return s;
}

// With an allowance a it only evens out what roughing left: a ball wider than the creases will do, as long as
// the last one then bears what is left there. Where it does not, the ball before it is no wider than leaves it
// kMostBite of the allowance. In a fillet of radius r between faces at a right angle, a ball of radius R along
// the surface raised by a leaves (R - r - a) (sqrt(2) - 1) more. Source  derived.
Made freeform_finish(const Making& m) {
  ProposedStep s;
  s.depth_mm = m.shape.depth_mm;
  s.allowance_side_mm = s.allowance_bottom_mm = m.number("allowance_mm");
  s.tool.classes = {CutterClass::kBallEndmill};
  double limit = 2.0 * m.context.surface_radius_mm;
  if (m.shape.bottom_radius_mm > 0.0) limit = 2.0 * m.shape.bottom_radius_mm;
  if (m.shape.corner_radius_mm > 0.0)
    limit = limit > 0.0 ? std::min(limit, 2.0 * m.shape.corner_radius_mm) : 2.0 * m.shape.corner_radius_mm;
  const bool last = !(s.allowance_side_mm > 0.0);
  if (last) {
    s.tool.diameter_max_mm = limit;
  } else if (m.number("into_creases") > 0.0 && limit > 0.0) {
    constexpr double kMostBite = 2.0;  // as planning bounds it; default, unsourced
    const double left = s.allowance_side_mm;
    s.tool.diameter_max_mm = limit + 2.0 * (left + (kMostBite - 1.0) * left / (std::numbers::sqrt2 - 1.0));
  }
  s.tool.centre_cutting = true;
  s.tool.reach_mm = m.shape.depth_mm + m.context.stock_above_mm + kReachClearanceMm;
  s.strategy = StrategyKind::kBidirectional;
  if (last && !(limit > 0.0))
    s.why.text = "the smallest concave radius is not known: narrower places keep the ball's radius";
  return s;
}

}  // namespace

std::vector<Action> form_actions() {
  return {
      {"tap",
       TypeId::kTapping,
       {{"lead_pitches", 3.0, "chamfered threads of the tap, ISO 8830 form C: 2 to 3"},
        {"lead_pitches_through", 4.0, "of the tap for through holes, DIN 2197 form B: 3.5 to 5.5"}},
       tap},
      {"thread_mill",
       TypeId::kThreadDrilling,
       {{"of_core", 0.8, "largest thread mill by core diameter"}},
       thread_mill},
      {"chamfer", TypeId::kSideFinishMilling, {}, chamfer},
      {"edge_round", TypeId::kSideFinishMilling, {}, edge_round},
      {"break_edge", TypeId::kSideFinishMilling, {}, break_edge},
      {"probe_feature",
       TypeId::kWorkpieceProbing,
       {{"of_depth", 0.5, "how deep the probe goes, by the feature's depth"}},
       probe_feature},
      {"measure",
       TypeId::kWorkpieceProbing,
       {{"of_depth", 0.5, "how deep it is measured, by the feature's depth"}},
       measure},
      {"freeform_rough",
       TypeId::kFreeformRoughMilling,
       {{"allowance_mm", 0.5, "left on the surface"}},
       freeform_rough},
      // What the mills before it left too much of: planning takes a smaller one than theirs, or leaves it
      // out.
      {"freeform_rest",
       TypeId::kFreeformRoughMilling,
       {{"allowance_mm", 0.5, "left on the surface"}},
       freeform_rough},
      {"freeform_levels", TypeId::kFreeformFinishMilling, {}, freeform_levels},
      {"freeform_finish",
       TypeId::kFreeformFinishMilling,
       {{"allowance_mm", 0.0, "left on the surface; above 0 a semi-finish"},
        {"into_creases", 0.0, "above 0: a semi-finish leaves little in the narrowest places, too"}},
       freeform_finish},
  };
}

}  // namespace capstan::rules
