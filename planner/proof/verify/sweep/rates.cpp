#include <algorithm>
#include <cmath>
#include <numbers>

#include "planner/model/nouns/all.h"
#include "planner/model/plan/decision/by_planning.h"
#include "planner/model/plan/resources/specific_force.h"
#include "planner/physics/mechanics/constants.h"
#include "planner/proof/verify/copies/copies.h"
#include "planner/proof/verify/stated_values.h"
#include "planner/proof/verify/sweep/step_checks.h"

namespace capstan::verify {

using geometry::Vec2;
using model::CutterClass;

namespace {

constexpr double kTouchMm3 = 1e-6;  ///< less than this is not a cut
constexpr double kDeeper = 1.5;     ///< depth over that planned, at most; default, unsourced
constexpr double kWider = 8.0;      ///< mean section over that planned, at most; default, unsourced
/// Of the diameter squared: smaller sections are nothing for a cutter, however little was planned; default,
/// unsourced.
constexpr double kFeltShare = 0.01;

/// How far the outermost point of the edge goes: on an arc farther than the centre. A volume divided by it is
/// the least width that can have been cut, whichever side of the arc it lies on.
double edge_length(const Move& m, double radius_mm) {
  const double arc = is_arc(m.kind) ? norm(xy(m.to) - m.centre) : 0.0;
  return length_of(m) * (arc > 1e-6 ? (arc + radius_mm) / arc : 1.0);
}

/// The length of the mean force of a cut with this arc of contact, over the mean of its length. Forces grow
/// as the chip, sin(phi), and turn with phi, which goes from 0 to the arc a:
///
///     |int sin(phi) (cos(phi), sin(phi))| / int sin(phi) = |(sin(a)^2 / 2, a / 2 - sin(2 a) / 4)| / (1 -
///     cos(a))
///
/// 1 for a short arc, 0.93 for a quarter turn, pi / 4 for a slot. Source: derived; tangential and radial
/// force turn together.
double together(double arc_rad) {
  const double sine = std::sin(arc_rad);
  return std::hypot(0.5 * sine * sine, 0.5 * arc_rad - 0.25 * std::sin(2.0 * arc_rad)) /
         (1.0 - std::cos(arc_rad));
}

}  // namespace

void StepChecks::account(const Move& m, const Bite& bite) {
  const double length = length_of(m);
  const double rpm = std::abs(m.spindle_rpm);
  const bool axial = norm(xy(m.to) - xy(m.from)) < 1e-6 && !is_arc(m.kind);
  if (sum_.length_mm > 0.0 && (std::abs(sum_.feed_mm_min - m.feed_mm_min) > 0.01 * sum_.feed_mm_min ||
                               sum_.rpm != rpm || sum_.axial != axial)) {
    settle();
  }
  if (!(length > 0.0) || !(m.feed_mm_min > 0.0)) return;
  if (bite.volume_mm3 <= kTouchMm3) {
    settle();
    left_ = {};
    return;
  }
  if (sum_.length_mm == 0.0) sum_.where = m.where;
  sum_.length_mm += length;
  sum_.edge_mm += edge_length(m, radius_);
  sum_.volume_mm3 += bite.volume_mm3;
  sum_.minutes += length / m.feed_mm_min;
  sum_.depth_mm = std::max(sum_.depth_mm, bite.thickest_mm);
  sum_.feed_mm_min = m.feed_mm_min;
  sum_.rpm = rpm;
  sum_.axial = axial;
  if (sum_.length_mm > std::max(2.0, 0.5 * radius_)) settle();
  if (axial) return;
  if (left_.edge_mm == 0.0) left_.where = m.where;
  left_.edge_mm += edge_length(m, radius_);
  left_.volume_mm3 += bite.volume_mm3;
  left_.length_mm += length;
  left_.minutes += length / m.feed_mm_min;
  left_.rpm = rpm;
  left_.depth_mm = std::max(left_.depth_mm, bite.thickest_mm);
  if (left_.edge_mm > 2.0 * radius_) planned_section();
}

// What roughing left falls to finishing, whose cut was chosen for less. Along a row of cells a thin strip
// counts as the whole row, so that a section is known but for a cell's width. Where the feed was chosen for
// what is met there, the plan's own loads tell of it; where the mean force is larger than any that the plan
// states, nobody held the limits against this cut, whichever it keeps by luck.
void StepChecks::planned_section() {
  const Account a = left_;
  left_ = {};
  if (step_.planned == nullptr || works_along_axis(cutter_)) return;
  const double depth = step_.planned->axial_depth_mm, width = step_.planned->radial_depth_mm;
  if (!(depth > 0.0) || !(width > 0.0)) return;
  const double section = a.volume_mm3 / a.edge_mm, sure = section - grid_.cell() * a.depth_mm;
  // A section that is nothing for the cutter is not worth a word, however little was planned.
  const double felt = kFeltShare * cutter_.cutting_diameter_mm * cutter_.cutting_diameter_mm;
  const bool deep = a.depth_mm > kDeeper * depth + 2.0 * grid_.cell();
  const bool wide = section > std::max(kWider * depth * width, felt) && sure > kWider * depth * width;
  if (!deep && !wide) return;
  const double stated = step_.planned->loads.peak_force_n, met = mean_force(a);
  // Where either force cannot be told, nothing says that a limit was held.
  const bool told = stated > 0.0 && met > 0.0;
  const bool unheld = !told || met > kMeasured * stated;
  const Findings::Where where{step_.order + 1, step_.id, a.where};
  const auto tell = [&](const char* code, std::string text, double amount) {
    if (!unheld) return out_.warn(20, code, where, std::move(text), amount);
    if (!told) {
      return out_.error(20, code, where,
                        text + "; " +
                            (stated > 0.0 ? "the force that this needs is not known"
                                          : "the plan states no force for the step") +
                            ", so that nothing shows that its limits were held there; rough it first",
                        amount);
    }
    out_.error(20, code, where,
               text + "; that asks for a mean force of " + plain(met) +
                   " N (worn edge), more than the largest that the plan states for the step, " +
                   plain(stated) + " N: its limits were not held there; rough it first",
               amount);
  };
  // Deeper and narrower: a strip on a wall beside a floor, the edge of thin levels. No more is removed than
  // was planned, by a force within what the plan states: no limit hangs on it.
  if (deep && !wide && !unheld && section <= depth * width)
    out_.note(20, "CHK-DEPTH-LEFT", where,
              mm(a.depth_mm) + " are cut in a strip of " + plain(section) +
                  " mm2; the step was planned for " + mm(depth) + " x " + mm(width) + ": a mean force of " +
                  plain(met) + " N, within the " + plain(stated) + " N that the plan states");
  else if (deep)
    tell("CHK-DEPTH-LEFT", mm(a.depth_mm) + " are cut; the step was planned for a depth of " + mm(depth),
         a.depth_mm);
  if (wide)
    tell("CHK-WIDTH-LEFT",
         "over " + mm(a.edge_mm) + " a section of " + plain(section) +
             " mm2 is cut; the step was planned for " + mm(depth) + " x " + mm(width),
         section);
}

double StepChecks::override_most() const {
  if (cutter_.cutter_class == CutterClass::kTap || mills_threads(cutter_.cutter_class)) return 1.0;
  return std::max(1.0, plan_.machine.abilities.feed_override_max);
}

double StepChecks::chip_of(const Account& a) const {
  const double fz = a.length_mm / a.minutes / (a.rpm * std::max(1, cutter_.teeth));
  if (a.axial || !(a.depth_mm > 0.0))
    return fz * std::sin(0.5 * (cutter_.point_angle_rad > 0.0 ? cutter_.point_angle_rad : std::numbers::pi));
  // Width and feed give the chip (chord geometry). The cutter is a disc that is moved: also on an arc no chip
  // is thicker than its centre's feed.
  const double arc = arc_of(a);
  return fz * (1.0 - std::cos(arc)) / arc;
}

/// Arc of contact of a cut aside, rad: the mean section and the depth give the width.
double StepChecks::arc_of(const Account& a) const {
  const double d = std::max(1e-6, cutter_.cutting_diameter_mm);
  const double width = std::clamp(a.volume_mm3 / a.length_mm / a.depth_mm, 0.01 * d, d);
  return std::acos(1.0 - 2.0 * width / d);
}

double worn_specific_force(const model::Plan& plan, const model::Cutter& cutter, double chip_mm) {
  const double h =
      std::clamp(chip_mm, mechanics::kKienzleMinChipThicknessMm, mechanics::kKienzleMaxChipThicknessMm);
  // Solid mills cut with a rake, but for hardened steel.
  const bool raked = is_raked(cutter.cutter_class) && plan.material.iso_group != "H";
  const double rake = raked ? 1.0 - model::kForcePerDegreeOfRake * model::kEndMillRakeDeg : 1.0;
  const double kc =
      rake * plan.material.kc11_n_mm2 * std::pow(h, -plan.material.mc) * mechanics::kWearForceFactor;
  return cutter.cutter_class == CutterClass::kReamer ? kc * mechanics::kReamingFrictionFactor : kc;
}

double StepChecks::specific_force(double chip_mm) const {
  return worn_specific_force(plan_, cutter_, chip_mm);
}

/// The mean force in the plane normal to the axis, N; 0 unknown. Power gives the sum of the tangential
/// forces; the force that a plan states is that of all edges together, which point the less the same way the
/// longer the arc is (`together`).
double StepChecks::mean_force(const Account& a) const {
  const double speed_mm_min = std::numbers::pi * cutter_.cutting_diameter_mm * a.rpm;
  if (!(speed_mm_min > 0.0) || !(a.minutes > 0.0) || !(plan_.material.kc11_n_mm2 > 0.0)) return 0.0;
  const double edges = specific_force(chip_of(a)) * a.volume_mm3 / a.minutes / speed_mm_min *
                       std::hypot(1.0, mechanics::kRadialToTangentialRatio);
  return a.axial || !(a.depth_mm > 0.0) ? edges : together(arc_of(a)) * edges;
}

void StepChecks::settle() {
  if (sum_.length_mm > std::max(0.5, 3.0 * grid_.cell()) && sum_.rpm > 0.0) {
    if (sum_.axial || works_along_axis(cutter_))
      axial_feed(sum_.feed_mm_min / (sum_.rpm * std::max(1, cutter_.teeth)));
    power(sum_.volume_mm3, sum_.minutes, chip_of(sum_));
    heat(true);
  } else if (sum_.length_mm > 0.0 && sum_.rpm > 0.0) {
    heat(false);
  }
  sum_ = {};
}

// Wear adds up over the way: by Taylor's law an edge at speed v wears as v^(1/n), and one that is in the cut
// for a short arc as one that turns slower by `speed_by_arc`. Where the material's depth varies, its thickest
// makes the width too small by less than the arc of a ramp is too wide: a slot stays a slot. What is too
// short to be measured counts as the table's arc. Wear averages, but an edge that is in for a quarter turn or
// more gets as hot as the table's, however long it cuts little after: there its speed is what is turned.
void StepChecks::heat(bool measured) {
  if (!arcs_count_) return;
  const double d = std::max(1e-6, cutter_.cutting_diameter_mm);
  const bool known = measured && sum_.depth_mm > 0.0;
  const double width = known && !sum_.axial ? sum_.volume_mm3 / sum_.length_mm / sum_.depth_mm : d;
  const double rpm = sum_.rpm / (known ? speed_by_arc(width / d, plan_.material.iso_group) : 1.0);
  if (known && width >= 0.5 * d) widest_rpm_ = std::max(widest_rpm_, sum_.rpm);
  heated_min_ += sum_.minutes;
  heated_ += sum_.minutes * std::pow(rpm, 1.0 / mechanics::kTaylorExponentCarbide);
  fastest_rpm_ = std::max(fastest_rpm_, sum_.rpm);
}

double StepChecks::speed_share() const {
  if (!(heated_min_ > 0.0) || !(fastest_rpm_ > 0.0)) return 1.0;
  const double rpm = std::pow(heated_ / heated_min_, mechanics::kTaylorExponentCarbide);
  return std::min(1.0, std::max(rpm, widest_rpm_) / fastest_rpm_);
}

double StepChecks::feed_per_tooth(const Move& m) const {
  const double n = std::abs(m.spindle_rpm);
  return n > 0.0 ? m.feed_mm_min / (n * std::max(1, cutter_.teeth)) : 0.0;
}

void StepChecks::axial_feed(double fz) {
  const FeedLimit& limit = feed_limit_;
  const double feed = limit.per_revolution ? fz * std::max(1, cutter_.teeth) : fz;
  if (feed <= limit.mm * (1.0 + kWritten)) return;
  out_.error(18, "CHK-FEED-TOOL", {step_.order + 1, step_.id, sum_.where},
             "a feed of " + mm(feed) + (limit.per_revolution ? " per revolution" : " per tooth") +
                 " along the axis; at most " + mm(limit.mm) + " (" + limit.source + ", diameter " +
                 mm(cutter_.cutting_diameter_mm) + "): feed slower, or use a tool that allows more",
             feed);
}

// A feed that no square cut would bear is right where the cut is thin: whether it is, cells may be too far
// apart to show.
void StepChecks::chips(const Move& m, const Bite& bite, double fz) {
  const double least = least_chip_mm_ * (1.0 - kWritten);
  const bool sideways = norm(xy(m.to) - xy(m.from)) > 0.0 || is_arc(m.kind);
  if (!works_along_axis(cutter_) && sideways && bite.volume_mm3 > 0.0 && fz > 0.0 && fz < least) {
    if (rubbed_mm_ == 0.0 || fz < rubbed_at_mm_) {
      rubbed_at_mm_ = fz;
      rubbed_ = at(m);
    }
    rubbed_mm_ += length_of(m);
  }
  chip(m, bite.chip_mm, fz, bite.chip_at);
  const double most = thickest_chip();
  if (bite.chip_mm > most) looks_ = 0;  // the step has its finding: no closer look changes that
  if (works_along_axis(cutter_) || fz <= most || looks_ <= 0) return;
  if (std::min(m.from.z, m.to.z) >= grid_.top()) return;
  const Chip closer = earlier_.look(grid_, m, outline_, fz, most, looks_);
  chip(m, closer.mm, fz, closer.at);
}

// No tooth takes a thicker chip than its feed: below the thinnest one that cuts, all of it rubs. Moves too
// short to come to speed do no harm.
void StepChecks::rubbing() {
  constexpr double kHarmlessMm = 1.0;  // default, unsourced
  if (rubbed_mm_ <= kHarmlessMm) return;
  const std::string text = "over " + mm(rubbed_mm_) + " of way in material the feed is down to " +
                           fine_mm(rubbed_at_mm_) + " per tooth, where an edge rubs; at least " +
                           fine_mm(least_chip_mm_) + " in " + plan_.material.id +
                           ": feed faster, cut less deep, or use a stiffer cutter";
  // What a file or the operator states is theirs to know; planning has other depths, tools and ways.
  if (feed_chosen_) {
    out_.error(18, "CHK-RUB", rubbed_, text, rubbed_at_mm_);
  } else {
    out_.warn(18, "CHK-RUB", rubbed_, text, rubbed_at_mm_);
  }
}

bool chose_feed(const model::Plan& plan, const model::MachiningWorkingstep& ws) {
  const auto* op = plan.model.get<model::MachiningOperation>(ws.its_operation);
  if (op == nullptr) return false;
  for (const char* name : {"feedrate", "feedrate_per_tooth"})
    if (model::by_planning(plan.ledger.find(op->its_technology, name))) return true;
  return false;
}

double StepChecks::thickest_chip() const { return feed_limit_.mm * (1.0 + kWritten); }

void StepChecks::chip(const Move& m, double thickest_mm, double fz, Vec2 where) {
  const FeedLimit& limit = feed_limit_;
  if (limit.per_revolution || thickest_mm <= thickest_chip()) return;
  out_.error(18, "CHK-FEED-TOOL", at(m),
             "chips of up to " + mm(thickest_mm) + " at (" + plain(where.x) + ", " + plain(where.y) +
                 ") (feed per tooth " + mm(fz) + "); at most " + mm(limit.mm) + " (" + limit.source +
                 ", diameter " + mm(cutter_.cutting_diameter_mm) +
                 "): feed slower there, or use a tool that allows more",
             thickest_mm);
}

void StepChecks::power(double volume, double minutes, double chip_mm) {
  const model::WorkMaterial& w = plan_.material;
  const model::Spindle& spindle = plan_.machine.spindle;
  if (!(w.kc11_n_mm2 > 0.0) || spindle.curve.empty() || !(minutes > 0.0)) return;
  const double kc = specific_force(chip_mm);
  const double power_w = kc * volume / minutes / 60000.0;  // N/mm2 mm3/min = N mm/min = 1/60000 W
  const double torque_nm = power_w / (sum_.rpm * 2.0 * std::numbers::pi / 60.0);
  const double efficiency = mechanics::spindle_efficiency(spindle.efficiency);
  const model::SpindlePoint limit = spindle_at(spindle, sum_.rpm);
  const Findings::Where where{step_.order + 1, step_.id, sum_.where};
  const std::string how =
      ": " + plain(volume / minutes) + " mm3/min at kc = " + plain(kc) + " N/mm2, worn edge";
  // Written feeds must hold with a worn edge; the operator's override has a finding of its own. h^-mc makes
  // force grow slower than feed. A worn edge and a feed turned up know nothing of one another: over a sharp
  // edge at the written feed their logarithms add as squares.
  const double turned_up = (1.0 - w.mc) * std::log(override_most());
  const double worn = std::log(mechanics::kWearForceFactor);
  const double up = std::exp(std::hypot(worn, turned_up) - worn);
  const auto judge = [&](const char* code, const char* what, const char* unit, double asked, double gives) {
    if (!(gives > 0.0)) return;
    const double most = gives * efficiency;
    if (up * asked <= kMeasured * most) return;
    const bool written = asked > kMeasured * most;
    const std::string text = std::string("spindle ") + what + " " + plain(written ? asked : up * asked) +
                             " of " + plain(most) + " " + unit + " at " + plain(sum_.rpm) + " 1/min" + how +
                             (written ? "" : ", the operator's feed override at its most") +
                             "; use a smaller tool or a smaller depth, or feed slower";
    if (written)
      out_.error(17, code, where, text, asked);
    else
      out_.warn(17, code + std::string("-OVERRIDE"), where, text, asked);
  };
  judge("CHK-POWER", "power", "W", power_w, limit.power_w);
  judge("CHK-TORQUE", "torque", "Nm", torque_nm, limit.torque_nm);
  deflection(up * torque_nm);
}

// Least bending: the mean tangential force and its radial share at the tip, the neck as thick as the shank.
void StepChecks::deflection(double torque_nm) {
  const double flutes = std::min(cutter_.maximum_depth_of_cut_mm, cutter_.stick_out_mm);
  const double d = cutter_.cutting_diameter_mm, shank = cutter_.shank_diameter_mm;
  if (works_along_axis(cutter_) || cutter_.cutter_class == CutterClass::kFacemill || sum_.axial) return;
  if (!(flutes > 0.0) || !(shank > 0.0)) return;
  const double e = cutter_.substrate == model::Substrate::kHss ? mechanics::kHssYoungsModulusNMm2
                                                               : mechanics::kCarbideYoungsModulusNMm2;
  const auto inertia = [](double x) { return std::numbers::pi * std::pow(x, 4) / 64.0; };
  const double l3 = std::pow(cutter_.stick_out_mm, 3), f3 = std::pow(flutes, 3);
  const double per_n =
      (f3 / inertia(mechanics::kFluteEquivalentDiameterRatio * d) + (l3 - f3) / inertia(shank)) / (3.0 * e);
  const double tangential = 2000.0 * torque_nm / d;
  const double force = tangential * std::hypot(1.0, mechanics::kRadialToTangentialRatio);
  if (force * per_n <= kMeasured * kMostBentMm) return;
  out_.error(21, "CHK-DEFLECTION", {step_.order + 1, step_.id, sum_.where},
             "a mean force of " + plain(force) + " N (worn edge, feed override) bends the tip by " +
                 mm(force * per_n) + "; at most " + mm(kMostBentMm) +
                 ": cut less deep or less wide, feed slower, or use a stiffer or shorter cutter",
             force * per_n);
}

}  // namespace capstan::verify
