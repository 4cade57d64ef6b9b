#include "planner/making/optimise/cut/search.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <numbers>

#include "planner/making/optimise/cut/law/law.h"
#include "planner/model/plan/preset_feeds.h"
#include "planner/physics/mechanics/force/immersion.h"
#include "planner/physics/mechanics/loads/width.h"

namespace capstan::optimise {
namespace {

using std::numbers::pi;

constexpr const char* kSpeed = "cutting_speed";
constexpr const char* kCutterSpeed = "cutter_speed_most";
constexpr const char* kFeed = "feed_per_tooth";
constexpr const char* kWidth = "radial_cutting_depth";

/// Narrowest width that is tried, as a fraction of the widest. A rough path begins with a slot of the whole
/// diameter, which the check lets be eight times the planned section (verify/sweep: CHK-WIDTH-LEFT); a
/// narrower cut would mostly not be what its path does. Derived from that: more than an eighth.
constexpr double kNarrowest = 0.13;

/// By how much a limit of loads may seem exceeded.
constexpr double kLoadRounding = 1e-6;

}  // namespace

Search::Search(const CutQuestion& q, double ap_mm) : q_(q), ap_(ap_mm) {
  add_speed();
  add_feed();
  if (is_milling(q.kind)) add_width();
}

double Search::speed_of(double n_rpm) const { return pi * speed_diameter_mm(q_) * n_rpm / 1000.0; }

void Search::add(const char* name, const char* unit, double lo, double hi) {
  const double low = std::min(lo, hi);
  variables_.push_back({name, unit, low, hi, std::sqrt(low * hi), Walk::kLogarithmic});
}

void Search::add_speed() {
  if (q_.n_rpm) {
    n_fixed_ = *q_.n_rpm;
    return;
  }
  const double slot =
      q_.kind == CutKind::kRough && q_.slot ? deep_slot_share(ap_, q_.cutter.cutting_diameter_mm) : 1.0;
  Range rpm = speeds(q_);
  rpm.lo /= ease_of(q_, "spindle_speed_least");
  const double eased = ease_of(q_, "spindle_speed_most") * ease_of(q_, kCutterSpeed);
  rpm.hi *= eased;
  // A start value that was lowered to what spindle or cutter turn is what they turn: more of that is more
  // speed, up to what the table says.
  const double start = eased > 1.0 ? std::max(q_.vc_start_m_min, q_.vc_table_m_min) : q_.vc_start_m_min;
  const double arc = q_.ae_mm ? speed_by_arc(q_, *q_.ae_mm) : 1.0;
  const double table = arc * slot * start / speed_of(1.0) * ease_of(q_, kSpeed);
  constexpr double kSame = 1e-9;
  speed_by_spindle_ = rpm.hi > 0.0 && rpm.hi <= table * (1.0 + kSame);
  const double most = std::max(speed_by_spindle_ ? rpm.hi : table, rpm.lo);
  add(kSpeed, "m/min", speed_of(std::max(rpm.lo, kSlowestSpeedShare * most)), speed_of(most));
}

void Search::add_feed() {
  if (q_.feed_mm_min) {
    feed_fixed_ = *q_.feed_mm_min;
  } else if (q_.fz_mm) {
    fz_fixed_ = *q_.fz_mm;
  } else if (feeds_by_pitch(q_)) {
    fz_fixed_ = q_.cutter.thread_pitch_mm / teeth_of(q_);
  } else {
    const double largest = largest_fz(q_);
    double most = largest * (is_milling(q_.kind) ? kMostThinning : 1.0);
    // What a cutter bears is a chip, stated as the feed of a wide cut. Where the width is kept, its own limit
    // holds the chip.
    const double borne = model::largest_tooth_feed_mm(q_.cutter, q_.material);
    if (borne > 0.0 && !q_.constant_engagement) most = std::min(most, borne / feed_override(q_));
    most *= ease_of(q_, kFeed);
    const double ratio = q_.least_feed_ratio > 1e-3 && q_.least_feed_ratio <= 1.0 ? q_.least_feed_ratio : 0.1;
    const double least = std::max(ratio * largest, least_fz(q_)) / ease_of(q_, "feed_per_tooth_least");
    add(kFeed, "mm", least, most);
  }
}

void Search::add_width() {
  const double d = q_.cutter.cutting_diameter_mm;
  const double widest = q_.width_mm > 0.0 ? std::min(q_.width_mm, d) : d;
  if (q_.ae_mm) {
    ae_fixed_ = std::min(*q_.ae_mm, d);
  } else if (q_.kind == CutKind::kFinish) {
    ae_fixed_ = widest;
  } else if (q_.slot) {
    ae_fixed_ = d;
  } else {
    const double most = std::min(widest, mechanics::kRoughWidthRatio * d) * ease_of(q_, kWidth);
    add(kWidth, "mm", kNarrowest * std::min(widest, d), std::min(most, d));
  }
}

CutPoint Search::at(std::span<const double> x) const {
  std::size_t i = 0;
  CutPoint p;
  p.ap_mm = ap_;
  p.n_rpm = n_fixed_ ? *n_fixed_ : x[i++] / speed_of(1.0);
  if (feed_fixed_) {
    p.feed_mm_min = *feed_fixed_;
  } else {
    const double fz = fz_fixed_ ? *fz_fixed_ : x[i++];
    p.feed_mm_min = fz * teeth_of(q_) * p.n_rpm;
  }
  if (is_milling(q_.kind)) p.ae_mm = ae_fixed_ ? *ae_fixed_ : x[i++];
  return p;
}

std::vector<double> Search::corners(const Variable& v) const {
  std::vector<double> out;
  if (v.name == kSpeed) {
    if (const auto curve = curve_of(q_)) {
      for (const auto& p : curve->points()) out.push_back(speed_of(p.rpm));
    }
  } else if (v.name == kWidth) {
    const double d =
        mechanics::effective_diameter_mm(ap_, q_.cutter.cutting_diameter_mm, model::end_radius_mm(q_.cutter));
    out = {0.5 * d, d};
  }
  // A sliver beside an end of the range is no piece.
  const double sliver = 1e-6 * (v.upper - v.lower);
  std::erase_if(out, [&](double c) { return !(c > v.lower + sliver && c < v.upper - sliver); });
  return out;
}

std::vector<std::vector<Variable>> Search::pieces() const {
  std::vector<std::vector<Variable>> out = {variables_};
  for (std::size_t j = 0; j < variables_.size(); ++j) {
    std::vector<double> ends = corners(variables_[j]);
    if (ends.empty()) continue;
    ends.push_back(variables_[j].upper);
    std::vector<std::vector<Variable>> cut;
    for (const auto& box : out) {
      double from = variables_[j].lower;
      for (const double to : ends) {
        cut.push_back(box);
        Variable& v = cut.back()[j];
        v.lower = from;
        v.upper = to;
        v.start = std::sqrt(from * to);
        from = to;
      }
    }
    out = std::move(cut);
  }
  return out;
}

std::vector<CutPoint> Search::at_ends_of_speed(const std::vector<Variable>& piece,
                                               std::vector<double> x) const {
  std::vector<CutPoint> out = {at(x)};
  for (std::size_t j = 0; j < piece.size(); ++j) {
    if (piece[j].name != kSpeed) continue;
    x[j] = piece[j].upper;
    out.push_back(at(x));
  }
  return out;
}

bool Search::keeps_loads(const CutPoint& p) const {
  const auto loads = loads_of(q_, p.ap_mm, p.ae_mm, p.n_rpm, p.feed_mm_min);
  return !loads || worst_excess(q_, *loads, p.n_rpm) <= kLoadRounding;
}

/// The thinnest chip that the cutter takes, over the chip of a cut; 0 where none is asked for.
double Search::chip_wanted(const CutPoint& p) const {
  const auto loads = loads_of(q_, p.ap_mm, p.ae_mm, p.n_rpm, p.feed_mm_min);
  if (!loads) return 0.0;
  const Measure m = measures(q_, *loads, p.ap_mm, p.n_rpm, p.feed_mm_min)[model::Limit::kChipThicknessLeast];
  return m.stated() && m.limit > 0.0 ? m.value / m.limit : 0.0;
}

std::vector<CutPoint> Search::gentlest(const std::vector<Variable>& piece) const {
  std::vector<double> x, widest;
  std::optional<std::size_t> feed;
  for (std::size_t j = 0; j < piece.size(); ++j) {
    x.push_back(piece[j].lower);
    widest.push_back(piece[j].name == kWidth ? piece[j].upper : piece[j].lower);
    if (piece[j].name == kFeed) feed = j;
  }
  std::vector<CutPoint> out = at_ends_of_speed(piece, x);
  const auto keeps = [this](const CutPoint& p) { return keeps_loads(p); };
  if (!feed || !is_milling(q_.kind) || std::none_of(out.begin(), out.end(), keeps)) return out;
  // A chip is as thick as the feed is large; a hair less, for rounding.
  const double wanted = chip_wanted(at(widest)) * (1.0 - 2.0 * kLoadRounding);
  if (!(wanted > 1.0)) return out;
  x[*feed] = widest[*feed] = std::min(wanted * piece[*feed].lower, piece[*feed].upper);
  // More than that is no bound.
  if (chip_wanted(at(widest)) < 1.0) return out;
  return at_ends_of_speed(piece, x);
}

bool Search::hopeless(const std::vector<Variable>& piece) const {
  const auto points = gentlest(piece);
  const auto keeps = [this](const CutPoint& p) { return keeps_loads(p); };
  if (std::none_of(points.begin(), points.end(), keeps)) return true;
  std::vector<double> most;
  for (const Variable& v : piece) most.push_back(v.name == kSpeed ? v.lower : v.upper);
  constexpr double kTooThin = 1e-5;  // well beyond what a solver counts as kept
  return is_milling(q_.kind) && chip_wanted(at(most)) > 1.0 + kTooThin;
}

CutPoint Search::fastest() const {
  std::vector<double> x;
  for (const Variable& v : variables_) x.push_back(v.upper);
  CutPoint p = at(x);
  const model::Cutter& c = q_.cutter;
  const bool upright = model::end_radius_mm(c) == 0.0 && c.lead_angle_rad == 0.0 && c.taper_angle_rad == 0.0;
  if (!is_milling(q_.kind) || !upright || feed_fixed_ || fz_fixed_ || !(largest_fz(q_) > 0.0)) return p;
  // The area per tooth, ae fz at a given chip, rises with ae: D / 2 sqrt(r / (1 - r)), then ae.
  const double chip = mechanics::max_chip_thickness_mm(1.0, p.ae_mm, c.cutting_diameter_mm);
  const double fz = largest_fz(q_) * ease_of(q_, "chip_thickness") / chip;
  p.feed_mm_min = std::min(p.feed_mm_min, fz * teeth_of(q_) * p.n_rpm);
  return p;
}

Problem Search::problem(std::vector<Variable> box, const std::optional<CutPoint>& start) const {
  Problem p;
  if (start) {
    for (Variable& v : box) {
      const double fz = start->feed_mm_min / (start->n_rpm * teeth_of(q_));
      const double x = v.name == kSpeed ? speed_of(start->n_rpm) : v.name == kFeed ? fz : start->ae_mm;
      v.start = std::clamp(x, v.lower, v.upper);
    }
  }
  p.variables = std::move(box);
  // Speeds are bounds, and the depth is fixed here: those limits are not part of it.
  std::vector<model::Limit> limits;
  const FixedLimits fixed = fixed_limits(q_);
  const Measures stated = measures(q_, fixed, model::StepLoads{}, ap_, 1.0, 1.0);
  for (const model::LimitRow& r : model::kLimitRows) {
    // Power and torque of a spindle are one limit at any speed: see SpindleCurve::at.
    if (!r.varies || !stated[r.value].stated() || r.value == model::Limit::kSpindleTorque) continue;
    limits.push_back(r.value);
    p.constraints.emplace_back(r.name);
  }
  const auto mills = is_milling(q_.kind) ? std::make_shared<MillingLoads>(q_) : nullptr;
  p.model = central_differences(
      [this, limits, mills, fixed](std::span<const double> x, double& f, std::span<double> c) {
        const CutPoint at_x = at(x);
        f = std::log(objective_of(q_, at_x));
        const auto loads = mills ? mills->at(at_x.ap_mm, std::min(at_x.ae_mm, q_.cutter.cutting_diameter_mm),
                                             at_x.n_rpm, at_x.feed_mm_min / (at_x.n_rpm * teeth_of(q_)))
                                 : loads_of(q_, at_x.ap_mm, at_x.ae_mm, at_x.n_rpm, at_x.feed_mm_min);
        if (!loads) {
          std::fill(c.begin(), c.end(), 1.0);
          return;
        }
        const Measures m = measures(q_, fixed, *loads, at_x.ap_mm, at_x.n_rpm, at_x.feed_mm_min);
        for (std::size_t i = 0; i < limits.size(); ++i) c[i] = m[limits[i]].excess();
      },
      p.variables);
  return p;
}

std::optional<Search::Bound> Search::bound(const std::string& variable, bool upper, double at) const {
  const auto it = std::find_if(variables_.begin(), variables_.end(),
                               [&](const Variable& v) { return v.name == variable; });
  if (it == variables_.end()) return std::nullopt;
  if (at != (upper ? it->upper : it->lower)) return std::nullopt;  // between two pieces
  if (variable == kSpeed) {
    const double cutter = q_.cutter.maximum_speed_rpm;
    const bool by_cutter = cutter > 0.0 && cutter < q_.machine.spindle.rpm_max;
    if (upper && speed_by_spindle_)
      return Bound{by_cutter ? kCutterSpeed : "spindle_speed_most", "1/min", at / speed_of(1.0)};
    if (upper) return Bound{kSpeed, "m/min", at};
    if (at <= speed_of(speeds(q_).lo) * (1.0 + 1e-9))
      return Bound{"spindle_speed_least", "1/min", at / speed_of(1.0)};
    return std::nullopt;
  }
  if (variable == kFeed) return Bound{upper ? kFeed : "feed_per_tooth_least", "mm", at};
  if (upper) return Bound{kWidth, "mm", at};
  return std::nullopt;
}

}  // namespace capstan::optimise
