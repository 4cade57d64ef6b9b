#include <algorithm>
#include <cmath>
#include <limits>

#include "planner/ground/base/text.h"
#include "planner/model/features/in_piece.h"
#include "rules/strategy/action.h"

// Faces, pockets, square slots, steps and outsides: an area, walls, a floor.

namespace capstan::rules {
namespace {

using model::CutterClass;
using model::ProposedStep;
using model::ShapeKind;
using model::StrategyKind;
using model::TypeId;

ProposedStep begin(const Making& m) {
  ProposedStep s;
  s.depth_mm = m.shape.depth_mm;
  s.tool.reach_mm = m.shape.depth_mm + m.context.stock_above_mm + kReachClearanceMm;
  s.tool.centre_cutting = !m.shape.open;  // or a ramp that the tool allows
  return s;
}

struct Limit {
  double diameter_mm = 0.0;  // 0: no limit
  std::string text;
};

// The largest cutter for the corners of walls with an allowance; 0: no limit. `times` above 1: by so much
// wider than the corners themselves, for a finish that takes what stays in them.
Limit corner_cutter(const Making& m, double allowance, double times = 1.0) {
  const auto& s = m.shape;
  if (times > 1.0 && s.corner_radius_mm > 0.0)
    return {2.0 * times * s.corner_radius_mm, "corners of radius " + mm_text(s.corner_radius_mm) +
                                                  " may keep up to " + mm_text(times * s.corner_radius_mm) +
                                                  " until the finish"};
  // A wall moved inwards by the allowance has corners that much tighter.
  if (s.corner_radius_mm > 0.0)
    return {2.0 * std::max(s.corner_radius_mm - allowance, 0.5 * s.corner_radius_mm),
            "corners of radius " + mm_text(s.corner_radius_mm) + " limit the cutter"};
  if ((!s.open || s.kind == ShapeKind::kPocket) && m.known.passage.exact_mm > 0.0)
    return {m.known.passage.exact_mm, "the outline's own corners limit the cutter"};
  return {};
}

/// The widest cutter of a step by the distance of the walls at its ends: their corners keep its radius.
/// Default, unsourced.
constexpr double kOfEnds = 0.5;

/// Factor of the roughing cutter's size to that of the cutter that finishes sharp inner corners after it. In
/// a right angle 0.41 of the finishing cutter's radius remains, which its round along the walls removes.
/// Default, unsourced.
constexpr double kBeforeSharp = 2.0;

// The widest cutter between walls with an allowance, and what determines it.
Limit widest_cutter(const Making& m, double of_passage, double allowance, bool corners = true,
                    double of_sharp = 1.0, double times = 1.0) {
  const auto& s = m.shape;
  double limit = std::numeric_limits<double>::infinity();
  Limit out;
  const auto narrow = [&](double d, std::string why) {
    if (d < limit) {
      limit = d;
      out.text = std::move(why);
    }
  };
  const double passage = m.known.passage.narrowest_mm;
  const bool bounded = !s.open || !s.islands.empty() || s.kind == ShapeKind::kSlot ||
                       s.kind == ShapeKind::kPocket || model::stops_at_walls(s);
  if (bounded && s.kind != ShapeKind::kStep)
    narrow(of_passage * (passage - 2.0 * allowance),
           "the narrowest passage of " + mm_text(passage) + " limits the cutter");
  if (s.kind == ShapeKind::kStep && m.context.between_ends_mm > 0.0)
    narrow(kOfEnds * m.context.between_ends_mm,
           "walls " + mm_text(m.context.between_ends_mm) + " apart at the step's ends limit the cutter");
  if (m.context.sharp_corner_mm > 0.0)
    narrow(2.0 * of_sharp * m.context.sharp_corner_mm,
           "inner corners are drawn sharp: a radius of " + mm_text(of_sharp * m.context.sharp_corner_mm) +
               (of_sharp > 1.0 ? " may stay until the finish" : " may stay at most"));
  const Limit corner = corner_cutter(m, allowance, times);
  if (!corners) {
    out.text += (out.text.empty() ? "" : "; ") + std::string("corners are left to a smaller cutter");
  } else if (corner.diameter_mm > 0.0) {
    narrow(corner.diameter_mm, corner.text);
  } else if (!s.open && s.kind != ShapeKind::kFace) {
    out.text +=
        (out.text.empty() ? "" : "; ") + std::string("corners are sharp: they keep the cutter's radius");
  }
  if (std::isfinite(limit)) out.diameter_mm = limit;
  return out;
}

/// A cutter this much wider than the one for the corners is worth a second tool. Default, unsourced.
constexpr double kWorthARest = 1.25;

// The cutter of a step whose corners a later one cuts; or why there is no use in that.
tl::expected<Limit, std::string> before_rest(const Making& m, double of_passage, double allowance,
                                             model::ToolRequirement& tool) {
  const Limit corner = corner_cutter(m, allowance);
  if (!(corner.diameter_mm > 0.0))
    return tl::unexpected(std::string("no corner asks for a smaller cutter: there is no rest to machine"));
  Limit wide = widest_cutter(m, of_passage, allowance, false);
  if (wide.diameter_mm > 0.0 && wide.diameter_mm < kWorthARest * corner.diameter_mm)
    return tl::unexpected("a cutter of at most " + mm_text(wide.diameter_mm) + " (" + wide.text +
                          ") is not wide enough to be worth a second one of " + mm_text(corner.diameter_mm) +
                          " for the corners");
  tool.diameter_min_mm = kWorthARest * corner.diameter_mm;
  return wide;
}

/// The widest cutter that reaches a share of the area within the allowance, corners and narrow places left
/// out, by bisection: a cutter of diameter D reaches offset(offset(area, -D/2), D/2). 0: none of at least
/// `least_mm` does. `bound`: least_mm itself is answer enough.
double widest_reaching(const Making& m, double share, double allowance, double least_mm, bool bound) {
  constexpr double kChord = 0.02;
  constexpr double kAccuracy = 0.05;  // of the result; sizes of mills are farther apart. Default, unsourced.
  const auto& s = m.shape;
  double hi = m.number("of_passage") * m.known.passage.widest_mm;
  if (hi < least_mm) return 0.0;
  geometry::Region free = s.reach.empty() ? s.area : s.reach;
  for (const auto& island : s.islands) free = geometry::subtract(free, island.area);
  free = geometry::offset(free, -allowance, kChord);
  const double wanted = share * geometry::area(free);
  const auto reaches = [&](double d) {
    const auto stood = geometry::offset(free, -0.5 * d, kChord);
    return !stood.empty() && geometry::area(geometry::offset(stood, 0.5 * d, kChord)) >= wanted;
  };
  if (!reaches(least_mm)) return 0.0;
  double lo = least_mm;
  while (!bound && hi - lo > kAccuracy * lo) {
    const double mid = 0.5 * (lo + hi);
    (reaches(mid) ? lo : hi) = mid;
  }
  return lo;
}

// The cutter of a step that leaves corners and narrow places to a narrower one; or why there is no use in
// that. `bound`: only whether there is one.
tl::expected<Limit, std::string> before_narrow(const Making& m, double allowance, const Limit& narrow,
                                               bool bound, model::ToolRequirement& tool) {
  if (!(narrow.diameter_mm > 0.0)) return tl::unexpected(std::string("nothing asks for a narrower cutter"));
  const double least = kWorthARest * narrow.diameter_mm;
  const double wide = widest_reaching(m, m.number("of_area"), allowance, least, bound);
  if (!(wide > 0.0))
    return tl::unexpected("no cutter of " + mm_text(least) + ", wide enough to be worth a second one of " +
                          mm_text(narrow.diameter_mm) + ", reaches enough of the area");
  tool.diameter_min_mm = least;
  return Limit{wide, narrow.text + "; that is left to a narrower cutter"};
}

// Allowance of roughing such that a cutter without the fillet's radius stays above the fillet: its corner
// lies on or above the arc of radius r if both allowances are (1 - 1/sqrt 2) r.
double for_fillet(const Making& m) { return 0.293 * model::largest_fillet_mm(m.shape); }

/// `leaves`: as its row says, which may leave corners or narrow places to a step after it.
Made rough_with(const Making& m, bool leaves) {
  ProposedStep s = begin(m);
  s.allowance_side_mm = std::max(m.number("allowance_side_mm"), for_fillet(m));
  s.allowance_bottom_mm = m.shape.through ? 0.0 : std::max(m.number("allowance_bottom_mm"), for_fillet(m));
  s.tool.classes = {CutterClass::kEndmill, CutterClass::kBullnoseEndmill};
  const bool finish_follows = m.number("allowance_side_mm") > 0.0;
  Limit limit = widest_cutter(m, m.number("of_passage"), s.allowance_side_mm, true,
                              finish_follows ? kBeforeSharp : 1.0, m.number("corners"));
  if (leaves && m.number("of_area") < 1.0) {
    const auto wide = before_narrow(m, s.allowance_side_mm, limit, false, s.tool);
    if (!wide) return no(wide.error());
    limit = *wide;
  } else if (leaves && m.number("corners") == 0.0) {
    const auto wide = before_rest(m, m.number("of_passage"), s.allowance_side_mm, s.tool);
    if (!wide) return no(wide.error());
    limit = *wide;
  }
  if (limit.diameter_mm < 0.0 || (limit.diameter_mm == 0.0 && !limit.text.empty() && !m.shape.open))
    return no("no cutter is narrow enough: " + limit.text);
  s.tool.diameter_max_mm = limit.diameter_mm;
  s.tool.corner_radius_limited = true;
  s.tool.corner_radius_max_mm =
      s.allowance_bottom_mm;  // a corner radius up to the allowance leaves at most the allowance
  s.strategy = m.shape.kind == ShapeKind::kStep || m.shape.kind == ShapeKind::kFace
                   ? StrategyKind::kBidirectional
                   : StrategyKind::kContourParallel;
  s.why.text = limit.text;
  return s;
}

Made rough(const Making& m) { return rough_with(m, true); }

constexpr const char* kFilletsDiffer =
    "the fillets at its floor have different radii, so that no one cutter makes them";

std::string too_round(double r, const Limit& limit) {
  return "a floor fillet of " + mm_text(r) + " needs a wider cutter than fits (" + limit.text + ")";
}

/// A cutter whose corner makes a fillet of radius r at the foot of a wall.
void make_fillet(model::ToolRequirement& tool, double r) {
  tool.classes = {CutterClass::kBullnoseEndmill};
  tool.corner_radius_exact_mm = tool.corner_radius_max_mm = r;
}

Made finish(const Making& m) {
  ProposedStep s = begin(m);
  s.allowance_side_mm = m.number("allowance_side_mm");
  s.allowance_bottom_mm = m.shape.through ? 0.0 : m.number("allowance_bottom_mm");
  Limit limit = widest_cutter(m, m.number("of_passage"), s.allowance_side_mm, true, 1.0, m.number("corners"));
  if (m.number("corners") == 0.0) {
    const auto wide = before_rest(m, m.number("of_passage"), s.allowance_side_mm, s.tool);
    if (!wide) return no(wide.error());
    limit = *wide;
  }
  if (limit.diameter_mm < 0.0) return no("no cutter is narrow enough: " + limit.text);
  s.tool.diameter_max_mm = limit.diameter_mm;
  s.tool.corner_radius_limited = true;
  const auto fillet = model::floor_fillet_mm(m.shape);
  if (!fillet) return no(kFilletsDiffer);
  s.tool.classes = {CutterClass::kEndmill};
  if (const double r = *fillet; r > 0.0) {
    if (limit.diameter_mm > 0.0 && 2.0 * r > limit.diameter_mm + 1e-9) return no(too_round(r, limit));
    make_fillet(s.tool, r);
    s.tool.classes.push_back(CutterClass::kBallEndmill);
  }
  s.strategy = StrategyKind::kContourParallel;
  s.why.text = limit.text;
  return s;
}

// Only what the step before, made with `corners: 0`, could not reach.
Made rest(const Making& m, Made made) {
  if (!made) return made;
  ProposedStep& s = *made;
  if (std::abs(m.shape.slope_rad) > 1e-6) return no("rest machining needs upright walls");
  const double times = std::max(1.0, m.number("corners"));
  const Limit corner = corner_cutter(m, s.allowance_side_mm, times);
  model::ToolRequirement before;
  const auto wide = before_rest(m, m.number("of_passage"), s.allowance_side_mm, before);
  if (!wide) return no(wide.error());
  const double corners = corner_cutter(m, 0.0, times).diameter_mm;
  s.tool.diameter_max_mm = std::min(corner.diameter_mm, m.number("of_corner") * corners);
  if (wide->diameter_mm > 0.0) s.tool.diameter_max_mm = std::min(s.tool.diameter_max_mm, wide->diameter_mm);
  s.tool.diameter_min_mm = 0.0;
  if (s.tool.corner_radius_exact_mm > 0.0 && 2.0 * s.tool.corner_radius_exact_mm > s.tool.diameter_max_mm)
    return no("a floor fillet of " + mm_text(s.tool.corner_radius_exact_mm) +
              " needs a wider cutter than the corners let in");
  s.rest_of_diameter_mm = wide->diameter_mm > 0.0 ? wide->diameter_mm : before.diameter_min_mm;
  s.strategy = StrategyKind::kContourParallel;
  s.why.text = corner.text + "; only what the wider cutter before left is cut";
  return made;
}

// As `rest`, with the narrow places that a step before, made with the same `of_area`, did not enter.
Made narrow_rest(const Making& m) {
  Made made = rough_with(m, false);
  if (!made) return made;
  ProposedStep& s = *made;
  if (std::abs(m.shape.slope_rad) > 1e-6) return no("rest machining needs upright walls");
  model::ToolRequirement before;
  const auto wide = before_narrow(m, s.allowance_side_mm, {s.tool.diameter_max_mm, s.why.text}, true, before);
  if (!wide) return no(wide.error());
  // A bound: which cutter it was is known when it is chosen (propose/coaxial_steps.h).
  s.rest_of_diameter_mm = m.known.passage.widest_mm;
  s.why.text += "; only what the wider cutter before left is cut";
  return made;
}

Made rest_rough(const Making& m) {
  return m.number("of_area") < 1.0 ? narrow_rest(m) : rest(m, rough_with(m, true));
}
Made rest_finish(const Making& m) { return rest(m, finish(m)); }

// The floor alone, at once; the walls keep what they have.
Made floor_finish(const Making& m) {
  if (m.shape.through) return no("what is through has no floor");
  Made made = finish(m);
  if (!made) return made;
  made->one_level = true;
  return made;
}

// Thin walls: in shallow levels from above, so that each cut is supported by a wall that is still thick.
Made thin_wall_finish(const Making& m) {
  Made made = finish(m);
  if (!made) return made;
  const double wall = m.context.wall_thickness_mm.value_or(0.0);
  made->allowance_bottom_mm = 0.0;
  made->axial_depth_mm = wall > 0.0 ? m.number("of_thickness") * wall : m.number("axial_mm");
  made->why.text += (made->why.text.empty() ? "" : "; ") + std::string("levels of ") +
                    mm_text(made->axial_depth_mm) +
                    (wall > 0.0 ? " for a wall of " + mm_text(wall) : ", the wall's thickness is not known");
  return made;
}

Made plane(const Making& m, double allowance, StrategyKind strategy) {
  ProposedStep s = begin(m);
  s.tool.centre_cutting = false;
  s.allowance_bottom_mm = allowance;
  s.tool.classes = {CutterClass::kFacemill, CutterClass::kEndmill, CutterClass::kBullnoseEndmill};
  s.strategy = strategy;
  if (!m.shape.islands.empty()) {
    const Limit limit = widest_cutter(m, 1.0, 0.0);
    if (!(limit.diameter_mm > 0.0)) return no("no cutter passes between what stays on the face");
    s.tool.diameter_max_mm = limit.diameter_mm;
    s.tool.classes = {CutterClass::kEndmill};
    s.tool.corner_radius_limited = true;
    s.why.text = limit.text;
    const auto fillet = model::floor_fillet_mm(m.shape);
    if (!fillet) return no(kFilletsDiffer);
    if (const double r = *fillet; r > 0.0) {
      if (2.0 * r > limit.diameter_mm + 1e-9) return no(too_round(r, limit));
      make_fillet(s.tool, r);  // also before it is finished: nothing is left beside what stands
    }
  }
  return s;
}

Made plane_rough(const Making& m) {
  return plane(m, m.number("allowance_bottom_mm"), StrategyKind::kBidirectional);
}
Made plane_finish(const Making& m) { return plane(m, 0.0, StrategyKind::kBidirectional); }

// A round-bottomed slot: the ball that is as wide as the slot, along its middle.
Made ball_slot(const Making& m) {
  ProposedStep s = begin(m);
  const double r = m.shape.slot_bottom_radius_mm;
  s.allowance_bottom_mm = m.number("allowance_bottom_mm");
  s.tool.classes = {CutterClass::kBallEndmill};
  s.tool.diameter_exact_mm = 2.0 * r;
  s.tool.corner_radius_exact_mm = r;
  s.strategy = StrategyKind::kCenterMilling;
  return s;
}

// A vee, roughed by an end mill where it is wide enough: along the middle, to the depth at which the cutter's
// corners come within the allowance of the flanks.
Made vee_rough(const Making& m) {
  const auto& s0 = m.shape;
  const double half = 0.5 * s0.slot_angle_rad;
  const double allowance = m.number("allowance_side_mm");
  const double slope = std::tan(half);
  // At half the depth half the width remains: a quarter of the section is left for the vee cutter.
  const double depth = 0.5 * s0.depth_mm;
  const double width = 2.0 * ((s0.depth_mm - depth) * slope - allowance / std::cos(half));
  if (width < m.number("smallest_mm"))
    return no("half way down the vee is " + mm_text(std::max(width, 0.0)) + " wide, too narrow to rough");
  ProposedStep s = begin(m);
  s.depth_mm = depth;
  s.allowance_side_mm = allowance;
  s.allowance_bottom_mm = s0.depth_mm - depth;
  s.tool.reach_mm -= s0.depth_mm - depth;
  s.tool.classes = {CutterClass::kEndmill};
  s.tool.diameter_max_mm = width;
  s.strategy = StrategyKind::kCenterMilling;
  return s;
}

Made vee_finish(const Making& m) {
  ProposedStep s = begin(m);
  s.tool.classes = {CutterClass::kChamferMill, CutterClass::kCountersink};
  s.tool.point_angle_rad = m.shape.slot_angle_rad;
  s.tool.diameter_min_mm = m.shape.width.nominal_mm;
  s.tool.depth_of_cut_mm = m.shape.depth_mm;
  s.strategy = StrategyKind::kCenterMilling;
  return s;
}

}  // namespace

std::vector<Action> area_actions() {
  const ActionParameter side{"allowance_side_mm", 0.0, "left on the walls"};
  const ActionParameter bottom{"allowance_bottom_mm", 0.0, "left on the floor"};
  const ActionParameter rough_passage{"of_passage", 0.8, "largest cutter by the narrowest passage"};
  const ActionParameter finish_passage{"of_passage", 0.95, "largest cutter by the narrowest passage"};
  const ActionParameter corners{"corners", 1.0,
                                "0: corners do not limit the cutter, a rest step follows; above 1, of "
                                "a step before another: corners may keep that many times their radius "
                                "until the finish, or the next rest"};
  const ActionParameter of_corner{"of_corner", 0.9, "largest cutter by the diameter of the corners"};
  const ActionParameter of_area{
      "of_area", 1.0, "below 1: the widest cutter that reaches this share of the area, a rest step follows"};
  return {
      {"plane_rough", TypeId::kPlaneRoughMilling, {bottom}, plane_rough},
      {"plane_finish", TypeId::kPlaneFinishMilling, {}, plane_finish},
      {"area_rough",
       TypeId::kBottomAndSideRoughMilling,
       {side, bottom, rough_passage, corners, of_area},
       rough},
      {"area_finish", TypeId::kBottomAndSideFinishMilling, {side, bottom, finish_passage, corners}, finish},
      {"spring_pass", TypeId::kBottomAndSideFinishMilling, {side, bottom, finish_passage, corners}, finish},
      {"wall_rough", TypeId::kSideRoughMilling, {side, bottom, rough_passage, corners, of_area}, rough},
      {"wall_finish", TypeId::kSideFinishMilling, {side, bottom, finish_passage, corners}, finish},
      {"wall_spring_pass", TypeId::kSideFinishMilling, {side, bottom, finish_passage, corners}, finish},
      {"rest_rough",
       TypeId::kBottomAndSideRoughMilling,
       {side, bottom, rough_passage, corners, of_corner, of_area},
       rest_rough},
      {"rest_finish",
       TypeId::kBottomAndSideFinishMilling,
       {side, bottom, finish_passage, corners, of_corner},
       rest_finish},
      {"floor_finish",
       TypeId::kBottomAndSideFinishMilling,
       {side, bottom, finish_passage, corners},
       floor_finish},
      {"thin_wall_finish",
       TypeId::kSideFinishMilling,
       {side,
        bottom,
        finish_passage,
        corners,
        {"of_thickness", 1.0, "depth of a level by the wall's thickness"},
        {"axial_mm", 2.0, "depth of a level where the wall's thickness is not known"}},
       thin_wall_finish},
      {"ball_slot", TypeId::kBottomAndSideFinishMilling, {bottom}, ball_slot},
      {"vee_rough",
       TypeId::kBottomAndSideRoughMilling,
       {side, {"smallest_mm", 2.0, "narrowest place that is worth an end mill"}},
       vee_rough},
      {"vee_finish", TypeId::kBottomAndSideFinishMilling, {}, vee_finish},
  };
}

}  // namespace capstan::rules
