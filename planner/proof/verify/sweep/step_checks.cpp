#include "planner/proof/verify/sweep/step_checks.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "planner/ground/base/stopping.h"
#include "planner/model/nouns/all.h"
#include "planner/physics/mechanics/constants.h"
#include "planner/proof/verify/copies/copies.h"
#include "planner/proof/verify/stated_values.h"

namespace capstan::verify {

using geometry::Vec2;
using model::CutterClass;
using model::MoveKind;

namespace {

constexpr double kTouchMm3 = 1e-6;  ///< less than this is not a cut
constexpr double kSlackMm = 0.02;   ///< of lengths measured on heights

/// Whether a shank goes into the hole behind the flutes without touching it. A reamer cuts with its lead:
/// once that is through, what it goes further cuts nothing, and the flutes need not stand out of the hole's
/// mouth.
bool follows_its_lead(const model::Cutter& c) {
  constexpr double kThinnerMm = 0.1;  // on the diameter; default, unsourced
  return c.cutter_class == CutterClass::kReamer && c.shank_diameter_mm > 0.0 &&
         c.shank_diameter_mm + kThinnerMm <= c.cutting_diameter_mm;
}

bool is_mill(const model::Cutter& c) { return !works_along_axis(c) && !mills_threads(c.cutter_class); }
/// How far the head, its tip at p, is in the walls of the feature's upright holes, mm; 0 where there are
/// none. A back countersink's cone ends at its neck, at the head's top.
double into_hole_walls(const std::vector<volumes::Form>& shapes, const geometry::Placement& frame,
                       const model::Cutter& c, double head_mm, const geometry::Vec3& p) {
  constexpr int kSlices = 8;
  const double r = 0.5 * c.cutting_diameter_mm;
  const bool cone = c.cutter_class == CutterClass::kBackCountersink && c.point_angle_rad > 0.0;
  const double lean = cone ? std::tan(0.5 * c.point_angle_rad) : 0.0;
  const double widest_mm = cone ? head_mm - (r - 0.5 * c.neck_diameter_mm) / lean : head_mm;
  double worst = 0.0;
  for (int i = 0; i <= kSlices; ++i) {
    // Just inside the ends: a head that touches a shoulder does not cut it.
    const double t = std::clamp(head_mm * i / kSlices, 1e-3, head_mm - 1e-3);
    const double own = t > widest_mm ? r - (t - widest_mm) * lean : r;
    double low = 1e300, high = -1e300, room = -1e300;
    for (const volumes::Form& s : shapes) {
      if (s.kind != model::ShapeKind::kHole) continue;
      const volumes::Bore& bore = *s.bore();
      const geometry::Placement at = compose(frame, s.frame());
      if (at.z.z < 1.0 - 1e-9) continue;
      const double down = at.origin.z - (p.z + t);
      low = std::min(low, at.origin.z - s.depth_mm());
      high = std::max(high, at.origin.z);
      if (down < -1e-6 || down > s.depth_mm() + 1e-6) continue;
      const double wide = bore.top_radius_mm +
                          (bore.bottom_radius_mm - bore.top_radius_mm) * down / std::max(s.depth_mm(), 1e-9);
      const double more = s.diameter.given ? std::max(0.0, s.diameter.upper_mm) : 0.0;
      room = std::max(room, wide + 0.5 * more - norm(xy(p) - xy(at.origin)));
    }
    // Above the uppermost and below the lowest hole other material is judged by its heights.
    if (low > high || p.z + t > high || p.z + t < low) continue;
    worst = std::max(worst, own - room);
  }
  return worst;
}
/// What a neck must be thicker than to be judged on these cells.
double neck_slack(const Grid& grid) { return 1.5 * grid.cell(); }

bool ring_on_a_neck(const model::Cutter& c) {
  return mills_threads(c.cutter_class) && c.neck_length_mm > c.maximum_depth_of_cut_mm &&
         c.neck_diameter_mm > 0.0;
}

/// A helix that goes up or down by no more in a turn than the teeth are high, and no steeper than 45 degrees
/// (default, unsourced): the flanks of its teeth cut its way. A left-hand thread is milled downwards.
bool winds(const Move& m, double head_mm) {
  if (!is_arc(m.kind)) return false;
  const double turned = sweep_of(m), rise = std::abs(m.to.z - m.from.z);
  if (!(turned > 0.0)) return false;
  return rise * 2.0 * std::numbers::pi <= head_mm * turned && rise <= norm(xy(m.to) - m.centre) * turned;
}

/// Of what heights lose to a ring of teeth, what the ring itself takes from an upright wall: its own height.
void of_a_ring(Bite& bite, double height_mm) {
  if (bite.contact_mm > height_mm) bite.volume_mm3 *= height_mm / bite.contact_mm;
  bite.thickest_mm = std::min(bite.thickest_mm, height_mm);
}

}  // namespace

std::string here(Vec2 p) { return "(" + plain(p.x) + ", " + plain(p.y) + ")"; }

StepChecks::StepChecks(const model::Plan& plan, const StepMoves& step, Grid& grid, Target& target,
                       EarlierCuts& earlier, Findings& findings)
    : plan_(plan),
      step_(step),
      cutter_(*step.cutter),
      grid_(grid),
      target_(target),
      earlier_(earlier),
      out_(findings),
      outline_(std::make_shared<const CutterOutline>(outline_of(*step.cutter))),
      body_(body_of(*step.cutter)),
      radius_(outline_->radius()),
      tip_mm_(outline_->profile().height(0.5 * step.cutter->cutting_diameter_mm)),
      feed_limit_(feed_limit(*step.cutter, plan.material)),
      least_chip_mm_(least_chip_of(*step.cutter, plan.material)),
      mark_(earlier.mark()),
      before_(ring_on_a_neck(*step.cutter) ? std::make_unique<const Grid>(grid) : nullptr) {
  constexpr double kThicker = 0.02;  // mm: what is no thicker follows where the cutter has been
  std::erase_if(body_, [&](const BodyPart& p) {
    return p.what == BodyPart::What::kCutter || p.radius_mm <= radius_ + kThicker;
  });
  const model::Executable* e =
      step.planned != nullptr ? plan.model.get<model::Executable>(step.planned->step) : nullptr;
  const auto* ws = e != nullptr ? plan.model.get<model::MachiningWorkingstep>(step.planned->step) : nullptr;
  const auto* op = ws != nullptr ? plan.model.get<model::Two5dMillingOperation>(ws->its_operation) : nullptr;
  arcs_count_ = op != nullptr && !finishes(model::AnyRef(ws->its_operation).type) && is_mill(cutter_) &&
                cutter_.substrate == model::Substrate::kCarbide && outline_->ball() == nullptr &&
                cutter_.taper_angle_rad == 0.0 && cutter_.lead_angle_rad == 0.0;
  if (before_ != nullptr && 0.5 * cutter_.neck_diameter_mm <= neck_slack(grid))
    out_.unproved(Severity::kNote, 11, "CHK-NECK-UNDECIDED", {step.order + 1, step.id, -1},
                  "the tool's neck of " + mm(cutter_.neck_diameter_mm) +
                      " is too thin to be judged on cells of " + mm(grid.cell()) +
                      ": whether it touches the thread's crests is not looked at");
  ramp_chosen_ = ws != nullptr && chose_ramp(plan, *ws);
  feed_chosen_ = ws != nullptr && chose_feed(plan, *ws);
  std::string why;
  if (undercuts(cutter_.cutter_class)) {
    why = "an undercut is not held as heights";
  } else if (ws != nullptr) {
    why = target.undecided(ws->its_feature);
  }
  if (!why.empty()) {
    judge_gouge_ = false;
    out_.unproved(Severity::kNote, 11, "CHK-GOUGE-UNDECIDED", {step.order + 1, step.id, -1},
                  "the check does not judge this step for gouges: " + why);
  }
}

bool StepChecks::hole_tool() const { return works_along_axis(cutter_); }

bool StepChecks::in_hole(const Move& m) const {
  const double low = std::min(m.from.z, m.to.z);
  return low < grid_.top() && grid_.highest(xy(m.from), radius_ + 2.0 * grid_.cell()) > low + 0.1;
}

void StepChecks::run() {
  for (const Move& m : step_.moves) {
    poll();
    if (m.kind == MoveKind::kRapid) {
      settle();
      rapid(m);
    } else if (m.kind != MoveKind::kDwell) {
      feed(m);
    }
    follow(m);
  }
  settle();
  rubbing();
}

void cut_before(EarlierCuts& earlier, const StepMoves& step) {
  if (under_overhangs(step.cutter->cutter_class)) return;
  const auto outline = std::make_shared<const CutterOutline>(outline_of(*step.cutter));
  for (const Move& m : step.moves) {
    if (m.kind != MoveKind::kRapid && m.kind != MoveKind::kDwell) earlier.add(m, outline);
  }
}

void StepChecks::feed(const Move& m) {
  if (under_overhangs(cutter_.cutter_class)) {
    // Heights hold no overhang: what the head cuts below one is not taken from them.
    head(m);
    spindle(m, {});
    reach(m);
    neck(m, grid_);
    return;
  }
  if (before_ != nullptr) {
    neck(m, *before_);
    ring_up(m);
  }
  const double allowed = target_.allowed();
  const double fz = feed_per_tooth(m);
  const double flutes = cutter_.maximum_depth_of_cut_mm, low = std::min(m.from.z, m.to.z);
  // No chip is thicker than its feed, no contact higher than the stock above the lowest tip: what must be
  // within its limit is not measured.
  Bite bite = cut(grid_, m, *outline_,
                  {.allowed_mm = judge_gouge_ ? allowed : 1e300,
                   .judge = &target_,
                   .advance_mm = !feed_limit_.per_revolution && fz > thickest_chip() ? fz : 0.0,
                   .contact = flutes > 0.0 && grid_.top() - low > flutes + kSlackMm,
                   .above_underside = follows_its_lead(cutter_)});
  if (before_ != nullptr) of_a_ring(bite, flutes);
  cut_mm3_ += bite.volume_mm3;
  chips(m, bite, fz);
  earlier_.add(m, outline_);
  if (judge_gouge_) gouge(m, bite);
  spindle(m, bite);
  reach(m);
  body(m);
  if (bite.volume_mm3 > kTouchMm3) {
    contact(m, bite);
    entry(m, bite);
  }
  if (cutter_.cutter_class == CutterClass::kTap) {
    tapping(m);
    return;
  }
  account(m, bite);
}

// Above its head such a cutter has nothing that cuts: the mouth must be open for the neck, and there must be
// nothing under the head where it goes down.
void StepChecks::neck(const Move& m, const Grid& grid) {
  const double head =
      cutter_.cutting_width_mm > 0.0 ? cutter_.cutting_width_mm : cutter_.maximum_depth_of_cut_mm;
  double radius = 0.5 * cutter_.neck_diameter_mm;
  if (radius <= 0.0 && cutter_.cutter_class == CutterClass::kDovetailMill)
    radius = radius_ - head * std::tan(cutter_.lead_angle_rad);
  if (step_.planned != nullptr) {
    const auto* ws = plan_.model.get<model::MachiningWorkingstep>(step_.planned->step);
    const PartShapes::Entry* e = ws != nullptr ? target_.part().find(ws->its_feature) : nullptr;
    const bool holes = e != nullptr && !e->shapes.empty() &&
                       std::all_of(e->shapes.begin(), e->shapes.end(),
                                   [](const auto& s) { return s.kind == model::ShapeKind::kHole; });
    const int pieces = holes ? std::max(4, static_cast<int>(std::ceil(length_of(m)))) : -1;
    for (int i = 0; i <= pieces; ++i) {
      const geometry::Vec3 p = point_of(m, static_cast<double>(i) / pieces);
      const double into =
          into_hole_walls(e->shapes, workpiece_in(plan_, step_.planned->setup), cutter_, head, p);
      if (into <= kSlackMm) continue;
      out_.error(11, "CHK-HEAD", at(m),
                 "the tool's head runs " + mm(into) + " into a hole's wall at " + here(xy(p)), into);
      return;
    }
  }
  const double slack = neck_slack(grid);
  if (radius <= slack) return;  // not known, or too thin to be judged on these cells
  const double length = length_of(m);
  const int n = std::max(1, static_cast<int>(std::ceil(length / std::max(grid.cell(), 0.5 * radius))));
  const bool falls = m.to.z < m.from.z - 1e-9 && !(mills_threads(cutter_.cutter_class) && winds(m, head));
  for (int i = 0; i <= n; ++i) {
    const geometry::Vec3 p = point_of(m, static_cast<double>(i) / n);
    const double beside = grid.highest(xy(p), radius - slack) - (p.z + head);
    const double below = falls ? grid.highest(xy(p), std::max(0.0, radius_ - slack)) - p.z : 0.0;
    if (beside > kSlackMm || below > kSlackMm) {
      const bool first = beside > kSlackMm;
      out_.error(11, first ? "CHK-NECK" : "CHK-HEAD", at(m),
                 std::string(first ? "the tool's neck" : "the tool goes down and its head") + " runs " +
                     mm(first ? beside : below) + " into material at " + here(xy(p)) + " (cells of " +
                     mm(grid.cell()) + ")",
                 first ? beside : below);
      return;
    }
  }
}

// A ring of teeth that leaves its groove upwards tears off the thread: only a helix, or a way that goes aside
// at least as far as up, leads it out. Heights do not show it, for they lose all material over the ring.
void StepChecks::ring_up(const Move& m) {
  const double rise = m.to.z - m.from.z, head = cutter_.maximum_depth_of_cut_mm;
  if (before_ == nullptr || rise <= 1e-9) return;
  const bool aside = !is_arc(m.kind) && norm(xy(m.to) - xy(m.from)) >= rise;
  if (m.kind != MoveKind::kRapid && (aside || winds(m, head))) return;
  const double into =
      before_->highest(xy(m.from), std::max(0.0, radius_ - neck_slack(grid_))) - (m.from.z + head);
  if (into <= kSlackMm) return;
  out_.error(11, "CHK-HEAD", at(m),
             "the tool goes up and its head runs " + mm(into) + " into material at " + here(xy(m.from)) +
                 " (cells of " + mm(grid_.cell()) + ")",
             into);
}

void StepChecks::gouge(const Move& m, const Bite& bite) {
  if (bite.gouge_mm > 0.0) {
    // The point of a drill below a flat bottom is what drilling does to one: said, but apart.
    const bool point = tip_mm_ > 0.0 && hole_tool() && bite.gouge_mm <= tip_mm_ + target_.allowed() &&
                       norm(bite.gouge_at - xy(m.to)) <= 1.5 * grid_.cell();
    const std::string text = mm(bite.gouge_mm) + " below the finished surface at " + here(bite.gouge_at) +
                             "; allowed " + mm(target_.allowed()) + " (cells of " + mm(grid_.cell()) + ")";
    if (point) {
      out_.warn(11, "CHK-GOUGE-POINT", at(m), "the tool's point ends " + text, bite.gouge_mm);
    } else {
      out_.error(11, "CHK-GOUGE", at(m), "the cutter goes " + text, bite.gouge_mm);
    }
  }
  Vec2 where;
  double worst = target_.wall_gouge(m, radius_, outline_->height(radius_), where);
  const std::vector<geometry::ProfilePiece>& pieces = outline_->profile().pieces;
  const double flat = pieces.empty() ? 0.0 : pieces.front().r1_mm;
  if (pieces.size() > 1 && pieces.front().radius_mm == 0.0 && pieces.front().slope == 0.0 &&
      flat > target_.allowed()) {
    Vec2 other;
    const double below = target_.wall_gouge(m, flat, 0.0, other);
    if (below > worst) {
      worst = below;
      where = other;
    }
  }
  if (worst > 0.0) {
    out_.error(11, "CHK-GOUGE-WALL", at(m),
               "the cutter at " + here(where) + " enters a finished wall by " + mm(worst) + "; allowed " +
                   mm(target_.allowed()),
               worst);
  }
}

// The thread of a tap goes through the hole as a nut does: what is behind it is its neck.
bool StepChecks::neck_in_core() const {
  if (cutter_.cutter_class != CutterClass::kTap || !(cutter_.neck_diameter_mm > 0.0)) return false;
  if (step_.planned == nullptr) return false;
  const auto* ws = plan_.model.get<model::MachiningWorkingstep>(step_.planned->step);
  const PartShapes::Entry* e = ws != nullptr ? target_.part().find(ws->its_feature) : nullptr;
  return e != nullptr && !e->shapes.empty() &&
         std::all_of(e->shapes.begin(), e->shapes.end(), [&](const volumes::Form& s) {
           const volumes::Bore* bore = s.kind == model::ShapeKind::kThread ? s.bore() : nullptr;
           return bore != nullptr &&
                  0.5 * cutter_.neck_diameter_mm < std::min(bore->top_radius_mm, bore->bottom_radius_mm);
         });
}

void StepChecks::contact(const Move& m, const Bite& bite) {
  const double flutes = cutter_.maximum_depth_of_cut_mm;
  if (flutes <= 0.0) return;
  // Above a ring of teeth is its neck, which was judged; that of a tap has room in the thread's core.
  const double cuts_to = before_ != nullptr || neck_in_core() ? cutter_.neck_length_mm : flutes;
  if (bite.contact_mm > cuts_to + kSlackMm) {
    out_.error(13, "CHK-FLUTE", at(m),
               "material is cut " + mm(bite.contact_mm) + " above the tip; the flutes are " + mm(flutes) +
                   " long: cut it in more steps of depth, or use a tool with longer flutes",
               bite.contact_mm);
  }
  if (is_mill(cutter_) && bite.thickest_mm > flutes + kSlackMm) {
    out_.error(20, "CHK-DEPTH", at(m),
               "depth of cut " + mm(bite.thickest_mm) + "; the tool's largest is " + mm(flutes) +
                   ": cut it in more steps of depth, or use a tool with longer flutes",
               bite.thickest_mm);
  }
}

void StepChecks::reach(const Move& m) {
  const double low = std::min(m.from.z, m.to.z);
  const double length = cutter_.stick_out_mm;
  if (length <= 0.0 || grid_.top() - low <= length + kSlackMm) return;
  const double holder = std::max(0.5 * cutter_.holder_diameter_mm, radius_ + 2.0 * grid_.cell());
  const double high = std::max(grid_.highest(xy(m.from), holder), grid_.highest(xy(m.to), holder));
  if (high - low > length + kSlackMm) {
    out_.error(
        13, "CHK-REACH", at(m),
        "the tip is " + mm(high - low) + " below the material beside the tool; it sticks out " + mm(length),
        high - low);
  }
}

/// Shank and holder against what stands beside the tool: discs along the move that cover their bands.
void StepChecks::body(const Move& m) {
  const double low = std::min(m.from.z, m.to.z);
  for (const BodyPart& p : body_) {
    if (low + p.from_mm >= grid_.top() - kSlackMm) continue;
    const double spacing = std::max(grid_.cell(), 0.25 * p.radius_mm);
    const int n = std::clamp(static_cast<int>(std::ceil(length_of(m) / spacing)), 1, 4000);
    const double half = 0.5 * length_of(m) / n;
    const double r = std::hypot(p.radius_mm - kSlackMm, half);
    for (int i = 0; i < n; ++i) {
      tick();
      const geometry::Vec3 at_point = point_of(m, (i + 0.5) / n);
      const double z =
          std::min(point_of(m, static_cast<double>(i) / n).z, point_of(m, static_cast<double>(i + 1) / n).z);
      if (z + p.from_mm >= grid_.top() - kSlackMm) continue;
      const double into = grid_.highest(xy(at_point), r) - (z + p.from_mm);
      if (into <= kSlackMm) continue;
      const bool holder = p.what == BodyPart::What::kHolder;
      out_.error(12, holder ? "CHK-HOLDER" : "CHK-SHANK", at(m),
                 std::string(to_text(p.what)) + " (diameter " + mm(2.0 * p.radius_mm) + ", from " +
                     mm(p.from_mm) + " above the tip) runs " + mm(into) + " into material beside " +
                     here(xy(at_point)) + " with the tip at z = " + plain(z),
                 into);
    }
  }
}

void StepChecks::spindle(const Move& m, const Bite& bite) {
  const bool touches = bite.volume_mm3 > kTouchMm3;
  if (m.spindle_rpm == 0.0) {
    if (touches || (hole_tool() && cutter_.cutter_class != CutterClass::kBoringTool && in_hole(m))) {
      out_.error(15, "CHK-SPINDLE-STOPPED", at(m),
                 touches ? "the tool cuts " + plain(bite.volume_mm3) + " mm3 with the spindle stopped"
                         : "the tool moves in its hole with the spindle stopped",
                 bite.volume_mm3);
    }
    return;
  }
  const bool right = cutter_.hand != model::Hand::kLeft;
  const bool backs_out = cutter_.cutter_class == CutterClass::kTap && m.to.z > m.from.z;
  if (touches && !backs_out && (m.spindle_rpm > 0.0) != right) {
    out_.error(15, "CHK-SPINDLE-DIRECTION", at(m),
               std::string("the spindle turns ") + (right ? "counter-clockwise" : "clockwise") + " for a " +
                   (right ? "right" : "left") + "-hand tool");
  }
}

void StepChecks::tapping(const Move& m) {
  const double pitch = cutter_.thread_pitch_mm;
  const double n = std::abs(m.spindle_rpm);
  if (!(pitch > 0.0) || !in_hole(m) || n == 0.0) return;
  if (std::abs(m.feed_mm_min - pitch * n) > 0.01 * pitch * n) {
    out_.error(18, "CHK-TAP-FEED", at(m),
               "a feed of " + plain(m.feed_mm_min) + " mm/min is not the pitch of " + mm(pitch) + " at " +
                   plain(n) + " rpm",
               std::abs(m.feed_mm_min - pitch * n));
  }
  // The largest tap torque: K p^2 D kc / 8000, kc at a chip as thick as the pitch divided by eight teeth.
  const model::WorkMaterial& w = plan_.material;
  if (!(w.kc11_n_mm2 > 0.0) || m.to.z > m.from.z) return;
  const double h =
      std::clamp(pitch / 8.0, mechanics::kKienzleMinChipThicknessMm, mechanics::kKienzleMaxChipThicknessMm);
  const double kc = w.kc11_n_mm2 * std::pow(h, -w.mc);
  const double torque =
      mechanics::kTappingTorqueFactor * pitch * pitch * cutter_.cutting_diameter_mm * kc / 8000.0;
  const model::SpindlePoint limit = spindle_at(plan_.machine.spindle, n);
  if (limit.torque_nm > 0.0 &&
      torque > limit.torque_nm * mechanics::spindle_efficiency(plan_.machine.spindle.efficiency)) {
    out_.error(
        17, "CHK-TORQUE", at(m),
        "spindle torque " + plain(torque) + " of " + plain(limit.torque_nm) + " Nm at " + plain(n) +
            " 1/min for tapping; turn at a speed at which the spindle has more torque, or mill the thread",
        torque);
  }
}

}  // namespace capstan::verify
