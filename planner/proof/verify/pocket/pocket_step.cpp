#include <algorithm>
#include <cmath>
#include <numbers>

#include "planner/ground/base/number.h"
#include "planner/model/nouns/all.h"
#include "planner/proof/verify/following/following.h"
#include "planner/proof/verify/pocket/slot_bound.h"
#include "planner/proof/verify/sweep/target/target.h"
#include "planner/proof/verify/volumes/reading.h"

// A step that the text makes by a pocket cycle of the control, whose path is not the plan's. Its parameters
// are held against the pocket by the own reading and against what the plan's own path reaches, how deep it
// goes at a time, how steep and how fast. The moves that the reader makes of it are swept as any others.

namespace capstan::verify {

using geometry::Placement;
using geometry::Vec2;
using geometry::Vec3;
using model::MoveKind;
using model::MoveRole;
using volumes::Edge;
using volumes::Outline;

namespace {

/// Rings with square corners, at most so far apart over the width that the end is flat, leave no post on the
/// diagonal: the outer ring covers half a width square to its legs, the inner one as far beyond its corner;
/// derived: (1 + sqrt(2)) / (2 sqrt(2)).
constexpr double kRingsAtCorners = 0.8535;

constexpr double kPi = std::numbers::pi;
/// Text and pocket, text and path may be apart by this, mm, beside what rounding leaves.
constexpr double kApartMm = 0.002;
/// Nearer to the material than this no rapid of the plan's comes down, mm: what the levels count from lies no
/// farther below where the tool is fed from. A copy of planner/making/toolpath/defaults.h's.
constexpr double kFedFromMm = 0.2;
/// A slot that is deeper over the cutter's diameter wants a lower speed than the step has. A copy of
/// planner/making/optimise/cut/limits.h's.
constexpr double kDeepestOfDiameter = 0.5;
/// Of an arc's chords from it, mm.
constexpr double kChord = 0.0005;
constexpr const char* kCode = "CHK-POCKET-CYCLE";

/// The pocket's contour by the cycle's parameters, in the frame that `local` gives.
template <typename Local>
Outline contour_of(const Pocket& p, const Local& local) {
  Outline out;
  const Vec2 centre = local(p.centre);
  if (p.round) {
    out.add(volumes::round(centre, 0.5 * p.length_mm, 0.0, 2.0 * kPi));
    return out;
  }
  const Vec2 u{std::cos(p.angle_rad), std::sin(p.angle_rad)};
  const Vec2 x = local(p.centre + u) - centre, y{-x.y, x.x};
  const double a = 0.5 * p.length_mm, b = 0.5 * p.width_mm, r = p.corner_mm, turned = std::atan2(x.y, x.x);
  const Vec2 corners[4] = {{a, -b}, {a, b}, {-a, b}, {-a, -b}};
  for (int k = 0; k < 4; ++k) {
    const auto middle = [&](Vec2 q) {
      const Vec2 in{q.x - std::copysign(r, q.x), q.y - std::copysign(r, q.y)};
      return centre + in.x * x + in.y * y;
    };
    const double from = turned + 0.5 * kPi * (k - 1);
    const Vec2 here = middle(corners[k]), next = middle(corners[(k + 1) % 4]);
    if (r > 0.0) out.add(volumes::round(here, r, from, 0.5 * kPi));
    const double end = from + 0.5 * kPi;
    const Vec2 off = r * Vec2{std::cos(end), std::sin(end)};
    out.add(volumes::straight(here + off, next + off));
  }
  return out;
}

/// Where the feature's walls stand, in its frame: a plain pocket's, or a square slot's along a line with
/// round ends; empty: it is neither.
Outline walls_of(const volumes::Solid& solid) {
  if (const auto* area = std::get_if<volumes::Area>(&solid.form)) {
    const bool plain =
        !area->around && area->standing.empty() && !(area->foot_radius_mm > 0.0) && !(area->leaning_mm > 0.0);
    return plain ? area->outline : Outline{};
  }
  const auto* g = std::get_if<volumes::Groove>(&solid.form);
  if (g == nullptr || g->loop || g->course.edges.size() != 1 || g->course.edges[0].arc() ||
      g->ends[0] != volumes::Groove::End::kHalfRound || g->ends[1] != volumes::Groove::End::kHalfRound)
    return {};
  const double box = 2.0 * g->half_mm * (g->section.hi.y - g->section.lo.y);
  const bool square = std::abs(0.5 * std::abs(volumes::twice_area(g->section)) - box) < 1e-6;
  if (!square || g->foot_radius_mm > 0.0 || g->unsaid_height_mm > 0.0) return {};
  const Edge& e = g->course.edges[0];
  const Vec2 way = e.along(0.5), left{-way.y, way.x};
  const double from = std::atan2(left.y, left.x), r = g->half_mm;
  Outline out;
  out.add(volumes::straight(e.from - r * left, e.to - r * left));
  out.add(volumes::round(e.to, r, from - kPi, kPi));
  out.add(volumes::straight(e.to + r * left, e.from + r * left));
  out.add(volumes::round(e.from, r, from, kPi));
  return out;
}

/// How far the places of one outline lie from another.
double apart(const Outline& of, const Outline& from) {
  constexpr int kPlaces = 16;
  double out = 0.0;
  for (const Edge& e : of.edges) {
    for (int i = 0; i <= kPlaces; ++i)
      out = std::max(out, volumes::nearest(from, e.at(static_cast<double>(i) / kPlaces)).distance_mm);
  }
  return out;
}

bool known_to_all(const Block& b) { return b.known_to[0] && b.known_to[1] && b.known_to[2]; }

/// What the plan's own path does.
struct Own {
  double along_mm = 0.0, across_mm = 0.0, about_mm = 0.0;  ///< how far its centre comes from the middle
  double lowest_z = 1e300, fed_from_z = 1e300;
  double slope = 1e300;  ///< of the flattest ramp
  double ramp_feed_mm_min = 1e300;
  double turned = 0.0;  ///< twice the area that it goes round; above 0 counter-clockwise
};

}  // namespace

/// Whether a pocket cycle comes next, at once or behind a rapid over its middle, as high as the path begins.
bool Following::begins_pocket() {
  std::size_t i = at_;
  while (i < text_.size() && still(*text_[i])) ++i;
  const auto pocket = [&](std::size_t k) { return k < text_.size() && text_[k]->pocket >= 0; };
  if (pocket(i)) {
    at_ = i;
    return true;
  }
  if (!pocket(i + 1) || !known_to_all(*text_[i])) return false;
  const Block& b = *text_[i];
  const Pocket& p = c_.program.pockets[static_cast<std::size_t>(text_[i + 1]->pocket)];
  if (b.kind != Block::Kind::kMove || b.move != MoveKind::kRapid || b.in_machine || !same(b.from, last_) ||
      !same(b.to, {p.centre.x, p.centre.y, last_.z}))
    return false;
  at_ = i + 1;
  return numbers_agree(1, b);
}

/// The step as one pocket cycle. False where something was said.
bool Following::pocket_cycle() {
  const int number = text_[at_]->pocket;
  const Pocket& p = c_.program.pockets[static_cast<std::size_t>(number)];
  const auto wrong = [&](const std::string& what) {
    return say(p.line, "the pocket cycle " + what, -1, 33, kCode);
  };
  const auto off = [&](double a, double b) { return std::abs(a - b) > kApartMm + unit_; };
  const model::Model& m = c_.plan->model;
  const auto* ws = m.get<model::MachiningWorkingstep>(step_.step);
  if (ws == nullptr || cutter_ == nullptr) return wrong("stands where the plan has no workingstep");

  // The state in each of its moves, and that nothing else stands between them.
  for (; at_ < text_.size() && text_[at_]->pocket >= 0; ++at_) {
    const Block& b = *text_[at_];
    if (b.pocket != number)
      return say(b.line, "a second pocket cycle follows that the plan does not have", -1);
    Block as_planned = b;
    as_planned.feed_mm_min = feed_of(1);
    if (!numbers_agree(1, as_planned)) return false;
  }

  const volumes::Reading own = volumes::read(volumes::source_of(m, c_.plan->stock.box), ws->its_feature);
  const Outline walls = own.solids.size() == 1 ? walls_of(own.solids[0]) : Outline{};
  if (walls.empty())
    return wrong("is for a feature that is no plain pocket or slot by the check's own reading");
  const Placement at = compose(workpiece_in(*c_.plan, step_.setup), own.solids[0].frame);
  const auto local = [&](Vec2 q) { return xy(at.to_local({q.x, q.y, at.origin.z})); };
  const Outline text = contour_of(p, local);
  const double contour = std::max(apart(text, walls), apart(walls, text));
  if (contour > kApartMm) return wrong("has a contour that is up to " + mm(contour) + " from the pocket's");
  if (off(p.floor_z, at.origin.z - own.solids[0].depth_mm))
    return wrong("has its floor at z = " + plain(p.floor_z) + "; the pocket's is at " +
                 plain(at.origin.z - own.solids[0].depth_mm));

  Own path;
  const Vec2 u{std::cos(p.angle_rad), std::sin(p.angle_rad)};
  for (std::size_t i = 1; i < path_.size(); ++i) {
    if (path_.kind[i] == MoveKind::kRapid || path_.kind[i] == MoveKind::kDwell) continue;
    const Move whole = planned(i);
    if (path_.role[i] != MoveRole::kApproach && path.fed_from_z > 1e299) path.fed_from_z = whole.from.z;
    if (path_.role[i] == MoveRole::kRamp || path_.role[i] == MoveRole::kPlunge) {
      const double run =
          is_arc(whole.kind) ? radius_of(i) * sweep_of(whole) : norm(xy(whole.to) - xy(whole.from));
      const double down = whole.from.z - whole.to.z;
      if (path_.role[i] == MoveRole::kRamp && run > kApartMm && down > 0.0)
        path.slope = std::min(path.slope, down / run);
      path.ramp_feed_mm_min = std::min(path.ramp_feed_mm_min, feed_of(i));
    }
    const int pieces = pieces_of(whole, kChord);
    for (int k = 0; k <= pieces; ++k) {
      const Vec3 q3 = point_of(whole, static_cast<double>(k) / pieces);
      const Vec2 q = xy(q3) - p.centre;
      path.along_mm = std::max(path.along_mm, std::abs(dot(q, u)));
      path.across_mm = std::max(path.across_mm, std::abs(u.x * q.y - u.y * q.x));
      path.about_mm = std::max(path.about_mm, norm(q));
      path.lowest_z = std::min(path.lowest_z, q3.z);
      if (k == 0) continue;
      const Vec2 before = xy(point_of(whole, static_cast<double>(k - 1) / pieces)) - p.centre;
      path.turned += before.x * q.y - before.y * q.x;
    }
  }
  const double inset = 0.5 * p.cutter_mm + p.side_mm;
  const bool reach = p.round ? off(path.about_mm, 0.5 * p.length_mm - inset)
                             : off(path.along_mm, 0.5 * p.length_mm - inset) ||
                                   off(path.across_mm, 0.5 * p.width_mm - inset);
  if (reach)
    return wrong("leaves " + mm(p.side_mm) + " on the walls; the plan's path comes " +
                 (p.round ? mm(path.about_mm) : mm(path.along_mm) + " and " + mm(path.across_mm)) +
                 " from the middle");
  if (off(path.lowest_z, p.floor_z + p.bottom_mm))
    return wrong("leaves " + mm(p.bottom_mm) +
                 " on the floor; the plan's path goes down to z = " + plain(path.lowest_z));
  if (off(p.back_z, path_.z[0]))
    return wrong("comes back to z = " + plain(p.back_z) + "; the plan's path begins and ends at " +
                 plain(path_.z[0]));
  if (off(p.start_z, path.fed_from_z))
    return wrong("is fed from z = " + plain(p.start_z) + "; the plan's path from " + plain(path.fed_from_z));
  if (p.start_z - p.reference_z > kFedFromMm + unit_)
    return wrong("counts its levels from z = " + plain(p.reference_z) + ", " + mm(p.start_z - p.reference_z) +
                 " below where it is fed from, which may lie in the material; at most " + mm(kFedFromMm));
  if ((path.turned < 0.0) != p.clockwise)
    return wrong(std::string("goes round ") + (p.clockwise ? "clockwise" : "counter-clockwise") +
                 "; the plan's path the other way");
  const double flat = p.cutter_mm - 2.0 * model::end_radius_mm(*cutter_);
  const double most = kRingsAtCorners * flat;
  // Whatever passes the control makes, those along both walls are among them.
  const double between = p.width_mm - 2.0 * inset;
  if (p.own_rings && between > flat + unit_)
    return wrong("does not state how far its passes are apart; those along both walls are " + mm(between) +
                 ", and the cutter is flat over " + mm(flat) + ": what lies between may stay");
  if (!p.own_rings && (!(p.over_mm > 0.0) || p.over_mm > most + unit_))
    return wrong("has rings " + mm(p.over_mm) + " apart; the cutter of diameter " + mm(p.cutter_mm) +
                 " is flat over " + mm(flat) + ", and rings farther apart than " + mm(most) +
                 " leave material on the floor, posts between their corners first");
  if (p.level_mm > step_.axial_depth_mm + unit_)
    return wrong("goes down by " + mm(p.level_mm) + " at a time; the plan by " + mm(step_.axial_depth_mm));
  if (p.level_mm > kDeepestOfDiameter * p.cutter_mm + unit_)
    return wrong("goes down by " + mm(p.level_mm) +
                 " at a time, anywhere in a slot; at the step's speed at most " +
                 mm(kDeepestOfDiameter * p.cutter_mm));
  const double slope = p.slope > 0.0      ? p.slope
                       : p.helix_mm > 0.0 ? p.turn_mm / (2.0 * kPi * p.helix_mm)
                                          : 1e300;
  // Radius and drop are rounded, each by half a unit.
  const double rounding =
      p.helix_mm > 0.0 ? unit_ / (2.0 * kPi * p.helix_mm) + slope * unit_ / p.helix_mm : 0.0;
  if (path.slope > 1e299)
    return wrong("goes in along a ramp of its own; the plan's path goes in along no ramp");
  if (slope > path.slope + rounding)
    return wrong("goes in at a slope of " + plain(slope) + "; the flattest ramp of the plan's path at " +
                 plain(path.slope));
  if (p.helix_mm > 0.5 * p.cutter_mm + unit_)
    return wrong("goes in along a helix of radius " + mm(p.helix_mm) + ": the cutter of diameter " +
                 mm(p.cutter_mm) + " leaves a core in it");
  if (p.ramp_feed_mm_min > path.ramp_feed_mm_min + feed_slack())
    return say(p.line,
               "the pocket cycle goes in at " + plain(p.ramp_feed_mm_min) + " mm/min; the plan's path at " +
                   plain(path.ramp_feed_mm_min),
               -1, 18, "CHK-CYCLE-FEED");
  if (!(step_.loads.peak_force_n > 0.0))
    return wrong(
        "may be in a slot as wide as the cutter, and the plan states no largest force for the step "
        "(peak_force_n), which its feed must keep there: plan the step again, or write it as moves");
  const SlotBound bound = slot_bound(*c_.plan, step_, *cutter_, p.level_mm, std::abs(speed_of(1)));
  if (p.feed_mm_min > bound.feed_mm_min + feed_slack())
    return say(p.line,
               "the pocket cycle feeds at " + plain(p.feed_mm_min) + " mm/min; in a slot " + mm(p.level_mm) +
                   " deep at most " + plain(bound.feed_mm_min) + " keep " + bound.by +
                   ": feed slower, or go down by less at a time",
               -1, 18, "CHK-CYCLE-FEED");
  return true;
}

}  // namespace capstan::verify
