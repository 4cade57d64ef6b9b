#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <optional>

#include "planner/ground/base/number.h"
#include "planner/model/nouns/all.h"
#include "planner/physics/mechanics/constants.h"
#include "planner/proof/verify/copies/copies.h"
#include "planner/proof/verify/plan/plan_checks.h"
#include "planner/proof/verify/stated_values.h"
#include "planner/proof/verify/sweep/step_checks.h"
#include "planner/proof/verify/sweep/target/target.h"

// What follows from a step's own numbers, whoever chose them: its cutting speed is held against what the
// material's card or the tool states for that material, its edge's life against the time that it cuts, what
// the plan says of bending against the feature's tolerance. A card is for no tool in particular, and a life
// by Taylor's law falls with the fourth to eighth power of the speed: a speed somewhat above the card's is a
// warning; an error only where the edge would not last its own step even if the card were too slow by
// kCardShort. A cutter of which no one stated what it is made of is judged as the slower material, which the
// plan takes for it, and where that alone condemns it, it is a warning that says so.

namespace capstan::verify {

using model::CutterClass;
using model::Substrate;

namespace {

/// Speed over the card's or the tool's own from which the check reports it; planning may reach it where a
/// spindle turns no slower. Default, unsourced.
constexpr double kFaster = 1.25;
/// By how much a card's speed may be too low for the tool at hand (grade, share of the turn in the cut):
/// tables for one material and substrate differ by about this. Default, unsourced.
constexpr double kCardShort = 1.5;
/// Edges of a tool from which a plan surely wears out the first, and that is a warning: lives by the
/// textbook's law are uncertain by a factor of two (mechanics/life/life.h).
constexpr double kSurelyWorn = 2.0;
/// Bending stress at which a shank surely breaks or stays bent, N/mm2: transverse rupture strengths of
/// cemented carbide (ISO 3327) and of hardened high-speed steel lie at 2000 to 4000. Default, unsourced. The
/// 2131 behind kCarbideEnduranceNMm2 (mechanics/constants.h) are the mean of one test's blanks, from which
/// a tool is not to be loaded; an error is only what hardly any grade endures.
constexpr double kBreakingNMm2 = 3500.0;
/// Of a tolerance zone: what one wall may be pushed by and be within it at all, and what both walls of a
/// pocket or slot may be, each. Derived: a size in the middle of its zone has half of it on either side.
constexpr double kWallOfZone = 0.5, kBothOfZone = 0.25;
/// However much is left, a tool that bends by more is not cutting where it is led. Default, unsourced.
constexpr double kMostIntoLeftMm = 0.4;
constexpr double kModelErrorMm = 0.005;  ///< below, the model's own error rules; default, unsourced

/// What is known of a cutter's speed in a material.
struct Reference {
  double vc_m_min = 0.0;  ///< 0: it is not for this material
  std::string source;
  /// A card's speed is of a bare edge, and no cutter says whether it is coated: how much faster it is then.
  double coated = 1.0;
  double life_min = mechanics::kLifeAtTableMin, n = mechanics::kTaylorExponentCarbide;
  [[nodiscard]] double life_at(double vc) const { return life_min * std::pow(vc / vc_m_min, -1.0 / n); }
};

/// Steel, stainless steel and cast iron; the factors of the other groups are 1 there.
bool coating_helps(const model::WorkMaterial& m) {
  return m.iso_group == "P" || m.iso_group == "M" || m.iso_group == "K";
}

/// Nothing when the material's card states no speed for anything: then there is none to compare with.
std::optional<Reference> reference_of(const model::WorkMaterial& m, const model::Cutter& c, Substrate s) {
  Reference out;
  const bool hss = s == Substrate::kHss;
  out.n = hss ? mechanics::kTaylorExponentHss : mechanics::kTaylorExponentCarbide;
  if (c.life_min > 0.0) out.life_min = c.life_min;
  const double coated = !hss && coating_helps(m) ? coated_over_bare(c) : 1.0;
  const double card = hss ? m.vc_hss_m_min : m.vc_carbide_m_min;
  // Presets are of what the cutter is made of; those of its like may be of another edge.
  for (const bool of_its_like : {false, true}) {
    const auto* p = s == c.substrate ? stated_for(c, m, of_its_like, Wanted::kSpeed) : nullptr;
    if (p == nullptr) continue;
    out.vc_m_min = p->vc_m_min;
    out.source =
        (of_its_like ? "that of a cutter like it for " : "the tool's own for ") + p->material_group.text();
    // Where its speed counts a coating already ("1.7 (coated ..."), nothing comes on top.
    if (of_its_like && p->source.find("(coated") == std::string::npos) out.coated = coated;
    return out;
  }
  if (!(m.vc_hss_m_min > 0.0) && !(m.vc_carbide_m_min > 0.0)) return std::nullopt;
  out.vc_m_min = card;
  out.coated = coated;
  out.source = "the card of " + m.id + " for " + std::string(model::to_text(s));
  for (const model::ToolLifeLaw& l : m.life) {
    if (l.substrate != model::to_text(s) || !(l.life_min > 0.0) || !(l.v0_m_min > 0.0) || !(l.n > 0.0))
      continue;
    out.vc_m_min = l.v0_m_min;
    out.life_min = l.life_min;
    out.n = l.n;
    out.coated = 1.0;
    out.source = "the law of tool life of " + m.id;
    break;
  }
  return out;
}

bool substrate_assumed(const model::Cutter& c) {
  return std::any_of(c.sources.begin(), c.sources.end(),
                     [](const auto& s) { return s.first == "substrate" && s.second.starts_with("default"); });
}

/// Whether it is the whole diameter that cuts; of cones it is the part that is in (`spot_diameter`).
bool tells_speed(const model::Cutter& c) {
  if (cuts_by_point(c.cutter_class) || c.cutter_class == CutterClass::kTouchProbe) return false;
  return c.cutting_diameter_mm > 0.0;
}

/// Of a ball or bull nose that is not in with all of its radius, the widest circle that cuts on a level
/// floor; of a face mill with leaning edges, that where they leave the material.
double contact_diameter(const model::Cutter& c, double depth_mm) {
  const double d = c.cutting_diameter_mm;
  if (c.cutter_class == CutterClass::kFacemill && c.lead_angle_rad > 0.0)
    return d + 2.0 * std::max(0.0, depth_mm) * std::tan(c.lead_angle_rad);
  const double r = end_radius_of(c);
  if (!(r > 0.0) || !(depth_mm > 0.0) || depth_mm >= r) return d;
  return d - 2.0 * r + 2.0 * std::sqrt(depth_mm * (2.0 * r - depth_mm));
}

/// Of a cone that goes down to a stated depth, as spots and countersinks are made, the widest circle that
/// cuts: tip + 2 depth tan(point / 2); 0: not known.
double spot_diameter(const model::Plan& plan, const StepMoves& s) {
  const model::Cutter& c = *s.cutter;
  const auto* ws = plan.model.get<model::MachiningWorkingstep>(s.planned->step);
  if (ws == nullptr || !cuts_by_point(c.cutter_class) || !(c.point_angle_rad > 0.0)) return 0.0;
  const auto* spots = plan.model.get<model::CenterDrilling>(ws->its_operation);
  const auto* sinks = plan.model.get<model::CounterSinking>(ws->its_operation);
  const auto depth = spots != nullptr   ? spots->cutting_depth
                     : sinks != nullptr ? sinks->cutting_depth
                                        : std::optional<double>{};
  if (!depth || !(*depth > 0.0)) return 0.0;
  return std::min(c.cutting_diameter_mm,
                  c.tip_diameter_mm + 2.0 * *depth * std::tan(0.5 * c.point_angle_rad));
}

/// Cutting of one tool, in edges that it takes.
struct Edges {
  const StepMoves* first_worn = nullptr;  ///< the step in which its first edge is at its end
  double minutes = 0.0, edges = 0.0;
};

struct Turned {
  double rpm = 0.0, minutes = 0.0;
};

Turned turned(const StepMoves& s) {
  Turned out;
  for (const Move& m : s.moves) {
    const double length = length_of(m);
    if (m.kind == model::MoveKind::kRapid || !(m.feed_mm_min > 0.0) || length >= kUnknownHeightMm) continue;
    out.rpm = std::max(out.rpm, std::abs(m.spindle_rpm));
    out.minutes += length / m.feed_mm_min;
  }
  return out;
}

std::string speed_text(double vc) { return trimmed(vc, 1) + " m/min"; }

class Speed {
 public:
  /// `share` of the speed is what counts: edges are in the cut for shorter arcs than a table's.
  Speed(const model::Plan& plan, const StepMoves& s, double share, Findings& findings)
      : plan_(plan), s_(s), c_(*s.cutter), share_(share), out_(findings), cut_(turned(s)) {}

  /// Says what is wrong with the speed; else counts what the step takes of the tool's edge.
  void judge(Edges& worn) {
    if (!(cut_.rpm > 0.0)) return;
    const auto ref = reference_of(plan_.material, c_, c_.substrate);
    if (!ref) return;
    const bool told = judged(*ref);
    const double life = s_.planned->loads.tool_life_min;
    if (told || !(life > 0.0) || c_.life_min > 0.0) return;
    worn.minutes += cut_.minutes;
    worn.edges += cut_.minutes / life;
    if (worn.edges > 1.0 && worn.first_worn == nullptr) worn.first_worn = &s_;
  }

 private:
  bool judged(const Reference& ref) {
    const double level =
        tells_speed(c_) ? contact_diameter(c_, s_.planned->axial_depth_mm) : spot_diameter(plan_, s_);
    // On a steep surface a round nose touches up to its whole diameter, however thin the layer is.
    const double widest = level > 0.0 && freeform() ? c_.cutting_diameter_mm : level;
    vc_ = speed(widest);
    if (!(ref.vc_m_min > 0.0)) {
      not_for_it();
      return true;
    }
    if (!(widest > 0.0) || vc_ <= kFaster * ref.vc_m_min) return false;
    if (level < widest) {
      where_ = " on the tool's whole diameter, which a steep surface touches";
      if (gentle_enough(ref, speed(level))) return false;
    }
    tell(ref);
    return true;
  }

  [[nodiscard]] double speed(double diameter_mm) const {
    return std::numbers::pi * diameter_mm * cut_.rpm / 1000.0 * share_;
  }

  [[nodiscard]] bool freeform() const {
    const auto* ws = plan_.model.get<model::MachiningWorkingstep>(s_.planned->step);
    return ws != nullptr && (plan_.model.holds<model::FreeformFinishMilling>(ws->its_operation) ||
                             plan_.model.holds<model::FreeformRoughMilling>(ws->its_operation));
  }

  /// How steep the surface is that a round nose meets is not measured here. Where the plan predicts a usual
  /// life it was, but that is the plan's word: it counts only as far as the narrowest circle confirms it.
  [[nodiscard]] bool gentle_enough(const Reference& ref, double narrowest_m_min) const {
    const double most = kFaster * ref.vc_m_min;
    const double predicted = s_.planned->loads.tool_life_min;
    return narrowest_m_min <= most && predicted > ref.life_at(most) &&
           predicted <= ref.life_at(narrowest_m_min / kFaster);
  }

  /// Whether the step is right for carbide, where what the cutter is made of is only assumed.
  [[nodiscard]] std::optional<Reference> as_carbide() const {
    if (c_.substrate != Substrate::kHss || !substrate_assumed(c_)) return std::nullopt;
    return reference_of(plan_.material, c_, Substrate::kCarbide);
  }

  [[nodiscard]] bool too_short(const Reference& r) const {
    return !(r.vc_m_min > 0.0) || r.life_at(vc_ / (kCardShort * r.coated)) < cut_.minutes;
  }

  void not_for_it() {
    const auto carbide = as_carbide();
    const bool mild = carbide && !too_short(*carbide);
    const std::string text =
        plan_.material.id + " is not cut with " + std::string(model::to_text(c_.substrate)) +
        ": its card has no speed for it, and tool " + c_.id + " states none for this material" +
        (vc_ > 0.0 ? " (the step cuts at " + speed_text(vc_) + ")" : std::string());
    if (mild)
      out_.warn(16, "CHK-SPEED-MATERIAL", at(), text + "; that the tool is hss is only assumed: " + state());
    else
      out_.error(16, "CHK-SPEED-MATERIAL", at(),
                 text +
                     (carbide ? "; that the tool is hss is only assumed, and as carbide it would not last "
                                "its step either"
                              : std::string()) +
                     "; use a tool that is for it",
                 vc_);
  }

  void tell(const Reference& ref) {
    const auto carbide = as_carbide();
    const bool assumed = carbide && carbide->vc_m_min > 0.0;
    const Reference& by = assumed ? *carbide : ref;
    const double rpm = std::floor(cut_.rpm * ref.vc_m_min / vc_);
    std::string text = "an edge of " + c_.id + " lasts " + life_text(ref.life_at(vc_)) + " of the step's " +
                       trimmed(cut_.minutes, 2) + " min: " + speed_text(vc_) + where_ + by_arcs() + " in " +
                       plan_.material.id + ", at most " + speed_text(kFaster * ref.vc_m_min) + " (" +
                       plain(kFaster) + " times " + ref.source + ", " + speed_text(ref.vc_m_min) + ")";
    if (assumed && vc_ <= kFaster * carbide->vc_m_min) {
      text += "; that the tool is hss is only assumed, and carbide allows " + speed_text(carbide->vc_m_min) +
              ": " + state();
      return out_.warn(16, "CHK-SPEED-MATERIAL", at(), text, vc_);
    }
    if (assumed)
      text += "; that the tool is hss is only assumed, but carbide allows no more than " +
              speed_text(carbide->vc_m_min);
    const double slowest = plan_.machine.spindle.rpm_min;
    text += rpm < slowest ? "; use a tool that allows more: the spindle turns no slower than " +
                                plain(slowest) + " 1/min, where " + plain(rpm) + " are asked for"
                          : "; lower the spindle to " + plain(rpm) + " 1/min, or use a tool that allows more";
    if (too_short(by))
      out_.error(30, "CHK-EDGE-LIFE", at(), text, vc_);
    else
      out_.warn(16, "CHK-SPEED-MATERIAL", at(), text, vc_);
  }

  /// That the speed is one that counts, not the one that is turned at.
  [[nodiscard]] std::string by_arcs() const {
    constexpr double kTold = 0.995;
    return share_ < kTold ? " (by its arcs of contact; " + speed_text(vc_ / share_) + " are turned)" : "";
  }
  static std::string life_text(double minutes) {
    if (minutes >= 0.1) return trimmed(minutes, 1) + " min";
    return minutes >= 2e-3 ? trimmed(60.0 * minutes, 1) + " s" : "less than 0.1 s";
  }
  static std::string state() { return "state what it is made of"; }
  [[nodiscard]] Findings::Where at() const { return {s_.order + 1, s_.id, -1}; }

  const model::Plan& plan_;
  const StepMoves& s_;
  const model::Cutter& c_;
  double share_;
  Findings& out_;
  Turned cut_;
  double vc_ = 0.0;
  std::string where_;  ///< what of the tool that is the speed of, where it is not plain
};

/// The narrowest zone that is stated of a shape's sizes across; 0: none.
double zone_of(const volumes::Form& shape) {
  double zone = 0.0;
  for (const auto& t : {shape.width, shape.length, shape.diameter})
    if (t.given && t.width() > 0.0) zone = zone > 0.0 ? std::min(zone, t.width()) : t.width();
  return zone;
}

/// What the workpiece asks for where a size states nothing; 0: nothing.
double general_zone(const model::Plan& plan, model::AnyRef feature) {
  const auto* f = plan.model.get<model::ManufacturingFeature>(feature);
  const auto* piece = f == nullptr ? nullptr : plan.model.get<model::Workpiece>(f->its_workpiece);
  return piece == nullptr ? 0.0 : 2.0 * general_tolerance_of(*piece).value_or(0.0);
}

/// The narrowest zone that is stated of a feature's sizes across, else of the workpiece; 0: none. Which
/// element of a compound hole a step makes is not known here: the widest of them all, none where one has
/// none.
double zone_of(const model::Plan& plan, const PartShapes& part, model::AnyRef feature) {
  const double general = general_zone(plan, feature);
  const auto* e = part.find(feature);
  if (e == nullptr || e->shapes.empty()) return general;
  const bool compound = e->shapes.size() > 1 && e->shapes.front().kind == model::ShapeKind::kHole;
  double least = 0.0, most = 0.0;
  for (const volumes::Form& shape : e->shapes) {
    const double stated = zone_of(shape);
    const double zone = stated > 0.0 ? stated : general;
    if (!(zone > 0.0) && compound) return 0.0;
    most = std::max(most, zone);
    if (stated > 0.0) least = least > 0.0 ? std::min(least, stated) : stated;
  }
  if (compound) return most;
  return least > 0.0 ? least : general;
}

double youngs_modulus(const model::Cutter& c) {
  return c.substrate == Substrate::kHss ? mechanics::kHssYoungsModulusNMm2
                                        : mechanics::kCarbideYoungsModulusNMm2;
}

/// Of a bar that is loaded at its end: 3 E d bent / (2 L^2), N/mm2; 0: its length is not known.
double bending_stress(const model::Cutter& c, double bent_mm) {
  if (!(c.stick_out_mm > 0.0)) return 0.0;
  return 1.5 * youngs_modulus(c) * c.cutting_diameter_mm * bent_mm / (c.stick_out_mm * c.stick_out_mm);
}

/// Of flutes that are loaded at their end, in their outer fibre, N/mm2; 0: their length is not known. They
/// bend like a cylinder of kFluteEquivalentDiameterRatio of the diameter.
double flute_stress(const model::Cutter& c, double force_n) {
  const double lever = std::min(c.maximum_depth_of_cut_mm, c.stick_out_mm);
  const double thick = mechanics::kFluteEquivalentDiameterRatio * c.cutting_diameter_mm;
  const double inertia = std::numbers::pi * std::pow(thick, 4) / 64.0;
  return lever > 0.0 ? force_n * lever * 0.5 * c.cutting_diameter_mm / inertia : 0.0;
}

/// The largest stress of a tool that is loaded at its tip, N/mm2, and the part of the tool that carries it.
struct Weakest {
  double stress_n_mm2;
  const char* part;
};

/// Of flutes, neck and shank, each where it is held: the stress of a round bar is 32 F L / (pi d^3), L from
/// the tip. What a longer part hides is none.
Weakest weakest(const model::Cutter& c, double force_n) {
  Weakest out{flute_stress(c, force_n), "flutes"};
  double from = std::min(c.maximum_depth_of_cut_mm, c.stick_out_mm);
  const auto bar = [&](const char* part, double diameter_mm, double to_mm) {
    const double lever = std::min(to_mm, c.stick_out_mm);
    if (!(diameter_mm > 0.0) || lever <= from) return;
    from = lever;
    const double stress = 32.0 * force_n * lever / (std::numbers::pi * std::pow(diameter_mm, 3));
    if (stress > out.stress_n_mm2) out = {stress, part};
  };
  bar("neck", c.neck_diameter_mm, c.neck_length_mm);
  bar("shank", c.shank_diameter_mm, c.stick_out_mm);
  return out;
}

double endurance(const model::Cutter& c) {
  return c.substrate == Substrate::kCarbide ? mechanics::kCarbideEnduranceNMm2 : mechanics::kHssEnduranceNMm2;
}

/// What the operation leaves on the walls, mm; 0: nothing, or it is not one that does.
double left_on_walls(const model::Plan& plan, const model::MachiningWorkingstep* ws) {
  if (ws == nullptr) return 0.0;
  if (const auto* o = plan.model.get<model::BottomAndSideMilling>(ws->its_operation))
    return o->allowance_side.value_or(0.0);
  if (const auto* o = plan.model.get<model::SideMilling>(ws->its_operation))
    return o->allowance_side.value_or(0.0);
  return 0.0;
}

/// How far into what a step leaves its tool may bend, mm: the next pass must find what it can cut at all, but
/// a thin allowance may be used by half.
double into_left(const model::Plan& plan, const model::Cutter& c, double left_mm) {
  const double next = mechanics::least_depth_mm(c.cutting_diameter_mm, c.substrate == Substrate::kHss,
                                                plan.material.iso_group);
  return std::min(kMostIntoLeftMm, std::max(0.5 * left_mm, left_mm - next));
}

void judge_bending(const model::Plan& plan, const PartShapes& part, const StepMoves& s, Findings& findings) {
  const model::StepLoads& l = s.planned->loads;
  const model::Cutter& c = *s.cutter;
  const Findings::Where at{s.order + 1, s.id, -1};
  const std::string load = " at the largest load that the plan reckons with (" + plain(l.peak_force_n) +
                           " N, " + plain(l.force_margin) + " times the expected one)";
  // A face mill's body is no bar.
  const bool mills = !works_along_axis(c) && c.cutter_class != CutterClass::kFacemill;
  const char* stiffer = ": cut less deep or less wide, feed slower, or use a stiffer or shorter cutter";
  // No tool endures that, whatever it does to the wall.
  const double stress = mills ? bending_stress(c, l.deflection_mm) : 0.0;
  if (stress > kBreakingNMm2) {
    findings.error(21, "CHK-BENDING", at,
                   "tool " + c.id + " bends by " + mm(l.deflection_mm) + load + ", which is a stress of " +
                       trimmed(stress, 0) + " N/mm2 in its shank; it breaks at " + trimmed(kBreakingNMm2, 0) +
                       stiffer,
                   l.deflection_mm);
  }
  const double wall = std::abs(l.wall_error_mm);
  const auto* ws = plan.model.get<model::MachiningWorkingstep>(s.planned->step);
  const double zone = wall > 0.0 && ws != nullptr ? zone_of(plan, part, ws->its_feature) : 0.0;
  if (zone > 0.0) {
    const std::string what = "tool " + c.id + " is pushed " + mm(wall) + " off the wall" + load + "; ";
    const char* todo = ": feed slower, leave less, or use a stiffer or shorter cutter";
    if (wall <= kModelErrorMm) return;
    if (wall > kWallOfZone * zone)
      findings.error(21, "CHK-WALL-ERROR", at,
                     what + "of a tolerance of " + mm(zone) + " in all, " + mm(kWallOfZone * zone) +
                         " is the most that one wall may be off" + todo,
                     wall);
    else if (wall > kMeasured * kBothOfZone * zone)
      findings.warn(21, "CHK-WALL-ERROR", at,
                    what + "two walls together leave a tolerance of " + mm(zone) + " from " +
                        mm(kBothOfZone * zone) + " each on" + todo,
                    wall);
    return;
  }
  // What no tolerance judges is held against what the step leaves on its walls: bent by all of it, a tool
  // reaches the finished wall. And a tool that bends by less than that may still be bent too often.
  const double bent = std::max(l.deflection_mm, wall);
  if (stress > kBreakingNMm2 || !mills) return;
  const double left = left_on_walls(plan, ws);
  const double bears = left > 0.0 ? into_left(plan, c, left) : kMostBentMm;
  const Weakest tires = weakest(c, l.peak_force_n);
  if (bent > kMeasured * bears)
    findings.warn(21, "CHK-BENDING", at,
                  "tool " + c.id + " bends by " + mm(bent) + load + "; at most " + mm(bears) +
                      (left > 0.0 ? " of the " + mm(left) + " that it leaves on its walls" : "") + stiffer,
                  bent);
  else if (tires.stress_n_mm2 > kMeasured * endurance(c))
    findings.warn(21, "CHK-BENDING", at,
                  "tool " + c.id + " has a stress of " + trimmed(tires.stress_n_mm2, 0) + " N/mm2 in its " +
                      tires.part + load + "; the limit for all the bites of its life is " +
                      trimmed(endurance(c), 0) + stiffer,
                  tires.stress_n_mm2);
}

}  // namespace

void check_predicted(const model::Plan& plan, const PartShapes& part, const std::vector<StepMoves>& steps,
                     const std::vector<double>& speed_shares, Findings& findings) {
  std::map<std::string, Edges> worn;
  for (std::size_t i = 0; i < steps.size(); ++i) {
    const StepMoves& s = steps[i];
    if (s.planned == nullptr || s.cutter == nullptr || !(s.cutter->cutting_diameter_mm > 0.0)) continue;
    if (s.cutter->cutter_class == CutterClass::kTouchProbe) continue;
    Speed(plan, s, i < speed_shares.size() ? speed_shares[i] : 1.0, findings).judge(worn[s.cutter->id]);
    judge_bending(plan, part, s, findings);
  }
  for (const auto& [id, w] : worn) {
    if (w.first_worn == nullptr) continue;
    const Findings::Where at{w.first_worn->order + 1, w.first_worn->id, -1};
    const std::string text =
        "tool " + id + " wears out in this step: it cuts " + trimmed(w.minutes, 1) +
        " min in all, and at these speeds an edge lasts " + trimmed(w.minutes / w.edges, 1) +
        " min; it takes " + trimmed(std::ceil(w.edges - 1e-9), 0) +
        " edges: load sister tools, or change the edge at a stop; state its life_min where it "
        "is known";
    if (w.edges > kSurelyWorn)
      findings.warn(30, "CHK-EDGES", at, text);
    else
      findings.note(30, "CHK-EDGES", at, text);
  }
}

}  // namespace capstan::verify
