#include "planner/optimise/cut.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "planner/base/number.h"
#include "planner/mechanics/constants.h"
#include "planner/mechanics/drilling.h"
#include "planner/mechanics/loads.h"
#include "planner/mechanics/spindle.h"

namespace capstan::optimise {
namespace {

using std::numbers::pi;

bool is_milling(CutKind k) { return k == CutKind::kRough || k == CutKind::kFinish; }

/// How much larger a force may be than the coefficients say: their spread, and a worn edge.
double force_margin(const CutQuestion& q) {
  return std::max(mechanics::kForceUncertaintyFactor, 1.0 + q.material.kc_uncertainty) *
         mechanics::kWearForceFactor;
}

double efficiency(const CutQuestion& q) {
  const double e = q.machine.spindle.efficiency;
  return e > 0.0 && e < 1.0 ? e : mechanics::kDefaultSpindleEfficiency;
}

/// What the motor gives at a speed; nothing when the machine states no curve or the speed lies outside it.
std::optional<mechanics::SpindleCapacity> capacity(const CutQuestion& q, double n_rpm) {
  if (q.machine.spindle.curve.empty()) return std::nullopt;
  std::vector<mechanics::SpindlePoint> points;
  for (const auto& p : q.machine.spindle.curve) points.push_back({p.rpm, p.power_w, p.torque_nm});
  const auto curve = mechanics::SpindleCurve::make(std::move(points));
  if (!curve) return std::nullopt;
  const auto c = curve->at(std::clamp(n_rpm, curve->min_rpm(), curve->max_rpm()));
  if (!c) return std::nullopt;
  return *c;
}

double deflection_limit(const CutQuestion& q) {
  return q.deflection_limit_mm > 0.0 ? q.deflection_limit_mm : kRoughDeflectionMm;
}

mechanics::ToolStiffness stiffness(const model::Cutter& c) {
  const double e = c.substrate == model::Substrate::kCarbide ? mechanics::kCarbideYoungsModulusNMm2
                                                             : mechanics::kHssYoungsModulusNMm2;
  const double out =
      c.stick_out_mm > 0.0 ? c.stick_out_mm : std::max(c.usable_length_mm, 3.0 * c.cutting_diameter_mm);
  const double shank = c.shank_diameter_mm > 0.0 ? c.shank_diameter_mm : c.cutting_diameter_mm;
  const double flute = c.maximum_depth_of_cut_mm > 0.0 ? std::min(c.maximum_depth_of_cut_mm, out) : out;
  return {out, shank, flute, c.cutting_diameter_mm, e};
}

int teeth(const CutQuestion& q) { return std::max(1, q.cutter.teeth); }

double feed_limit(const CutQuestion& q, bool axial) {
  const auto& a = q.machine.axes;
  return axial ? a[2].feed_max_mm_min : std::min(a[0].feed_max_mm_min, a[1].feed_max_mm_min);
}

struct Range {
  double lo = 0.0, hi = 0.0;
};
Range speeds(const CutQuestion& q) {
  Range r{std::max(1.0, q.machine.spindle.rpm_min), q.machine.spindle.rpm_max};
  if (q.cutter.maximum_speed_rpm > 0.0) r.hi = std::min(r.hi, q.cutter.maximum_speed_rpm);
  return r;
}

double largest_fz(const CutQuestion& q) {
  double fz = q.fz_start_mm;
  // The start value is what is planned for; the cutter's largest must hold with the override, too.
  if (q.cutter.fz_max_mm > 0.0) fz = std::min(fz, q.cutter.fz_max_mm / feed_override(q));
  return fz;
}

/// Time per volume (milling) or per depth (drilling), and for cost the edge that it uses up.
double objective(const CutQuestion& q, double ap, double ae, double n, double feed) {
  const double rate = is_milling(q.kind) ? ap * ae * feed : feed;
  double per_minute = 1.0;
  if (q.aim == Aim::kCost) {
    const double taylor = q.cutter.substrate == model::Substrate::kCarbide ? kTaylorCarbide : kTaylorHss;
    const double vc = pi * q.cutter.cutting_diameter_mm * n / 1000.0;
    const double life_at_table = q.cutter.life_min > 0.0 ? q.cutter.life_min : kLifeAtTableSpeedMin;
    const double life = life_at_table * std::pow(q.vc_start_m_min / vc, 1.0 / taylor);
    // 60 per hour where the machine states no rate: default, unsourced.
    const double hour = q.machine.cost_per_hour > 0.0 ? q.machine.cost_per_hour : 60.0;
    per_minute = hour / 60.0 + (q.cutter.price + hour / 60.0 * q.machine.tool_change_s / 60.0) / life;
  }
  return per_minute / rate;
}

struct Limit {
  const char* name;
  const char* unit;
};
constexpr std::array<Limit, 8> kLimits = {{{"spindle_power", "W"},
                                           {"spindle_torque", "Nm"},
                                           {"tool_deflection", "mm"},
                                           {"chip_thickness", "mm"},
                                           {"spindle_speed_least", "1/min"},
                                           {"spindle_speed_most", "1/min"},
                                           {"axis_feed", "mm/min"},
                                           {"cutting_length", "mm"}}};

/// Loads against limits at one point, as (value, limit) in the order of kLimits.
using Measured = std::array<std::pair<double, double>, kLimits.size()>;

Measured measure(const CutQuestion& q, const model::StepLoads& l, double ap, double n, double feed) {
  const auto power = capacity(q, n);
  const Range rpm = speeds(q);
  constexpr double kNone = 1e12;  // a limit that the machine does not state
  return {
      {{l.power_w, power ? power->power_w * efficiency(q) : kNone},
       {l.torque_nm, power ? power->torque_nm * efficiency(q) : kNone},
       {l.deflection_mm, is_milling(q.kind) ? deflection_limit(q) : kNone},
       {l.chip_thickness_mm, is_milling(q.kind) ? largest_fz(q) : kNone},
       {rpm.lo, n},
       {n, rpm.hi},
       {feed, feed_limit(q, !is_milling(q.kind))},
       {ap, is_milling(q.kind) && q.cutter.maximum_depth_of_cut_mm > 0.0 ? q.cutter.maximum_depth_of_cut_mm
                                                                         : kNone}}};
}

std::string unit_of(const std::string& name) {
  for (const Limit& l : kLimits) {
    if (name == l.name) return l.unit;
  }
  return "";
}

/// The point behind a solver's variables.
struct Point {
  double ap = 0.0, ae = 0.0, n = 0.0, feed = 0.0;
};

class Search {
 public:
  Search(const CutQuestion& q, double ap_mm) : q_(q), ap_(ap_mm) {
    const double d = q.cutter.cutting_diameter_mm;
    const double n_table = 1000.0 * q.vc_start_m_min / (pi * d);
    const Range rpm = speeds(q);
    if (q.n_rpm) {
      n_fixed_ = *q.n_rpm;
    } else {
      const double most = std::max(std::min(n_table, rpm.hi), rpm.lo);
      add("cutting_speed", "m/min", pi * d * std::max(rpm.lo, 0.25 * most) / 1000.0, pi * d * most / 1000.0);
    }
    if (q.feed_mm_min) {
      feed_fixed_ = *q.feed_mm_min;
    } else if (q.fz_mm) {
      fz_fixed_ = *q.fz_mm;
    } else if (q.kind == CutKind::kTap) {
      fz_fixed_ = q.cutter.thread_pitch_mm / teeth(q);
    } else {
      // A thin cut may advance faster for the same chip; chip_thickness is what holds it.
      const double most = largest_fz(q) * (is_milling(q.kind) ? 3.0 : 1.0);
      const double capped =
          q.cutter.fz_max_mm > 0.0 ? std::min(most, q.cutter.fz_max_mm / feed_override(q)) : most;
      add("feed_per_tooth", "mm", q.least_feed_ratio * largest_fz(q), capped);
    }
    if (!is_milling(q.kind)) return;
    const double widest = q.width_mm > 0.0 ? std::min(q.width_mm, d) : d;
    if (q.ae_mm) {
      ae_fixed_ = std::min(*q.ae_mm, d);
    } else if (q.kind == CutKind::kFinish || q.slot) {
      ae_fixed_ = q.kind == CutKind::kFinish ? widest : d;
    } else {
      add("radial_cutting_depth", "mm", 0.1 * std::min(widest, d), std::min(widest, kRoughWidthRatio * d));
    }
  }

  [[nodiscard]] Point at(std::span<const double> x) const {
    std::size_t i = 0;
    Point p;
    p.ap = ap_;
    p.n = n_fixed_ ? *n_fixed_ : 1000.0 * x[i++] / (pi * q_.cutter.cutting_diameter_mm);
    if (feed_fixed_) {
      p.feed = *feed_fixed_;
    } else {
      const double fz = fz_fixed_ ? *fz_fixed_ : x[i++];
      p.feed = fz * teeth(q_) * p.n;
    }
    if (is_milling(q_.kind)) p.ae = ae_fixed_ ? *ae_fixed_ : x[i++];
    return p;
  }

  [[nodiscard]] const std::vector<Variable>& variables() const { return variables_; }
  [[nodiscard]] bool fixed() const { return variables_.empty(); }

  [[nodiscard]] Problem problem() const {
    Problem p;
    p.variables = variables_;
    for (const Limit& l : kLimits) p.constraints.emplace_back(l.name);
    // The scale makes the objective about one, as the solvers like it.
    std::vector<double> start;
    for (const Variable& v : variables_) start.push_back(v.start);
    const Point s = at(start);
    const double scale = objective(q_, s.ap, s.ae, s.n, s.feed);
    p.model = central_differences(
        [this, scale](std::span<const double> x, double& f, std::span<double> c) {
          const Point at_x = at(x);
          f = objective(q_, at_x.ap, at_x.ae, at_x.n, at_x.feed) / scale;
          const auto loads = loads_of(q_, at_x.ap, at_x.ae, at_x.n, at_x.feed);
          const auto m = measure(q_, loads.value_or(model::StepLoads{}), at_x.ap, at_x.n, at_x.feed);
          for (std::size_t i = 0; i < m.size(); ++i) c[i] = loads ? m[i].first / m[i].second - 1.0 : 1.0;
        },
        variables_);
    return p;
  }

 private:
  void add(const char* name, const char* unit, double lo, double hi) {
    const double low = std::min(lo, hi);
    variables_.push_back({name, unit, low, hi, std::sqrt(low * hi), Walk::kLogarithmic});
  }

  const CutQuestion& q_;
  double ap_;
  std::optional<double> n_fixed_, feed_fixed_, fz_fixed_, ae_fixed_;
  std::vector<Variable> variables_;
};

double floor_to(double v, double step) { return std::floor(v / step + 1e-9) * step; }

void finish_answer(const CutQuestion& q, const Point& p, CutAnswer& a) {
  a.ap_mm = p.ap;
  a.ae_mm = q.ae_mm || q.kind == CutKind::kFinish ? p.ae : rounded(floor_to(p.ae, 0.001), 3);
  a.n_rpm = q.n_rpm ? *q.n_rpm : std::max(floor_to(p.n, 1.0), std::ceil(speeds(q).lo));
  const double per_rev = p.feed / p.n;
  a.feed_mm_min = q.feed_mm_min ? *q.feed_mm_min : per_rev * a.n_rpm;
  if (!q.feed_mm_min && q.kind != CutKind::kTap) {
    a.feed_mm_min =
        a.feed_mm_min >= 20.0 ? floor_to(a.feed_mm_min, 1.0) : rounded(floor_to(a.feed_mm_min, 0.1), 1);
  }
  a.fz_mm = a.feed_mm_min / (a.n_rpm * teeth(q));
  a.vc_m_min = pi * q.cutter.cutting_diameter_mm * a.n_rpm / 1000.0;
  const auto loads = loads_of(q, a.ap_mm, a.ae_mm, a.n_rpm, a.feed_mm_min);
  if (loads) a.loads = *loads;
  const auto m = measure(q, a.loads, a.ap_mm, a.n_rpm, a.feed_mm_min);
  a.feasible = loads.has_value();
  constexpr double kRounding = 1e-6;
  for (std::size_t i = 0; i < m.size(); ++i) {
    if (m[i].first <= m[i].second * (1.0 + kRounding)) continue;
    a.feasible = false;
    a.violated.push_back(std::string(kLimits[i].name) + ": " + trimmed(m[i].first, 4) + " against " +
                         trimmed(m[i].second, 4) + " " + kLimits[i].unit);
  }
  if (!loads) a.violated.emplace_back("the cut lies outside the range of the force formulas");
}

void take_active(const CutQuestion& q, const Solution& s, CutAnswer& a) {
  const auto m = measure(q, a.loads, a.ap_mm, a.n_rpm, a.feed_mm_min);
  for (const ActiveLimit& l : s.active) {
    model::ActiveConstraint c;
    c.name = l.name;
    c.unit = unit_of(l.name);
    if (l.kind == ActiveLimit::Kind::kConstraint) {
      for (std::size_t i = 0; i < kLimits.size(); ++i) {
        if (l.name == kLimits[i].name) {
          c.value = m[i].first;
          c.limit = m[i].second;
        }
      }
      c.shadow_price = 0.01 * l.multiplier / s.objective;
    } else {
      c.value = c.limit = l.value;
      if (l.name == "cutting_speed") c.unit = "m/min";
      if (l.name == "feed_per_tooth" || l.name == "radial_cutting_depth") c.unit = "mm";
      c.shadow_price = 0.01 * l.multiplier * l.value / s.objective;
    }
    a.active.push_back(std::move(c));
  }
}

Result<CutAnswer> solve_at(const CutQuestion& q, double ap_mm, const Options& options, Job& job) {
  CutAnswer a;
  const Search search(q, ap_mm);
  if (search.fixed()) {
    finish_answer(q, search.at({}), a);
    a.method = "given";
    return a;
  }
  const auto solved = solve(search.problem(), options, job);
  if (!solved) return tl::unexpected(solved.error());
  a.method = solved->method;
  finish_answer(q, search.at(solved->x), a);
  if (solved->feasible) take_active(q, *solved, a);
  return a;
}

double deepest(const CutQuestion& q) {
  const double d = q.cutter.cutting_diameter_mm;
  double most = q.cutter.maximum_depth_of_cut_mm > 0.0 ? q.cutter.maximum_depth_of_cut_mm : d;
  // A rough level no deeper than the diameter (a slot: half of it); default, unsourced.
  if (q.kind == CutKind::kRough) most = std::min(most, q.slot ? 0.5 * d : d);
  if (q.ap_most_mm > 0.0) most = std::min(most, q.ap_most_mm);
  return most;
}

}  // namespace

double feed_override(const CutQuestion& q) {
  if (q.override_locked || q.kind == CutKind::kTap) return 1.0;
  if (q.feed_mm_min && !q.feed_by_planning) return 1.0;
  return std::max(1.0, q.machine.abilities.feed_override_max);
}

std::optional<model::StepLoads> loads_of(const CutQuestion& q, double ap_mm, double ae_mm, double n_rpm,
                                         double feed_mm_min) {
  const mechanics::WorkMaterial work{q.material.kc11_n_mm2, q.material.mc};
  const double margin = force_margin(q);
  const double up = feed_override(q);
  const double fz = up * feed_mm_min / (n_rpm * teeth(q));
  model::StepLoads out;
  if (is_milling(q.kind)) {
    mechanics::MillingCut c;
    c.ap_mm = ap_mm;
    c.ae_mm = std::min(ae_mm, q.cutter.cutting_diameter_mm);
    c.fz_mm = fz;
    c.n_rpm = n_rpm;
    c.cutting_diameter_mm = q.cutter.cutting_diameter_mm;
    c.teeth = teeth(q);
    c.helix_rad = q.cutter.helix_rad;
    c.corner_radius_mm = q.cutter.corner_radius_mm;
    c.ball = q.cutter.cutter_class == model::CutterClass::kBallEndmill;
    const auto l = mechanics::milling_loads(c, work, stiffness(q.cutter));
    if (!l) return std::nullopt;
    out.peak_force_n = l->peak_force_n * margin;
    out.torque_nm = l->torque_nm * margin;
    out.power_w = l->power_w * margin;
    out.deflection_mm = l->deflection_mm * margin;
    out.chip_thickness_mm = l->h_max_mm / up;
    out.mrr_mm3_min = l->mrr_mm3_min / up;
    return out;
  }
  if (q.kind == CutKind::kTap) {
    mechanics::TappingCut c;
    c.nominal_diameter_mm = q.cutter.cutting_diameter_mm;
    c.pitch_mm = q.cutter.thread_pitch_mm;
    c.core_hole_diameter_mm = q.pre_hole_mm > 0.0 ? q.pre_hole_mm : c.nominal_diameter_mm - c.pitch_mm;
    c.n_rpm = n_rpm;
    const auto l = mechanics::tapping_loads(c, work);
    if (!l) return std::nullopt;
    out.torque_nm = l->torque_nm * margin;
    out.power_w = l->power_w * margin;
    out.chip_thickness_mm = l->chip_thickness_mm;
    return out;
  }
  mechanics::DrillingCut c;
  c.diameter_mm = q.cutter.cutting_diameter_mm;
  c.feed_mm_per_rev = up * feed_mm_min / n_rpm;
  c.n_rpm = n_rpm;
  c.teeth = teeth(q);
  c.point_angle_rad = q.cutter.point_angle_rad > 0.0 ? q.cutter.point_angle_rad : pi;
  if (q.engaged_diameter_mm > 0.0) c.diameter_mm = std::min(c.diameter_mm, q.engaged_diameter_mm);
  c.pre_hole_diameter_mm = q.pre_hole_mm < c.diameter_mm ? q.pre_hole_mm : 0.0;
  const auto l =
      q.kind == CutKind::kReam ? mechanics::reaming_loads(c, work) : mechanics::drilling_loads(c, work);
  if (!l) return std::nullopt;
  out.peak_force_n = l->thrust_n * margin;
  out.torque_nm = l->torque_nm * margin;
  out.power_w = l->power_w * margin;
  out.chip_thickness_mm = l->chip_thickness_mm / up;
  out.mrr_mm3_min = l->removal_mm3_min / up;
  return out;
}

double worst_excess(const CutQuestion& q, const model::StepLoads& loads, double n_rpm) {
  const auto m = measure(q, loads, 0.0, n_rpm, 0.0);
  double worst = -1.0;
  for (std::size_t i = 0; i < 4; ++i) worst = std::max(worst, m[i].first / m[i].second - 1.0);
  return worst;
}

Result<CutAnswer> cut(const CutQuestion& q, const Options& options, Job& job) {
  if (!(q.cutter.cutting_diameter_mm > 0.0) || !(q.material.kc11_n_mm2 > 0.0)) {
    return fail("OPT-QUESTION", "a cut needs a cutter with a diameter and a material with a specific force");
  }
  const bool needs_start = !(q.n_rpm && (q.feed_mm_min || q.fz_mm));
  if (needs_start && !(q.vc_start_m_min > 0.0 && (q.fz_start_mm > 0.0 || q.kind == CutKind::kTap))) {
    return fail("OPT-QUESTION", "no start values of speed and feed are known for cutter " + q.cutter.id);
  }
  if (!is_milling(q.kind)) return solve_at(q, 0.0, options, job);
  const double depth = q.depth_mm > 0.0 ? q.depth_mm : q.ap_mm.value_or(0.1);
  if (q.ap_mm) {
    auto a = solve_at(q, std::min(*q.ap_mm, depth), options, job);
    if (a) a->levels = std::max(1, static_cast<int>(std::ceil(depth / *q.ap_mm - 1e-9)));
    return a;
  }
  // Levels are whole: try the fewest that the cutter allows and some more, and take the fastest.
  const int fewest = std::max(1, static_cast<int>(std::ceil(depth / deepest(q) - 1e-9)));
  std::optional<CutAnswer> best;
  double best_time = 0.0;
  int tries = 0;
  // Thinner levels than this are not tried; default, unsourced.
  constexpr double kThinnestMm = 0.05;
  constexpr int kMostTries = 24;
  for (int levels = fewest; tries < kMostTries;
       levels = std::max(levels + 1, static_cast<int>(levels * 1.3)), ++tries) {
    const double ap = depth / levels;
    if (best && ap < kThinnestMm) break;
    auto a = solve_at(q, ap, options, job);
    if (!a) return a;
    a->levels = levels;
    const double time = objective(q, a->ap_mm, a->ae_mm, a->n_rpm, a->feed_mm_min);
    const bool better = !best || (a->feasible && !best->feasible) ||
                        (a->feasible == best->feasible && time < best_time * (1.0 - 1e-6));
    if (better) {
      best = *std::move(a);
      best_time = time;
    } else if (best->feasible) {
      break;  // more, thinner levels only get slower from here
    }
  }
  return *best;
}

}  // namespace capstan::optimise
