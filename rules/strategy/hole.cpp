#include <algorithm>
#include <cmath>
#include <iterator>
#include <numbers>

#include "planner/ground/base/number.h"
#include "planner/ground/base/text.h"
#include "planner/ground/vocabulary/unit_factors.h"
#include "rules/strategy/action.h"

// Holes: centre, drill, ream, bore, mill, counterbore. Cones are in cone.cpp.

namespace capstan::rules {
namespace {

using model::CutterClass;
using model::HoleBottom;
using model::ProposedStep;
using model::StrategyKind;
using model::TypeId;

double lower_limit(const Making& m) { return m.known.diameter.nominal_mm + m.known.diameter.lower_mm; }

ProposedStep begin(const Making& m, double depth_mm) {
  ProposedStep s;
  s.depth_mm = depth_mm;
  s.start_diameter_mm = m.hole_mm;
  s.tool.reach_mm = depth_mm + m.context.stock_above_mm + kReachClearanceMm;
  return s;
}

/// Which drills make the hole, from `lo` to `hi`, `best` when it can be had.
struct Window {
  double lo, hi, best;
};

/// Whether drills of that diameter are in the inch sets: sixty-fourths of an inch to half an inch,
/// thirty-seconds to one, numbers 1 to 52 and letters (ASME B94.11M; as tooling/data/inch/drills.yaml has
/// them).
bool is_inch_drill_size(double d) {
  constexpr int kNumbersAndLetters[] = {
      // ten thousandths of an inch
      635,  670,  700,  730,  760,  785,  810,  820,  860,  890,  935,  960,  980,  995,  1015, 1040,
      1065, 1100, 1110, 1130, 1160, 1200, 1285, 1360, 1405, 1440, 1470, 1495, 1520, 1540, 1570, 1590,
      1610, 1660, 1695, 1730, 1770, 1800, 1820, 1850, 1890, 1910, 1935, 1960, 1990, 2010, 2040, 2055,
      2090, 2130, 2210, 2280, 2340, 2380, 2420, 2460, 2500, 2570, 2610, 2660, 2720, 2770, 2810, 2900,
      2950, 3020, 3160, 3230, 3320, 3390, 3480, 3580, 3680, 3770, 3860, 3970, 4040, 4130,
  };
  constexpr double kSame = 1e-3;  // mm
  const double inches = d / kMmPerInch, parts = inches <= 0.5 ? 64.0 : 32.0;
  if (inches > 1.0 / 16.0 - 1e-6 && inches < 1.0 + 1e-6 &&
      std::abs(inches * parts - std::round(inches * parts)) / parts * kMmPerInch < kSame)
    return true;
  return std::any_of(std::begin(kNumbersAndLetters), std::end(kNumbersAndLetters),
                     [&](int n) { return std::abs(1e-4 * n * kMmPerInch - d) < kSame; });
}

/// Twist drills as they are sold: by 0.1 mm to 14 mm, by 0.25 mm to 32 mm (DIN 338), by 0.5 mm beyond (DIN
/// 345).
bool is_drill_size(double d) {
  if (is_inch_drill_size(d)) return true;
  const double step = d <= 14.0 ? 0.1 : d <= 32.0 ? 0.25 : 0.5;
  return std::abs(d / step - std::round(d / step)) * step < 1e-6;
}

// A drill cuts a little oversize (by an unknown amount), so it is at most the middle of the tolerance. Before
// a later step it leaves between half and twice `under`.
Window drill_window(const Making& m) {
  double under = m.number("under_mm");
  if (m.number("for_ream") > 0.0) {
    const Table* table = m.base.table("ream_stock");
    const Row* row = table == nullptr ? nullptr : decide(*table, m.known.facts);
    if (row != nullptr) under = find(row->values, "under_mm").value_or(under);
  }
  if (under > 0.0) {
    const double d = lower_limit(m);
    return {d - 2.0 * under, d - 0.5 * under, d - 1.25 * under};
  }
  const auto& t = m.known.diameter;
  const double lo = t.nominal_mm + t.lower_mm;
  const double hi = t.middle();
  const bool nominal = t.nominal_mm >= lo && t.nominal_mm <= hi && is_drill_size(t.nominal_mm);
  return {lo, hi, nominal && m.number("any_size") == 0.0 ? t.nominal_mm : 0.5 * (lo + hi)};
}

// The band around `best` reaches no further than the nearer end of the window: what it admits lies within.
void require(model::ToolRequirement& tool, const Window& w) {
  tool.diameter_exact_mm = w.best;
  tool.diameter_tolerance_mm = std::max(0.0, std::min(w.hi - w.best, w.best - w.lo));
  tool.diameter_min_mm = w.best - tool.diameter_tolerance_mm;
  tool.diameter_max_mm = w.best + tool.diameter_tolerance_mm;
}

// How deep a drill of that diameter may go (full diameter) without touching the bottom's final surface.
//
// A drill's cone is straight; each bottom's depth over the radius is concave, so it is enough that the cone
// stays above it on the axis and at the hole's wall.
double drill_depth(const Making& m, double drill_mm) {
  const auto& s = m.shape;
  const double tip = kDrillTip * drill_mm;
  const double leave = m.number("leave_mm");
  const double r = 0.5 * s.diameter.nominal_mm;
  switch (s.bottom) {
    case HoleBottom::kThrough:
      return s.depth_mm + m.number("past_mm");
    case HoleBottom::kFlat:
      return s.depth_mm - tip - leave;
    case HoleBottom::kFlatWithRadius:
      return std::min(s.depth_mm - tip - leave, s.depth_mm - s.bottom_hole_radius_mm);
    case HoleBottom::kSpherical: {
      const double ball = std::max(s.bottom_hole_radius_mm, r);
      const double rim = ball - std::sqrt(ball * ball - r * r);
      return std::min(s.depth_mm - tip - leave, s.depth_mm - rim);
    }
    case HoleBottom::kConical: {
      if (m.known.facts.symbol("point") == "drill") return s.depth_mm;
      const double cone = r * std::tan(s.bottom_angle_rad);
      return std::min(s.depth_mm, s.depth_mm + cone - tip - leave);
    }
  }
  return s.depth_mm;
}

/// How a hole of this depth is drilled.
struct Pecks {
  bool peck = false;
  double retract_mm = 0.0;  ///< 0: out of the hole
};

void take(const Pecks& p, ProposedStep& s) {
  s.peck = p.peck;
  s.peck_retract_mm = p.retract_mm;
  if (p.peck) s.operation = TypeId::kMultistepDrilling;
}

Pecks pecks_of(const Row& row) {
  return {find(row.values, "peck").value_or(0.0) > 0.0, find(row.values, "retract_mm").value_or(0.0)};
}

// The row on pecking for this depth; its text, or why it cannot be drilled.
tl::expected<Pecks, std::string> pecked(const Making& m, double ratio, std::string& text) {
  const Table* table = m.base.table("drill_depth");
  if (table == nullptr) return tl::unexpected(std::string("there is no table drill_depth"));
  Facts facts = m.known.facts;
  facts.set("depth_ratio", ratio);
  if (const auto missing = missing_fact(*table, facts)) return tl::unexpected(facts.text(*missing));
  const Row* row = decide(*table, facts);
  if (row == nullptr)
    return tl::unexpected("no row of drill_depth holds for a depth of " + trimmed(ratio, 2) + " D");
  if (!row->cannot.empty()) return tl::unexpected(row->cannot + " [" + row->id + "]");
  if (!row->text.empty()) text = row->text + " [" + row->id + "]";
  return pecks_of(*row);
}

Made drill(const Making& m) {
  const Window w = drill_window(m);
  if (!(w.lo > 0.0))
    return no("no drill is small enough for a hole of " + mm_text(m.shape.diameter.nominal_mm));
  const double depth = drill_depth(m, w.hi);
  if (!(depth > 0.0)) {
    return no("the tip of a " + mm_text(w.best) + " drill is longer than the hole of " +
              mm_text(m.shape.depth_mm) + " is deep");
  }
  ProposedStep s = begin(m, depth);
  s.tool.classes = {CutterClass::kTwistDrill};
  require(s.tool, w);
  if (m.known.facts.symbol("point") == "drill" && m.shape.bottom == HoleBottom::kConical) {
    s.tool.point_angle_rad = std::numbers::pi - 2.0 * m.shape.bottom_angle_rad;
    // tip_angle has no tolerance in ISO 14649: a blunter point leaves rest below the full diameter's depth,
    // unless the file states the tip's radius, too. Never a sharper one, which would go deeper.
    if (!(m.shape.bottom_hole_radius_mm > 0.0))
      s.tool.point_angle_most_rad =
          std::max(s.tool.point_angle_rad, m.number("bluntest_deg") * std::numbers::pi / 180.0);
  }
  const double tip = kDrillTip * w.best;
  s.tool.depth_of_cut_mm = depth + tip + m.context.stock_above_mm;  // chips leave through the flutes
  s.tool.reach_mm += tip;
  s.tool.centre_cutting = true;
  std::string text;
  const auto peck = pecked(m, (depth + m.context.stock_above_mm) / w.best, text);
  if (!peck) return tl::unexpected(peck.error());
  take(*peck, s);
  if (m.number("coolant_through") > 0.0) {
    if (!m.context.has_through_coolant) return no("the machine has no coolant through the spindle");
    s.coolant_through = s.tool.coolant_through = true;
  }
  s.why.text = text;
  return s;
}

// Out of the hole after every step, whatever the table on depths says.
Made peck_drill(const Making& m) {
  Made made = drill(m);
  if (made) take({.peck = true}, *made);
  return made;
}

// The bore that guides a gun drill: of its diameter, a little deep. The drill that makes it must not be
// smaller than the gun drill.
Made gun_pilot(const Making& m) {
  const Window w = drill_window(m);
  if (!(w.lo > 0.0))
    return no("no drill is small enough for a hole of " + mm_text(m.shape.diameter.nominal_mm));
  const double depth = m.number("depth_ratio") * w.best;
  if (depth + kDrillTip * w.hi >= m.shape.depth_mm)
    return no("the hole is too shallow for a pilot and a gun drill");
  ProposedStep s = begin(m, depth);
  s.tool.classes = {CutterClass::kTwistDrill};
  require(s.tool, w);
  s.tool.depth_of_cut_mm = depth + kDrillTip * w.best + m.context.stock_above_mm;
  s.tool.reach_mm += kDrillTip * w.best;
  s.tool.centre_cutting = true;
  s.why.text = "guides the gun drill";
  return s;
}

// Deep holes at one go, chips washed out by coolant through the drill.
Made gun_drill(const Making& m) {
  if (!m.context.has_through_coolant)
    return no("a gun drill needs coolant through the spindle: the machine has none");
  const Window w = drill_window(m);
  if (!(w.lo > 0.0))
    return no("no drill is small enough for a hole of " + mm_text(m.shape.diameter.nominal_mm));
  const double depth = drill_depth(m, w.hi);
  if (!(depth > 0.0)) return no("the tip of a gun drill is longer than the hole is deep");
  if (!(m.hole_mm > 0.0)) return no("a gun drill starts in a pilot bore: gun_pilot comes before it");
  ProposedStep s = begin(m, depth);
  s.start_diameter_mm = 0.0;  // the pilot ends far above the bottom
  s.tool.classes = {CutterClass::kGunDrill};
  require(s.tool, w);
  const double tip = kDrillTip * w.best;
  s.tool.depth_of_cut_mm = depth + tip + m.context.stock_above_mm;
  s.tool.reach_mm += tip;
  s.tool.centre_cutting = true;
  s.coolant_through = s.tool.coolant_through = true;
  s.why.text = "enters its pilot slowly, then drills in one go";
  return s;
}

constexpr double kLeastPilot = 0.5;       // of the largest; default, unsourced
constexpr double kLeastNextPilot = 0.75;  // the same, of a pilot that opens another; default, unsourced

// A hole that a cutter opens: a drill well below it, as large as there is. After another pilot: wider than
// that one may be.
Made pilot(const Making& m) {
  const double d = lower_limit(m);
  const double hi = std::min(m.number("of_diameter") * d, m.number("largest_mm"));
  ProposedStep s = begin(m, drill_depth(m, hi));
  if (!(s.depth_mm > 0.0)) return no("the tip of a pilot drill is longer than the hole is deep");
  s.tool.classes = {CutterClass::kTwistDrill};
  double lo = kLeastPilot * hi;
  if (m.hole_mm > 0.0) {
    // Only the least diameter of the pilot before is known.
    lo = std::max(kLeastNextPilot * hi, m.hole_mm / kLeastPilot + 1.0);
    if (!(lo < hi))
      return no("between the pilot before and " + mm_text(hi) + " there is no room for another");
  }
  s.tool.diameter_min_mm = lo;
  s.tool.diameter_max_mm = hi;
  s.tool.depth_of_cut_mm = s.depth_mm + kDrillTip * hi + m.context.stock_above_mm;
  s.tool.reach_mm += kDrillTip * hi;
  s.tool.centre_cutting = true;
  std::string text;
  const auto peck = pecked(m, s.depth_mm / lo, text);
  if (!peck) return tl::unexpected(peck.error());
  take(*peck, s);
  s.why.text = text;
  return s;
}

/// Room between a spot drill's body and a wall beside the hole, mm. Default, unsourced.
constexpr double kBesideWallMm = 0.25;

/// The mark of a spot at most, of the hole's diameter, so that the drill takes it away. Default, unsourced.
constexpr double kMostOfHole = 0.95;

// A mark for the drill: narrower than the hole, so that nothing of it stays. The body above the mark is
// wider: it must stay clear of walls beside the hole.
Made centre(const Making& m) {
  const double d = lower_limit(m);
  const double depth = std::clamp(m.number("of_diameter") * d, 0.0, m.number("deepest_mm"));
  ProposedStep s = begin(m, depth);
  s.tool.classes = {CutterClass::kSpotDrill, CutterClass::kCenterDrill};
  s.tool.depth_of_cut_mm = depth;
  s.tool.centre_cutting = true;
  s.tool.point_angle_most_rad = 2.0 * std::atan(0.5 * kMostOfHole * d / depth);
  s.start_diameter_mm = 0.0;
  if (m.context.clear_radius_mm) {
    const double clear = *m.context.clear_radius_mm;
    const double widest = 2.0 * (clear - kBesideWallMm);
    if (!(widest > 0.0))
      return no("a wall stands " + mm_text(clear) + " from the hole's axis: no spot drill passes beside it");
    s.tool.diameter_max_mm = widest;
    s.why.text = "a wall stands " + mm_text(clear) + " from the axis: a body of " + mm_text(widest) +
                 " at most passes";
  }
  return s;
}

// Through: the reamer's lead must pass; blind: it cannot pass the bottom, its lead stays unreamed.
double to_the_end(const Making& m) {
  return m.shape.depth_mm + (m.shape.bottom == HoleBottom::kThrough ? m.number("past_mm") : 0.0);
}

Made ream(const Making& m) {
  if (m.known.facts.symbol("reamer") != "fits") return no("no standard H7 reamer makes this tolerance");
  ProposedStep s = begin(m, to_the_end(m));
  s.tool.classes = {CutterClass::kReamer};
  s.tool.diameter_exact_mm = m.shape.diameter.nominal_mm;
  // The flutes are as long as the hole; that they stand out below a through one is a matter of reach, for the
  // shank behind them is thinner.
  s.tool.depth_of_cut_mm = m.shape.depth_mm;
  return s;
}

Made bore(const Making& m) {
  ProposedStep s = begin(m, to_the_end(m));
  s.tool.classes = {CutterClass::kBoringTool};
  s.tool.diameter_exact_mm = m.known.diameter.middle() - m.number("under_mm");
  if (!(s.tool.diameter_exact_mm > m.hole_mm))
    return no("nothing is left to bore in a hole of " + mm_text(m.hole_mm));
  return s;
}

Made mill(const Making& m, double allowance_side, double allowance_bottom) {
  const double d = lower_limit(m);
  if (m.shape.bottom == HoleBottom::kConical && m.hole_mm < 0.9 * d)
    return no("an end mill does not make a conical bottom");
  ProposedStep s = begin(m, m.shape.depth_mm);
  s.allowance_side_mm = allowance_side;
  s.allowance_bottom_mm = m.shape.bottom == HoleBottom::kThrough ? 0.0 : allowance_bottom;
  s.strategy = StrategyKind::kContourSpiral;
  s.tool.classes = {CutterClass::kEndmill};
  s.tool.diameter_max_mm = m.number("of_diameter") * d - 2.0 * allowance_side;
  if (!(s.tool.diameter_max_mm > 0.0)) return no("the allowance leaves no room for an end mill");
  s.tool.centre_cutting = true;  // or a helix that the tool allows
  const double radius = m.shape.bottom == HoleBottom::kFlatWithRadius ? m.shape.bottom_hole_radius_mm : 0.0;
  s.tool.corner_radius_limited = true;
  if (radius > 0.0 && allowance_side == 0.0) {
    s.tool.classes = {CutterClass::kBullnoseEndmill};
    s.tool.corner_radius_exact_mm = radius;
    s.tool.corner_radius_max_mm = radius;
    if (2.0 * radius > s.tool.diameter_max_mm)
      return no("a bottom radius of " + mm_text(radius) + " needs a cutter wider than the hole lets in");
  }
  return s;
}

// A flat cutter's corner stays above a fillet of radius r when both allowances are (1 - 1/sqrt 2) r.
double above_fillet(const Making& m) {
  return m.shape.bottom == HoleBottom::kFlatWithRadius ? 0.293 * m.shape.bottom_hole_radius_mm : 0.0;
}

Made mill_rough(const Making& m) {
  const double fillet = above_fillet(m);
  return mill(m, std::max(m.number("allowance_side_mm"), fillet),
              std::max(m.number("allowance_bottom_mm"), fillet));
}
Made mill_finish(const Making& m) {
  const double side = m.number("allowance_side_mm");
  return mill(m, side, 0.0);
}

Made ball_bottom(const Making& m) {
  const double r = m.shape.bottom_hole_radius_mm;
  const double d = m.shape.diameter.nominal_mm;
  if (std::abs(2.0 * r - d) > 1e-3) {
    return no("a bottom of radius " + mm_text(r) + " under a diameter of " + mm_text(d) +
              " is no half sphere: a ball end mill that fits the hole does not make it");
  }
  ProposedStep s = begin(m, m.shape.depth_mm - r);
  if (!(s.depth_mm >= 0.0)) return no("the hole is shallower than its half sphere");
  s.tool.reach_mm += r;
  s.tool.depth_of_cut_mm = m.shape.depth_mm;
  s.tool.classes = {CutterClass::kBallEndmill};
  s.tool.diameter_exact_mm = d;
  s.tool.corner_radius_exact_mm = r;
  s.tool.centre_cutting = true;
  s.dwell_s = m.number("dwell_s");
  return s;
}

Made counterbore(const Making& m) {
  if (!(m.context.core_diameter_mm > 0.0)) return no("a counterbore's pilot needs a hole");
  ProposedStep s = begin(m, m.shape.depth_mm);
  s.tool.classes = {CutterClass::kCounterbore};
  s.tool.diameter_exact_mm = m.shape.diameter.nominal_mm;
  const auto& t = m.known.diameter;
  s.tool.diameter_min_mm = t.nominal_mm + t.lower_mm;
  s.tool.diameter_max_mm = t.nominal_mm + t.upper_mm;
  s.tool.diameter_tolerance_mm = std::min(-t.lower_mm, t.upper_mm);
  if (s.tool.diameter_tolerance_mm < 0.0)
    return no("the tolerance does not hold the nominal size of a counterbore");
  s.start_diameter_mm = m.context.core_diameter_mm;
  s.dwell_s = m.number("dwell_s");
  return s;
}

}  // namespace

std::vector<Action> hole_actions() {
  const ActionParameter past{"past_mm", 0.0,
                             "through holes: full diameter beyond the bottom, besides what the path adds"};
  const ActionParameter leave{"leave_mm", 0.2, "left between the drill's tip and a bottom that is milled"};
  const ActionParameter dwell{"dwell_s", 0.5, "at the bottom, so that the last turn cleans up"};
  const ActionParameter side{"allowance_side_mm", 0.0, "left on the wall"};
  const ActionParameter under{"under_mm", 0.0, "left on the diameter for the next step"};
  const ActionParameter for_ream{"for_ream", 0.0, "1: leaves what table ream_stock says"};
  const ActionParameter any_size{
      "any_size", 0.0, "1: any drill that the tolerance admits, where the nominal one cannot be had"};
  const ActionParameter bluntest{
      "bluntest_deg", 140.0,
      "point of a drill that may leave rest material in a conical bottom; 140: carbide drills of makers' "
      "catalogues; 0: the bottom's own only"};
  const ActionParameter through{"coolant_through", 0.0, "1: drill and machine give coolant through the tool"};
  return {
      {"centre",
       TypeId::kCenterDrilling,
       {{"of_diameter", 0.3, "depth by diameter"}, {"deepest_mm", 3.0, "depth"}},
       centre},
      {"drill", TypeId::kDrilling, {under, for_ream, any_size, through, past, leave, bluntest}, drill},
      {"peck_drill",
       TypeId::kMultistepDrilling,
       {under, for_ream, any_size, through, past, leave, bluntest},
       peck_drill},
      {"gun_pilot",
       TypeId::kDrilling,
       {under, for_ream, any_size, {"depth_ratio", 1.5, "depth by diameter"}},
       gun_pilot},
      {"gun_drill", TypeId::kDrilling, {under, for_ream, any_size, past, leave}, gun_drill},
      {"pilot",
       TypeId::kDrilling,
       {{"of_diameter", 0.8, "largest drill by diameter"},
        {"largest_mm", 20.0, "largest drill"},
        past,
        leave},
       pilot},
      {"ream", TypeId::kReaming, {{"past_mm", 2.0, "through holes: beyond the bottom, for the lead"}}, ream},
      {"bore", TypeId::kBoring, {past, under}, bore},
      {"mill_rough",
       TypeId::kBottomAndSideRoughMilling,
       {{"of_diameter", 0.6, "largest end mill by diameter"},
        side,
        {"allowance_bottom_mm", 0.0, "left below"}},
       mill_rough},
      {"mill_finish",
       TypeId::kBottomAndSideFinishMilling,
       {{"of_diameter", 0.8, "largest end mill by diameter"}, side},
       mill_finish},
      {"ball_bottom", TypeId::kDrilling, {dwell}, ball_bottom},
      {"counterbore", TypeId::kCounterSinking, {dwell}, counterbore},
  };
}

}  // namespace capstan::rules
