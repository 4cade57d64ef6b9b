#include "rules/facts/facts.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "planner/ground/base/number.h"
#include "planner/ground/vocabulary/unit_factors.h"
#include "planner/model/features/in_piece.h"
#include "rules/facts/it_grade.h"

namespace capstan::rules {
namespace {

using model::FeatureShape;
using model::HoleBottom;
using model::ShapeKind;
using model::Toleranced;

constexpr double kAngleMatch = 1.0;  // degrees within which an angle counts as a standard tool's

bool near_any(double value, std::initializer_list<double> standard) {
  return std::any_of(standard.begin(), standard.end(),
                     [&](double s) { return std::abs(value - s) <= kAngleMatch; });
}

// Full angles of countersinks: ISO 3294 (60, 90, 120) and the inch 82, 100.
bool is_countersink_angle(double deg) { return near_any(deg, {60.0, 82.0, 90.0, 100.0, 120.0}); }
// Full point angles of twist drills: 118 (type N), 130, 135, 140; files round them to 120 at times.
bool is_drill_angle(double deg) { return near_any(deg, {118.0, 120.0, 130.0, 135.0, 140.0}); }

std::string_view group_of(const model::WorkMaterial& m) {
  static constexpr std::array<std::string_view, 6> kGroups{"P", "M", "K", "N", "S", "H"};
  const auto it = std::find(kGroups.begin(), kGroups.end(), m.iso_group.substr(0, 1));
  return it == kGroups.end() ? "unknown" : *it;
}

// ISO 286 speaks of sizes above 0 only; a depth of 0.2 mm is read in the smallest range.
int grade(const Toleranced& t) { return grade_of_width(std::max(t.nominal_mm, 1e-3), t.width()); }

std::string_view symbol_of(HoleBottom b) {
  switch (b) {
    case HoleBottom::kThrough:
      return "through";
    case HoleBottom::kFlat:
      return "flat";
    case HoleBottom::kFlatWithRadius:
      return "flat_with_radius";
    case HoleBottom::kConical:
      return "conical";
    case HoleBottom::kSpherical:
      return "spherical";
  }
  return "flat";
}

std::string_view taper_of(const FeatureShape& s) {
  const double narrowing = s.diameter.nominal_mm - s.bottom_diameter_mm;
  if (!(s.bottom_diameter_mm > 0.0) || std::abs(narrowing) < 1e-6) return "none";
  const double angle = 2.0 * std::atan(0.5 * narrowing / s.depth_mm) / kRadPerDegree;
  if (is_countersink_angle(-angle)) return "countersink_below";
  return is_countersink_angle(angle) ? "countersink" : "other";
}

// Beyond this a value is as good as not asked: the domain ends there.
constexpr double kNotAsked = 1000.0;
constexpr double kUnknownLength = 10000.0;

double asked(std::optional<double> v) { return v && *v >= 0.0 ? std::min(*v, kNotAsked) : kNotAsked; }
double least(std::initializer_list<std::optional<double>> values) {
  double out = kNotAsked;
  for (const auto& v : values) out = std::min(out, asked(v));
  return out;
}
double ratio(double a, double b, double most) { return b > 0.0 ? std::clamp(a / b, 0.0, most) : 0.0; }

/// The symbol of a shape; a countersink has one of its own.
std::string_view shape_symbol(const FeatureShape& s) {
  if (s.kind == ShapeKind::kHole && taper_of(s).starts_with("countersink")) return "countersink";
  return model::to_text(s.kind);
}

// Sets facts that do not depend on the kind of feature: requirements, surroundings, abilities of the machine.
void surroundings(const FeatureShape& s, const Context& c, Facts& f) {
  const model::Quality& q = c.quality;
  f.set("shape", shape_symbol(s));
  f.set("ra_um", asked(q.ra_um));
  f.set("position_mm", asked(q.location_mm));
  f.set("form_mm", least({q.form_mm, q.orientation_mm, q.runout_mm, q.profile_mm}));
  const double wall = c.wall_thickness_mm.value_or(0.0);
  const double floor = c.floor_thickness_mm.value_or(0.0);
  f.set("wall_thickness_mm", wall > 0.0 ? std::min(wall, kUnknownLength) : kUnknownLength);
  f.set("floor_thickness_mm", floor > 0.0 ? std::min(floor, kUnknownLength) : kUnknownLength);
  f.set("wall_ratio", ratio(s.depth_mm, wall, kUnknownLength));
  f.set("floor_ratio", 0.0);
  f.set("hardness_hb", std::clamp(c.material.hardness_hb, 0.0, 2000.0));
  f.set("rigid_tapping", c.abilities.rigid_tapping ? "yes" : "no");
  f.set("through_coolant", c.has_through_coolant ? "yes" : "no");
  f.set("probe", c.abilities.probe ? "yes" : "no");
  f.set("batch", std::clamp(c.batch, 1, 1000000));
  f.set("edge_break_mm", std::clamp(c.edge_break_mm, 0.0, 999.0));
}

std::string_view point_of(const FeatureShape& s) {
  if (s.bottom != HoleBottom::kConical) return "none";
  const double angle = 180.0 - 2.0 * s.bottom_angle_rad / kRadPerDegree;
  // 120 degrees is both: a drill is cheaper.
  return is_drill_angle(angle) ? "drill" : is_countersink_angle(angle) ? "countersink" : "other";
}

// A standard H7 reamer makes [nominal, nominal + IT7]: it fits when that lies within the tolerance.
std::string_view reamer_of(const Toleranced& t) {
  const double h7 = standard_tolerance_mm(7, t.nominal_mm);
  const bool inside = h7 > 0.0 && t.lower_mm <= 1e-9 && t.upper_mm >= h7 - 1e-9;
  return inside && is_reamer_size(t.nominal_mm) ? "fits" : "none";
}

/// Half the general tolerance of a size, mm; nothing if none is stated.
std::optional<double> general_of(const Toleranced& t, const Context& c) {
  if (c.general) {
    if (const auto half = model::general_size(*c.general, t.nominal_mm)) return half;
  }
  return c.global_tolerance_mm;
}

void note_general(const Toleranced& t, const Context& c, const char* what, std::string& notes) {
  if (t.given) return;
  notes += std::string("no tolerance of the ") + what + " stated, taken as ";
  if (const auto half = general_of(t, c)) {
    notes += "the part's general +-" + trimmed(*half, 4) + " mm" +
             (c.general ? " (" + c.general->text + "); " : "; ");
    return;
  }
  notes += "IT" + std::to_string(c.general_grade) + " (default, unsourced); ";
}

void hole_facts(const FeatureShape& s, const Context& c, FeatureFacts& out) {
  out.diameter = tolerance_or_general(s.diameter, c);
  note_general(s.diameter, c, "diameter", out.notes);
  const double d = out.diameter.nominal_mm;
  out.facts.set("diameter_mm", d);
  out.facts.set("it_grade", grade(out.diameter));
  out.facts.set("depth_ratio", d > 0.0 ? (s.depth_mm + c.stock_above_mm) / d : 0.0);
  out.facts.set("bottom", symbol_of(s.bottom));
  out.facts.set("taper", taper_of(s));
  out.facts.set("point", point_of(s));
  out.facts.set("reamer", reamer_of(out.diameter));
  const bool core = c.core_diameter_mm > 0.0 && c.core_diameter_mm < d - 1e-6;
  out.facts.set("core", c.core_above ? "above" : core ? "hole" : "none");
}

void thread_facts(const FeatureShape& s, const Context& c, Facts& out) {
  out.set("thread_hand", s.thread_left_hand ? "left" : "right");
  out.set("thread_major_mm", s.thread_major_mm);
  const double hole = c.core_depth_mm > 0.0 ? c.core_depth_mm : s.depth_mm;
  const double below = s.thread_pitch_mm > 0.0 ? (hole - s.thread_depth_mm) / s.thread_pitch_mm : 0.0;
  out.set("thread_runout_pitches", s.through ? 10000.0 : std::clamp(below, 0.0, 9999.0));
}

int tightest_grade(const FeatureShape& s, const Context& c, FeatureFacts& out) {
  int best = 99;
  for (const Toleranced* t : {&s.width, &s.length}) {
    if (t->nominal_mm > 0.0 && t->given) best = std::min(best, grade(*t));
  }
  if (best < 99) return best;
  Toleranced any = s.width;
  if (!(any.nominal_mm > 0.0)) any.nominal_mm = std::max(out.passage.widest_mm, 1.0);
  note_general(any, c, "outline", out.notes);
  return grade(tolerance_or_general(any, c));
}

// Half widths that shrink upwards: at once (a tee's head under its neck), or evenly (a dovetail).
std::string_view undercut_form(const std::vector<geometry::Vec2>& q) {
  constexpr double kSame = 1e-6;
  int steps = 0, slopes = 0;
  for (std::size_t i = 1; i < q.size(); ++i) {
    if (q[i].y > q[i - 1].y + kSame && q[i].x > kSame) return "other";  // wider again above
    if (q[i].y >= q[i - 1].y - kSame) continue;
    ++(q[i].x > q[i - 1].x + kSame ? slopes : steps);
  }
  if (steps == 1 && slopes == 0) return "tee";
  // A dovetail cutter's flank begins at its floor.
  if (q.size() > 1 && std::abs(q[1].y - q[0].y) <= kSame) return "other";
  return steps == 0 && slopes == 1 ? "dovetail" : "other";
}

std::string_view slot_form(const FeatureShape& s) {
  if (s.slot_profile.empty()) return "square";
  if (s.slot_angle_rad > 0.0) return s.slot_bottom_radius_mm > 0.0 ? "radiused_vee" : "vee";
  if (s.slot_bottom_radius_mm <= 0.0) return undercut_form(s.slot_profile);
  return std::abs(2.0 * s.slot_bottom_radius_mm - s.width.nominal_mm) < 1e-6 ? "round" : "other";
}

void area_facts(const FeatureShape& s, const Context& c, FeatureFacts& out) {
  geometry::Region free = s.reach.empty() ? s.area : s.reach, wanted = s.area;
  for (const auto& island : s.islands) {
    free = geometry::subtract(free, island.area);
    wanted = geometry::subtract(wanted, island.area);
  }
  const bool corners_drawn = !s.open || s.kind == ShapeKind::kPocket;
  out.passage = passage_of(free, corners_drawn && !(s.corner_radius_mm > 0.0), wanted);
  out.facts.set("passage_mm", out.passage.narrowest_mm);
  // A face's depth is a removal, not a size: only its texture, flatness and position bring a grade.
  out.facts.set("it_grade", s.kind == ShapeKind::kFace ? 18 : tightest_grade(s, c, out));
  out.facts.set("access", s.open ? "open" : "closed");
  if (s.kind == ShapeKind::kFace) out.facts.set("sides", model::stops_at_walls(s) ? "wall" : "free");
  out.facts.set("wall", std::abs(s.slope_rad) > 1e-6 ? "drafted" : "upright");
  out.facts.set("floor", s.through ? "open" : "closed");
  out.facts.set("floor_edge", model::largest_fillet_mm(s) > 0.0 ? "rounded" : "sharp");
  const double across = out.passage.narrowest_mm;
  const double corner = s.corner_radius_mm > 0.0 ? s.corner_radius_mm : 0.5 * out.passage.exact_mm;
  const bool corners = corner > 0.0 && s.kind != ShapeKind::kFace && s.kind != ShapeKind::kOutside;
  out.facts.set("corner_radius_mm", corners ? std::min(corner, kUnknownLength) : kUnknownLength);
  out.facts.set("corner_ratio", corners && across > 0.0 ? ratio(2.0 * corner, across, kNotAsked) : kNotAsked);
  out.facts.set("slenderness",
                corners ? ratio(s.depth_mm, std::min(2.0 * corner, across), kUnknownLength) : 0.0);
  if (!s.through && c.floor_thickness_mm)
    out.facts.set("floor_ratio", ratio(out.passage.widest_mm, *c.floor_thickness_mm, kUnknownLength));
  out.facts.set("depth_ratio", across > 0.0 ? s.depth_mm / across : 9999.0);
  if (model::has(s.kind, model::ShapeTrait::kSwept)) {
    out.facts.set("slot_form", slot_form(s));
    out.facts.set("slot_angle_deg", s.slot_angle_rad / kRadPerDegree);
  }
}

}  // namespace

Toleranced tolerance_or_general(const Toleranced& t, const Context& c) {
  if (t.given) return t;  // also one without a width: no chain holds it, and the rules say so
  Toleranced out = t;
  const double half =
      general_of(t, c).value_or(0.5 * standard_tolerance_mm(c.general_grade, std::max(t.nominal_mm, 1e-3)));
  out.lower_mm = -half;
  out.upper_mm = half;
  return out;
}

bool is_reamer_size(double d) {
  const auto multiple = [&](double step) { return std::abs(d / step - std::round(d / step)) * step < 1e-6; };
  if (d < 1.0 - 1e-9 || d > 50.0 + 1e-9) return false;
  return multiple(d <= 20.0 ? 0.5 : d <= 32.0 ? 1.0 : 2.0) || (d > 32.0 && multiple(5.0));
}

FeatureFacts facts_of(const FeatureShape& s, const Context& c) {
  FeatureFacts out;
  Facts& f = out.facts;
  f.set("depth_mm", s.depth_mm);
  f.set("material_group", group_of(c.material));
  surroundings(s, c, f);
  const Toleranced depth = [&] {
    Toleranced t = s.depth_tolerance;
    t.nominal_mm = s.depth_mm;
    return tolerance_or_general(t, c);
  }();
  f.set("depth_it_grade", grade(depth));
  using model::ShapeTrait;
  if (s.kind == ShapeKind::kHole) {
    hole_facts(s, c, out);
  } else if (s.kind == ShapeKind::kThread) {
    thread_facts(s, c, f);
  } else if (s.kind == ShapeKind::kChamfer) {
    f.set("chamfer_angle_deg", s.chamfer_angle_rad / kRadPerDegree);
  } else if (s.kind == ShapeKind::kEdgeRound) {
    f.set("round_radius_mm", s.round_radius_mm);
  } else if (model::has(s.kind, ShapeTrait::kClears)) {
    area_facts(s, c, out);
  } else if (model::has(s.kind, ShapeTrait::kSurface)) {
    f.set("surface_radius_mm", c.surface_radius_mm);
    f.set("surface_form", !c.surface_walls ? "curved" : c.surface_curved ? "walls" : "prismatic");
    f.set("wall_ratio", std::clamp(c.surface_wall_ratio, 0.0, kUnknownLength));
    f.set("floor_ratio", std::clamp(c.surface_floor_ratio, 0.0, kUnknownLength));
  }
  return out;
}

}  // namespace capstan::rules
