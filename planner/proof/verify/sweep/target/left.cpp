#include <algorithm>
#include <cmath>
#include <numbers>
#include <set>

#include "planner/ground/base/stopping.h"
#include "planner/model/nouns/all.h"
#include "planner/model/plan/order/step_ids.h"
#include "planner/proof/verify/copies/copies.h"
#include "planner/proof/verify/sweep/target/corners.h"
#include "planner/proof/verify/sweep/target/target.h"
#include "planner/proof/verify/verify.h"
#include "planner/proof/verify/volumes/form/in_raw.h"

// What stays of planned features after the last step. Every cell of a feature's area is held against the
// feature's own floor: its nominal height, the depth's tolerance and what the finest step states as allowance
// added. A cell counts where the floor is as high, or there is none, at no point of a ring around it: the
// ring's radius is a cell, the tolerances and the side allowance, so that walls and slopes are judged within
// a cell. What may stay in corners is what the file allows: a stated radius; where none is stated, the
// radius of the narrowest mill of its steps, and at the foot of a wall that of the tool's corner, both within
// bounds (steps, outsides, closed pockets: volumes::unstated_corner_mm); nothing in the square ends of slots,
// at the open side of a pocket, nor where a radius of 0 is stated; and what the plan records as rest material
// in corners (corners.h), reported as CHK-REST. Points of drills count below a conical bottom's depth
// only; rest material of a blunter one there has a finding of its own (CHK-LEFT-POINT). A through hole that
// ends within another feature that the plan makes is done there. Crests of threads and what heights do not
// hold are not looked at, nor what is narrower than two cells: a note says so.

namespace capstan::verify {

using geometry::Region;
using geometry::Vec2;
using model::ShapeKind;
using volumes::Form;

namespace {

constexpr int kRing = 8;
constexpr double kNone = 1e300;
/// What may stay in corners for which the file states no radius, of the outline's narrower side. Default,
/// unsourced: a mill wider than 0.7 of what it cuts leaves no corner to speak of.
constexpr double kUnstatedShare = 0.35;
/// At the foot of an upright wall: the usual largest corner of a milling insert (ISO 1832, 08), mm.
constexpr double kUnstatedFootMm = 0.8;
/// Points are drawn as 120 degrees and made as 118; less than this is no blunter drill. Default, unsourced.
constexpr double kPointMm = 0.1;
constexpr double kSpeckMm2 = 1e-3;  ///< less is rounding of outlines; default, unsourced
constexpr double kBelowMm = 0.05;   ///< a hole's end, to see what it opens into; default, unsourced

/// How much higher, and how much narrower than nominal the feature's tolerances let it be.
double shallower(const Form& s) { return s.depth.given ? std::max(0.0, -s.depth.lower_mm) : 0.0; }
double narrower(const Form& s) {
  double out = 0.0;
  for (const volumes::Limits* t : {&s.width, &s.length, &s.diameter}) {
    if (t->given) out = std::max(out, -0.5 * t->lower_mm);
  }
  return out;
}

/// The feature's own floor, frame coordinates; nothing where it leaves the place alone.
std::optional<double> own_floor(const Form& s, Vec2 q) {
  // Walls that lean, and cones under a hole's full depth, are made within what no height tells.
  if (s.slope_rad > 0.0 && !geometry::contains(s.area, q)) return std::nullopt;
  auto z = volumes::floor_at(s, q);
  if (!z) return std::nullopt;
  const bool hole = s.kind == ShapeKind::kHole || s.kind == ShapeKind::kThread;
  return hole ? std::max(*z, -s.depth_mm()) : *z;
}

double narrow_side(const Region& area) {
  const auto b = geometry::bounds(area);
  return std::min(b.hi.x - b.lo.x, b.hi.y - b.lo.y);
}

/// The radius that the file lets stay in a feature's inside corners; `mill`: that of its narrowest mill.
double corner_allowed(const Form& s, double mill) {
  if (s.corner_radius_mm > 0.0) return s.corner_radius_mm;
  if (s.kind == ShapeKind::kSlot) return 0.0;
  if (s.corner_stated) return 0.0;
  if (s.kind == ShapeKind::kStep || s.kind == ShapeKind::kOutside || s.kind == ShapeKind::kFace ||
      (s.kind == ShapeKind::kPocket && !s.open()))
    return std::min(mill, volumes::unstated_corner_mm(s.depth_mm()));
  return std::min(mill, kUnstatedShare * narrow_side(s.area));
}

/// The same for the foot of its walls; `corner`: that of the mill. Of stated feet, and of edges, the floor
/// tells it.
double foot_allowed(const Form& s, double corner) {
  if (s.foot_radius_mm() > 0.0 || s.bevel() != nullptr) return 0.0;
  return std::min(corner, s.slope_rad > 0.0 ? kUnstatedShare * narrow_side(s.area) : kUnstatedFootMm);
}

/// Whether nothing of an area lies so far from its boundary. Where the middle of its box does, by more than
/// an offset's arcs may be off, no offset is made.
bool is_narrower(const Region& area, double ring) {
  constexpr double kArcMm = 0.01, kSureMm = 5.0 * kArcMm;
  const auto box = geometry::bounds(area);
  const Vec2 middle = 0.5 * (box.lo + box.hi);
  if (geometry::contains(area, middle) && geometry::distance_to_boundary(area, middle) > ring + kSureMm)
    return false;
  return geometry::offset(area, -ring, kArcMm).empty();
}

/// What of a feature no height tells, or no cell.
std::string not_judged(const Form& s, const Asked& a, double ring) {
  const bool narrow = s.bevel() != nullptr ? s.bevel()->width_mm < 2.0 * ring : is_narrower(s.area, ring);
  if (narrow)
    return "all of it, which is narrower than two cells (" + mm(2.0 * ring) + " with its tolerances)";
  const auto* bore = s.kind == ShapeKind::kHole ? s.bore() : nullptr;
  const bool cone = bore != nullptr && bore->top_radius_mm - bore->bottom_radius_mm > 5e-7;
  std::string out;
  const auto say = [&](bool so, const char* what) {
    if (so) out += (out.empty() ? "" : "; ") + std::string(what);
  };
  say(s.kind == ShapeKind::kThread, "the flanks of its thread");
  say(cone, "the cone of its wall");
  say(a.undercut, "what lies under an overhang");
  say(s.slope_rad > 0.0 && !cone, "its leaning walls");
  return out;
}

}  // namespace

namespace {

/// Adds what the first `steps` results of a plan make.
void add_asked(const model::Plan& plan, std::size_t steps, const std::set<model::AnyRef>& given_up,
               bool done_before, std::vector<Asked>& out) {
  const std::vector<std::string> ids = model::step_ids(plan);
  for (std::size_t i = 0; i < std::min(steps, plan.steps.size()); ++i) {
    const model::StepResult& step = plan.steps[i];
    const auto* ws = plan.model.get<model::MachiningWorkingstep>(step.step);
    const model::Cutter* cutter = model::find_cutter(plan, step.cutter_id);
    if (ws == nullptr || cutter == nullptr || !step.path || step.path->size() < 2) continue;
    if (cutter->cutter_class == model::CutterClass::kTouchProbe) continue;
    std::vector<model::AnyRef> features = {ws->its_feature};
    features.insert(features.end(), ws->final_features.items.begin(), ws->final_features.items.end());
    for (const model::AnyRef f : features) {
      if (!f.set() || given_up.contains(f)) continue;
      auto it = std::find_if(out.begin(), out.end(), [&](const Asked& a) { return a.feature == f; });
      if (it == out.end()) it = out.insert(out.end(), Asked{.feature = f});
      it->where = {i + 1, ids[i], -1};
      it->setup = step.setup;
      it->done_before = done_before;
      double side = kNone, bottom = kNone;
      if (const auto* o = plan.model.get<model::PlaneMilling>(ws->its_operation)) {
        bottom = o->allowance_bottom.value_or(0.0);
      } else if (const auto* s = plan.model.get<model::SideMilling>(ws->its_operation)) {
        side = s->allowance_side.value_or(0.0);
      } else if (const auto* b = plan.model.get<model::BottomAndSideMilling>(ws->its_operation)) {
        side = b->allowance_side.value_or(0.0);
        bottom = b->allowance_bottom.value_or(0.0);
      }
      it->side_mm = std::min(it->side_mm, side);
      it->bottom_mm = std::min(it->bottom_mm, bottom);
      it->undercut = it->undercut || undercuts(cutter->cutter_class);
      if (const auto* o = plan.model.get<model::FreeformOperation>(ws->its_operation)) {
        double stated = 0.0;
        const auto* strategy = plan.model.get<model::FreeformStrategy>(o->its_machining_strategy);
        if (strategy != nullptr) {
          if (const auto* t = plan.model.get<model::Tolerances>(strategy->its_milling_tolerances))
            stated = t->scallop_height.value_or(0.0) + t->chordal_tolerance.value_or(0.0);
        }
        it->ridges_mm = std::min(it->ridges_mm, stated);
      }
      if (plan.model.holds<model::FreeformFinishMilling>(ws->its_operation) &&
          model::has(cutter->cutter_class, model::CutterTrait::kBall))
        it->ball_mm = end_radius_of(*cutter);
      if (!mills(cutter->cutter_class)) continue;
      it->radius_mm = std::min(it->radius_mm, 0.5 * cutter->cutting_diameter_mm);
      it->widest_mm = std::max(it->widest_mm, 0.5 * cutter->cutting_diameter_mm);
      it->corner_mm = std::min(it->corner_mm, end_radius_of(*cutter));
    }
  }
}

}  // namespace

std::vector<Asked> asked_of(const model::Plan& plan, const CutBefore* before) {
  std::set<model::AnyRef> given_up;
  for (const auto& u : plan.unplanned) given_up.insert(u.feature);
  std::vector<Asked> out;
  if (before != nullptr) add_asked(before->plan, before->steps, given_up, true, out);
  add_asked(plan, plan.steps.size(), given_up, false, out);
  for (Asked& a : out) {
    if (a.side_mm >= kNone) a.side_mm = 0.0;
    if (a.bottom_mm >= kNone) a.bottom_mm = 0.0;
    if (a.ridges_mm >= kNone) a.ridges_mm = 0.0;
    if (a.radius_mm >= kNone) a.radius_mm = a.corner_mm = 0.0;
  }
  return out;
}

void Target::left(const Grid& grid, const std::vector<Asked>& here, const std::vector<Asked>& asked,
                  bool carried, Findings& out) const {
  for (const Asked& a : here) {
    if (plan_.target_mesh) left_on_mesh(grid, a, out);
    for (const Cavity& c : cavities_) {
      if (c.shape->feature == a.feature && !c.bevel) left_of(c, grid, a, asked, carried, out);
    }
  }
}

bool Target::opens_below(const Form& s, const std::vector<Asked>& asked, Vec2 p, double z) const {
  const geometry::Vec3 at = frame_.to_local({p.x, p.y, z - kBelowMm});
  return std::any_of(part_.entries.begin(), part_.entries.end(), [&](const PartShapes::Entry& e) {
    const auto same = [&](const Asked& a) { return a.feature == e.feature; };
    return !e.piece && e.feature != s.feature && std::any_of(asked.begin(), asked.end(), same) &&
           std::any_of(e.shapes.begin(), e.shapes.end(),
                       [&](const auto& o) { return volumes::takes(o, at); });
  });
}

void Target::left_of(const Cavity& c, const Grid& grid, const Asked& a, const std::vector<Asked>& asked,
                     bool carried, Findings& out) const {
  const Form& s = *c.shape;
  const double above = c.frame.origin.z;
  const double limit = allowed() + shallower(s) + a.bottom_mm;
  const double ring = (carried ? 1.5 : 1.0) * grid.cell() + allowed() + narrower(s) + a.side_mm;
  const double fillet = foot_allowed(s, a.corner_mm);
  // What stays is a matter of the part's form, not of safety: a note, and nothing unproved.
  if (const std::string what = not_judged(s, a, ring); !what.empty())
    out.note(36, "CHK-NOT-JUDGED", a.where,
             "of " + s.name + ", " + what + ": what stays there is not looked at");
  left_in_point(c, grid, a, limit, out);
  const bool below = c.frame.z.z < 0.0;
  const auto floor = [&](Vec2 p) -> std::optional<double> {
    const geometry::Vec3 local = c.frame.to_local({p.x, p.y, 0.0});
    const auto z = own_floor(s, {local.x, local.y});
    if (!z) return std::nullopt;
    if (*z <= -s.depth_mm() + 1e-9 && c.open_bottom) return Grid::kNothing;
    return below ? Grid::kNothing : above + *z;
  };
  /// The highest floor on the ring; nothing where the feature ends within it.
  const auto around = [&](Vec2 p, double r) -> std::optional<double> {
    double z = Grid::kNothing;
    for (int i = 0; i < kRing; ++i) {
      const double t = 2.0 * std::numbers::pi * i / kRing;
      const auto f = floor(p + Vec2{r * std::cos(t), r * std::sin(t)});
      if (!f) return std::nullopt;
      z = std::max(z, *f);
    }
    return z;
  };
  Region own_area = s.area;
  for (const auto& island : s.islands) own_area = geometry::subtract(own_area, island.area);
  const Region open = s.kind == ShapeKind::kPocket ? s.before_mouth : Region{};
  const bool milled = s.kind != ShapeKind::kHole && s.kind != ShapeKind::kThread;
  const auto recorded = milled ? recorded_rest(plan_, part_, s, a) : std::nullopt;
  const Region rest =
      recorded ? in_corners(own_area, open, recorded->radius_mm + a.side_mm, ring, true) : Region{};
  std::optional<Region> corners;
  double worst = 0.0, volume = 0.0, top = 0.0, kept = 0.0;
  Vec2 where;
  const auto [y0, y1] = grid.rows(c.box.lo.y, c.box.hi.y);
  const auto [x0, x1] = grid.columns(c.box.lo.x, c.box.hi.x);
  for (int iy = y0; iy < y1; ++iy) {
    poll();
    for (int ix = x0; ix < x1; ++ix) {
      const std::size_t i = grid.index(ix, iy);
      const double stands = grid.stock[i];
      if (stands <= Grid::kNothing / 2 || (!c.open_bottom && stands <= above - s.depth_mm() + limit))
        continue;
      // Over what a head has cut from below stands what it passed under.
      if (a.undercut && stands > above + limit) continue;
      const Vec2 p = grid.centre(ix, iy);
      const auto own = floor(p);
      if (!own || stands - std::max(*own, grid.base[i]) <= limit) continue;
      if (s.solid.through && stands <= above - s.depth_mm() + limit &&
          opens_below(s, asked, p, above - s.depth_mm()))
        continue;
      const auto wide = around(p, ring);
      if (!wide) continue;
      const double left = stands - std::max({*own, *wide, grid.base[i]});
      if (left <= limit) continue;
      if (fillet > 0.0 && left <= fillet + limit && !around(p, ring + fillet)) continue;
      if (!corners) {
        const double r = corner_allowed(s, a.radius_mm);
        corners = milled && r > 0.0 ? in_corners(own_area, open, r + a.side_mm, ring, false) : Region{};
      }
      const geometry::Vec3 local = c.frame.to_local({p.x, p.y, 0.0});
      if (!corners->empty() && geometry::contains(*corners, {local.x, local.y})) continue;
      if (!rest.empty() && geometry::contains(rest, {local.x, local.y})) {
        kept += left * grid.cell() * grid.cell();
        continue;
      }
      volume += left * grid.cell() * grid.cell();
      if (left <= worst) continue;
      worst = left;
      where = p;
      top = stands;
    }
  }
  if (recorded) {
    const Region stays = in_corners(own_area, open, recorded->radius_mm, 0.0, true);
    std::string at;
    for (const Region& piece : geometry::pieces(stays)) {
      const geometry::Box2 box = geometry::bounds(piece);
      const geometry::Vec3 middle =
          c.frame.to_parent({0.5 * (box.lo.x + box.hi.x), 0.5 * (box.lo.y + box.hi.y), 0.0});
      if (geometry::area(piece) >= kSpeckMm2) at += (at.empty() ? "" : ", ") + place(xy(middle), middle.z);
    }
    out.warn(36, "CHK-REST", a.where,
             "in the corners of " + s.name + (at.empty() ? "" : " at " + at) + " a radius of " +
                 mm(recorded->radius_mm) + " stays in place of " + mm(recorded->stated_mm) +
                 ", as the plan records it: " + plain(geometry::area(stays) * s.depth_mm()) +
                 " mm3 by the feature's form, " + plain(kept) + " mm3 of it in cells of " + mm(grid.cell()),
             recorded->radius_mm);
  }
  if (worst <= 0.0) return;
  out.error(36, "CHK-LEFT", a.where,
            "after the last step " + mm(worst) + " of " + s.name + " still stand at " + place(where, top) +
                ", " + plain(volume) + " mm3 in all; allowed " + mm(limit) + " (cells of " + mm(grid.cell()) +
                ")",
            worst);
}

void Target::left_in_point(const Cavity& c, const Grid& grid, const Asked& a, double limit,
                           Findings& out) const {
  const Form& s = *c.shape;
  const auto* bore = s.kind == ShapeKind::kHole ? s.bore() : nullptr;
  if (bore == nullptr || bore->bottom != volumes::Bore::Bottom::kCone || !(s.tip_mm > 0.0) ||
      c.frame.z.z < 0.0 || c.open_bottom)
    return;
  const double bottom = c.frame.origin.z - s.depth_mm();
  double worst = 0.0, volume = 0.0;
  const auto [y0, y1] = grid.rows(c.box.lo.y, c.box.hi.y);
  const auto [x0, x1] = grid.columns(c.box.lo.x, c.box.hi.x);
  for (int iy = y0; iy < y1; ++iy) {
    for (int ix = x0; ix < x1; ++ix) {
      const std::size_t i = grid.index(ix, iy);
      // Material above the full diameter's depth has a finding of its own.
      if (grid.stock[i] <= Grid::kNothing / 2 || grid.stock[i] > bottom + limit) continue;
      const Vec2 p = grid.centre(ix, iy);
      const geometry::Vec3 local = c.frame.to_local({p.x, p.y, 0.0});
      const auto own = volumes::floor_at(s, {local.x, local.y});
      if (!own) continue;
      const double stays = grid.stock[i] - std::max(c.frame.origin.z + *own, grid.base[i]);
      if (stays <= 0.0) continue;
      volume += stays * grid.cell() * grid.cell();
      worst = std::max(worst, stays);
    }
  }
  if (worst <= std::max(limit, kPointMm)) return;
  const std::string text = "in the point of the bottom of " + s.name + " stays rest material, " + mm(worst) +
                           " high, " + plain(volume) + " mm3 in all: its drill is blunter than the bottom";
  if (bore->blunt_mm > 0.0)
    out.warn(36, "CHK-LEFT-POINT", a.where, text + ", whose tip has a stated radius", worst);
  else
    out.note(36, "CHK-LEFT-POINT", a.where, text + ", whose angle has no tolerance");
}

}  // namespace capstan::verify
