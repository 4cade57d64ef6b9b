#include <algorithm>
#include <cmath>

#include "planner/ground/base/number.h"
#include "planner/model/nouns/all.h"
#include "planner/proof/verify/following/following.h"
#include "planner/proof/verify/pocket/slot_bound.h"
#include "planner/proof/verify/sweep/target/target.h"
#include "planner/proof/verify/sweep/tool_body.h"
#include "planner/proof/verify/volumes/reading.h"

// A step that the text makes by a face cycle of the control, whose path is not the plan's. Its parameters are
// held against the face by the own reading, the raw piece, what holds it, and the plan's own path. The moves
// that the reader makes of it are swept as any others.

namespace capstan::verify {

using geometry::Box3;
using geometry::Placement;
using geometry::Vec2;
using geometry::Vec3;
using model::MoveKind;

namespace {

/// Text and face, text and path may be apart by this, mm, beside what rounding leaves.
constexpr double kApartMm = 0.002;
/// Between the cutter and the edge beside which it comes down, mm. A copy of
/// planner/making/toolpath/defaults.h's.
constexpr double kBesideMm = 1.0;
/// A slot that is deeper over the cutter's diameter wants a lower speed than the step has. A copy of
/// planner/making/optimise/cut/limits.h's.
constexpr double kDeepestOfDiameter = 0.5;
constexpr const char* kCode = "CHK-FACE-CYCLE";

}  // namespace

/// Whether a face cycle comes next.
bool Following::begins_face() {
  std::size_t i = at_;
  while (i < text_.size() && text_[i]->face < 0 && still(*text_[i])) ++i;
  if (i >= text_.size() || text_[i]->face < 0) return false;
  at_ = i;
  return true;
}

/// The step as one face cycle. False where something was said.
bool Following::face_cycle() {
  const int number = text_[at_]->face;
  const FacedArea& f = c_.program.faces[static_cast<std::size_t>(number)];
  const auto wrong = [&](const std::string& what) {
    return say(f.line, "the face cycle " + what, -1, 33, kCode);
  };
  const auto off = [&](double a, double b) { return std::abs(a - b) > kApartMm + unit_; };
  const model::Model& m = c_.plan->model;
  const auto* ws = m.get<model::MachiningWorkingstep>(step_.step);
  if (ws == nullptr || cutter_ == nullptr) return wrong("stands where the plan has no workingstep");

  // The state in each of its moves, and that nothing else stands between them.
  for (; at_ < text_.size() && text_[at_]->face >= 0; ++at_) {
    const Block& b = *text_[at_];
    if (b.face != number) return say(b.line, "a second face cycle follows that the plan does not have", -1);
    Block as_planned = b;
    as_planned.feed_mm_min = feed_of(1);
    if (!numbers_agree(1, as_planned)) return false;
  }

  // The face, by the own reading.
  const volumes::Reading own = volumes::read(volumes::source_of(m, c_.plan->stock.box), ws->its_feature);
  const auto* area = own.solids.size() == 1 ? std::get_if<volumes::Area>(&own.solids[0].form) : nullptr;
  if (area == nullptr || !area->overhead || area->around || !area->standing.empty())
    return wrong("is for a feature that is no face without anything on it by the check's own reading");
  const Placement piece = workpiece_in(*c_.plan, step_.setup);
  const Placement at = compose(piece, own.solids[0].frame);
  Box3 face;
  for (const volumes::Edge& e : area->outline.edges) {
    if (e.arc()) return wrong("is for a face that is round");
    face.add(at.to_parent({e.from.x, e.from.y, 0.0}));
  }
  const double floor = at.origin.z - own.solids[0].depth_mm;
  const Box3 raw = placed(c_.plan->stock.box, piece);
  if (face.empty() || raw.empty()) return wrong("is for a face or a raw piece without extent");
  const double flat = f.cutter_mm - 2.0 * model::end_radius_mm(*cutter_);
  if (!(flat > 0.0))
    return wrong("is made with a cutter that is round at its end: ridges stay between strokes");
  const double slack = kApartMm + unit_, ridge = 0.5 * (f.cutter_mm - flat);
  const auto covers = [&](double lo, double hi, double of_lo, double of_hi, double more) {
    return lo <= of_lo - more + slack && hi >= of_hi + more - slack;
  };
  const double x = f.along_y ? ridge : 0.0, y = f.along_y ? 0.0 : ridge;
  if (!covers(f.lo.x, f.hi.x, face.lo.x, face.hi.x, x) || !covers(f.lo.y, f.hi.y, face.lo.y, face.hi.y, y))
    return wrong("mills from (" + plain(f.lo.x) + ", " + plain(f.lo.y) + ") to (" + plain(f.hi.x) + ", " +
                 plain(f.hi.y) + "); that does not cover the face from (" + plain(face.lo.x) + ", " +
                 plain(face.lo.y) + ") to (" + plain(face.hi.x) + ", " + plain(face.hi.y) + ") with " +
                 mm(ridge) + " over it across the strokes");
  if (!covers(f.lo.x, f.hi.x, raw.lo.x, raw.hi.x, 0.0) || !covers(f.lo.y, f.hi.y, raw.lo.y, raw.hi.y, 0.0))
    return wrong("comes down and goes over the edge where the raw piece stands, which reaches from (" +
                 plain(raw.lo.x) + ", " + plain(raw.lo.y) + ") to (" + plain(raw.hi.x) + ", " +
                 plain(raw.hi.y) + ")");
  if (off(f.floor_z, floor))
    return wrong("has its floor at z = " + plain(f.floor_z) + "; the face's is at " + plain(floor));

  // The plan's path.
  double lowest = 1e300, fed_from = 1e300;
  for (std::size_t i = 1; i < path_.size(); ++i) {
    const Move whole = planned(i);
    lowest = std::min(lowest, whole.to.z);
    if (fed_from > 1e299 && whole.kind != MoveKind::kRapid && whole.kind != MoveKind::kDwell)
      fed_from = whole.from.z;
    if (speed_of(i) != speed_of(1)) return wrong("has one speed; the plan's path has several");
  }
  if (off(lowest, f.floor_z + f.bottom_mm))
    return wrong("leaves " + mm(f.bottom_mm) + "; the plan's path goes down to z = " + plain(lowest));
  if (off(f.back_z, path_.z[0]))
    return wrong("comes back to z = " + plain(f.back_z) + "; the plan's path begins and ends at " +
                 plain(path_.z[0]));
  if (off(f.start_z, fed_from))
    return wrong("is fed from z = " + plain(f.start_z) + "; the plan's path from " + plain(fed_from));
  if (f.reference_z < raw.hi.z - slack)
    return wrong("counts its levels from z = " + plain(f.reference_z) +
                 ", in the raw piece, whose top is at " + plain(raw.hi.z));
  if (f.level_mm > step_.axial_depth_mm + unit_)
    return wrong("goes down by " + mm(f.level_mm) + " at a time; the plan by " + mm(step_.axial_depth_mm));
  if (f.level_mm > kDeepestOfDiameter * f.cutter_mm + unit_)
    return wrong("goes down by " + mm(f.level_mm) +
                 " at a time, anywhere in a slot; at the step's speed at most " +
                 mm(kDeepestOfDiameter * f.cutter_mm));
  if (f.over_mm > flat + unit_)
    return wrong("has strokes " + mm(f.over_mm) + " apart; the cutter is flat over " + mm(flat) +
                 ", and ridges stay between them");
  if (f.out_mm < kBesideMm - unit_)
    return wrong("comes down " + mm(f.out_mm) + " beside the face; at least " + mm(kBesideMm));

  // What holds the piece, where any part of the tool may come while it is as low as its floor.
  const model::Workholding& holding = c_.plan->setups[step_.setup].holding;
  if (holding.solids.empty())
    return wrong(
        "may go over the edge anywhere, and nobody has said what holds the piece: name the fixture, or "
        "write the face as moves");
  double widest = 0.5 * f.cutter_mm;
  for (const BodyPart& p : body_of(*cutter_)) widest = std::max(widest, p.radius_mm);
  // Nothing states that its clearance does not count beside the edge as it does above the face.
  const double over = std::max({f.out_mm, f.beyond_mm, f.start_z - f.reference_z});
  const double reach = 0.5 * f.cutter_mm + over + widest + holding.clearance_mm;
  for (const model::FixtureSolid& s : holding.solids) {
    Box3 solid;
    for (const Vec2 q : s.outline) solid.add({q.x, q.y, s.top_mm});
    if (solid.empty() || s.top_mm < lowest - holding.clearance_mm - slack) continue;
    if (solid.lo.x < f.hi.x + reach && solid.hi.x > f.lo.x - reach && solid.lo.y < f.hi.y + reach &&
        solid.hi.y > f.lo.y - reach)
      return wrong("may go over the edge where '" + s.id + "' stands, its top at z = " + plain(s.top_mm) +
                   "; nothing within " + mm(reach) + " may be as high as " + plain(lowest));
  }

  if (!(step_.loads.peak_force_n > 0.0))
    return wrong(
        "may be in a slot as wide as the cutter, and the plan states no largest force for the step "
        "(peak_force_n), which its feed must keep there: plan the step again, or write it as moves");
  const SlotBound bound = slot_bound(*c_.plan, step_, *cutter_, f.level_mm, std::abs(speed_of(1)));
  if (f.feed_mm_min > bound.feed_mm_min + feed_slack())
    return say(f.line,
               "the face cycle feeds at " + plain(f.feed_mm_min) + " mm/min; in a slot " + mm(f.level_mm) +
                   " deep at most " + plain(bound.feed_mm_min) + " keep " + bound.by +
                   ": feed slower, or go down by less at a time",
               -1, 18, "CHK-CYCLE-FEED");
  return true;
}

}  // namespace capstan::verify
