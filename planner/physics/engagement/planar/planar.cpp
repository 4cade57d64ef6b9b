#include "planner/physics/engagement/planar/planar.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <utility>

#include "planner/physics/engagement/planar/contact.h"

// Cross sections of flat cutters on the exact stock. At one place of a move the section is an integral over
// the cutter's front half circle: `Prober::on_the_way` gets the heights there as exact pieces and sums area
// and moments. On a ramp it adds the material under the tip, by lines across the disc.
//
// Over one step the amounts are integrated by Simpson's rule. If the section in the middle differs from those
// at the ends, the step is halved until both rules agree to kTolerance, or to kInStrips where floors are read
// in strips. The halves are then taken (Richardson: their error is a fifteenth of the difference). The number
// of halvings is bounded, because no halving makes a jump even.
//
// A plunge is a difference of volumes: that above the tip now, less that above it one step before. The disc
// is integrated by Gauss-Legendre panels over x = R sin t (contact.cpp), which gives a whole disc exactly.
// Source  quadrature: Abramowitz and Stegun, table 25.4; the seven numbers: AP238 edition 2, 4.2.379.4; the
// rest: derived.

namespace capstan::engagement {
namespace {

using geometry::Vec2;
using geometry::Vec3;
using model::CutterPath;
using model::MoveKind;
using stock::kTouch;
using stock::Trail;

constexpr double kAir = 1e-6;        // mm2: smaller sections count as none
constexpr double kTolerance = 1e-6;  // of diameter times depth, in a step
constexpr int kDeepest = 14;         // halvings of a step
constexpr double kInStrips =
    1e-3;  // the same two where floors in strips are cut, which no halving makes even
constexpr int kDeepestInStrips = 2;
// Halvings of one step in all: a jump costs kDeepest of them, and a step as long as a 20th of the radius
// crosses a few edges at most. What changes everywhere is noise, which no halving makes even.
// Default, unsourced.
constexpr int kMostHalvings = 1024;
constexpr double kFromTheEnd = 1e-5;  // of the radius: ends of moves are seen from just inside
constexpr double kMostSteps = 1e7;

/// One horizontal or sloping piece of a move.
struct Way {
  Trail trail;
  double level_length = 0.0;  ///< horizontal
  double turn_sign = 0.0;     ///< arcs: +1 counter-clockwise
  Vec3 at(double s) const {
    const double t = s / level_length;
    const double z = trail.za + (trail.zb - trail.za) * t;
    if (!trail.arc) {
      const Vec2 p = trail.a + s * trail.along;
      return {p.x, p.y, z};
    }
    const Vec2 d = direction(t);
    return {trail.centre.x + trail.path_radius_mm * d.x, trail.centre.y + trail.path_radius_mm * d.y, z};
  }
  Vec2 heading(double s) const {
    if (!trail.arc) return trail.along;
    const Vec2 d = direction(s / level_length);
    return turn_sign * Vec2{-d.y, d.x};
  }

 private:
  Vec2 direction(double t) const {
    const double c = std::cos(trail.turn_rad * t);
    const double s = std::sin(trail.turn_rad * t);
    return {c * trail.along.x - s * trail.along.y, s * trail.along.x + c * trail.along.y};
  }
};

class Measurer {
 public:
  Measurer(const CutterPath& path, const geometry::CutterProfile& profile, stock::PlanarStock& stock,
           double step)
      : path_(path), profile_(profile), stock_(stock), prober_(stock, profile), step_(step) {
    outline_ = stock.keep(profile);
  }

  Measurement run() {
    if (path_.size() > 0) start();
    for (std::size_t i = 1; i < path_.size(); ++i) move(i);
    return std::move(out_);
  }

 private:
  void start() {
    const Vec2 p = xy(path_.point(0));
    if (over_air(p, path_.z[0])) return;
    out_.rapid_removed_mm3 += prober_.inside(p, heading_, path_.z[0], 0.0).amount;
    upright(p, path_.z[0]);
  }

  void upright(Vec2 p, double z) {
    Trail t;
    t.a = t.b = p;
    t.za = t.zb = z;
    t.radius_mm = profile_.radius_mm;
    t.outline = outline_;
    t.settle();
    stock_.take(t);
  }

  void move(std::size_t i) {
    const double length = model::move_length(path_, i);
    if (path_.kind[i] == MoveKind::kDwell || !(length > 0.0)) return;
    const auto trails = stock::trails_of(path_, i, profile_.radius_mm, outline_);
    const bool rapid = path_.kind[i] == MoveKind::kRapid;
    const double steps = std::clamp(std::ceil(length / step_ - 1e-9), 1.0, kMostSteps);
    const int per_trail =
        std::max(1, static_cast<int>(std::ceil(steps / static_cast<double>(trails.size()))));
    const double step = length / per_trail / static_cast<double>(trails.size());
    double at = 0.0;
    for (const Trail& t : trails) {
      if (t.length_mm <= kTouch) {
        plunge(i, t, path_.z[i - 1], path_.z[i], per_trail, step, rapid);
        continue;
      }
      Way way{.trail = t, .level_length = t.length_mm, .turn_sign = t.turn_rad >= 0.0 ? 1.0 : -1.0};
      along(i, way, per_trail, step, at, rapid);
      at += step * per_trail;
      heading_ = way.heading(way.level_length);
      if (cuts_) stock_.take(t);
    }
  }

  void plunge(std::size_t i, const Trail& t, double from, double to, int steps, double step, bool rapid) {
    // Upwards nothing is met that was not met where it began.
    if (to >= from || over_air(t.a, to)) {
      if (!rapid) close(i, model::move_length(path_, i));
      return;
    }
    if (rapid) {
      out_.rapid_removed_mm3 += prober_.inside(t.a, heading_, to, from - to).amount;
    } else {
      measure_plunge(i, t, from, to, steps, step);
    }
    upright(t.a, to);
  }

  void measure_plunge(std::size_t i, const Trail& t, double from, double to, int steps, double step) {
    const bool flat = geometry::is_flat(profile_);
    const auto height = [&](int k) { return k == 0 ? from : from + (to - from) * k / steps; };
    Contact c;           // what the last step alone took
    Contact before;      // all down to ..
    int before_at = -1;  // .. the end of this step
    double same_from = from;
    for (int k = 1; k <= steps; ++k) {
      const double z = height(k);
      // A flat cutter takes the same from step to step, as long as no floor begins or ends on its way.
      if (!(k > 1 && flat && prober_.even(z, same_from))) {
        same_from = height(k - 1);
        if (before_at != k - 1) before = prober_.inside(t.a, heading_, same_from, 0.0);
        const Contact all = prober_.inside(t.a, heading_, z, same_from - z);
        c = all;
        c.amount = all.amount - before.amount;
        c.moment_x = all.moment_x - before.moment_x;
        c.moment_y = all.moment_y - before.moment_y - before.amount * (same_from - z);
        before = all;
        before_at = k;
      }
      sample(i, step * k, step, c, c.amount > kAir * step && c.seen(), true);
    }
  }

  void along(std::size_t i, const Way& way, int steps, double step, double start, bool rapid) {
    cuts_ = false;
    way_ = &way;
    const double level = way.level_length / steps;
    const double chunk = std::max(profile_.radius_mm, level);
    fall_ = way.trail.zb < way.trail.za ? (way.trail.za - way.trail.zb) / way.level_length : 0.0;
    const int per_chunk = std::max(1, static_cast<int>(chunk / level));
    for (int first = 0; first < steps; first += per_chunk) {
      const int last = std::min(steps, first + per_chunk);
      if (over_air(first * level, last * level)) {
        if (!rapid) close(i, start + step * last);
        continue;
      }
      cuts_ = true;
      Contact from = look(first * level);
      for (int k = first; k < last; ++k) {
        Contact to = look((k + 1) * level);
        Contact sum = from;
        sum.extend(to);
        sum.amount = sum.moment_x = sum.moment_y = 0.0;
        integrate(k * level, from, (k + 1) * level, to, sum);
        if (rapid) {
          out_.rapid_removed_mm3 += sum.amount;
        } else {
          sample(i, start + step * (k + 1), step, sum, sum.amount > kAir * step && sum.seen(), false);
        }
        from = to;
      }
    }
  }

  bool over_air(Vec2 p, double z) {
    const Vec2 r{profile_.radius_mm, profile_.radius_mm};
    return prober_.turn_to(p - r, p + r, z);
  }

  bool over_air(double s0, double s1) {
    const Vec3 a = way_->at(s0);
    const Vec3 b = way_->at(s1);
    Vec2 lo{std::min(a.x, b.x), std::min(a.y, b.y)};
    Vec2 hi{std::max(a.x, b.x), std::max(a.y, b.y)};
    if (way_->trail.arc) {  // no point of the piece is farther from its middle than half of it
      const Vec2 m = xy(way_->at(0.5 * (s0 + s1)));
      const double r = 0.5 * (s1 - s0);
      lo = m - Vec2{r, r};
      hi = m + Vec2{r, r};
    }
    // Only what lies ahead of the cutter, unless it falls: how far its front half reaches to each side of its
    // centre. Headings of a piece are less than a half turn apart, so that their ends say it all.
    Vec2 back{0.0, 0.0};
    Vec2 front{0.0, 0.0};
    for (const double s : {s0, s1}) {
      const Vec2 h = way_->heading(s);
      const auto reach = [&](double towards, double beside) {
        return profile_.radius_mm * (towards >= -1e-9 || fall_ > 0.0 ? 1.0 : std::abs(beside));
      };
      front = {std::max(front.x, reach(h.x, h.y)), std::max(front.y, reach(h.y, h.x))};
      back = {std::max(back.x, reach(-h.x, h.y)), std::max(back.y, reach(-h.y, h.x))};
    }
    return prober_.turn_to(lo - back, hi + front, std::min(a.z, b.z));
  }

  Contact look(double s) {
    const double margin = std::min(kFromTheEnd * profile_.radius_mm, 0.25 * way_->level_length);
    const double inside = std::clamp(s, margin, way_->level_length - margin);
    const Vec3 p = way_->at(inside);
    return prober_.on_the_way(xy(p), way_->heading(inside), p.z, fall_);
  }

  /// Simpson's rule, halved where the contact changes; into the amounts of `sum`.
  void integrate(double s0, const Contact& a, double s1, const Contact& b, Contact& sum) {
    const Contact m = look(0.5 * (s0 + s1));
    sum.extend(m);
    halvings_ = 0;
    halves(s0, a, m, s1, b, sum, 0);
  }

  void halves(double s0, const Contact& a, const Contact& m, double s1, const Contact& b, Contact& sum,
              int depth) {
    const double h = s1 - s0;
    const bool strips = a.in_strips || m.in_strips || b.in_strips;
    // Halving the step does not reduce the errors of lines across floors read in strips.
    const double allowed = std::max((strips ? kInStrips : kTolerance) * 2.0 * profile_.radius_mm *
                                        std::max({a.highest, m.highest, b.highest}),
                                    std::max({a.unsure, m.unsure, b.unsure}));
    const auto simpson = [&] {
      sum.add(a, h / 6.0);
      sum.add(m, 4.0 * h / 6.0);
      sum.add(b, h / 6.0);
    };
    if (std::abs(a.amount - m.amount) <= allowed && std::abs(b.amount - m.amount) <= allowed)
      return simpson();
    const Contact left = look(s0 + 0.25 * h);
    const Contact right = look(s0 + 0.75 * h);
    sum.extend(left);
    sum.extend(right);
    const double coarse = (a.amount + 4.0 * m.amount + b.amount) / 6.0;
    const double fine =
        (a.amount + 4.0 * left.amount + 2.0 * m.amount + 4.0 * right.amount + b.amount) / 12.0;
    // A part of a step may be less exact than the whole by as much as it is shorter.
    const double scale = static_cast<double>(1U << static_cast<unsigned>(depth));
    if (depth >= (strips ? kDeepestInStrips : kDeepest) || ++halvings_ > kMostHalvings ||
        std::abs(fine - coarse) <= allowed * scale) {
      // Richardson: the error of the halves is a fifteenth of their difference.
      sum.add(a, h / 12.0);
      sum.add(left, 4.0 * h / 12.0);
      sum.add(m, 2.0 * h / 12.0);
      sum.add(right, 4.0 * h / 12.0);
      sum.add(b, h / 12.0);
      return;
    }
    const double middle = 0.5 * (s0 + s1);
    halves(s0, a, left, middle, m, sum, depth + 1);
    halves(middle, m, right, s1, b, sum, depth + 1);
  }

  /// One sample without contact after the last with it.
  void close(std::size_t i, double at) {
    if (out_.engagement.empty() || out_.engagement.back().removed_mm3 <= 0.0) return;
    push(i, at, {}, {});
  }

  /// `c`: amounts over the step, extremes in it.
  void sample(std::size_t i, double at, double step, const Contact& c, bool touched, bool plunge) {
    out_.removed_mm3 += std::max(0.0, c.amount);
    if (!touched) return close(i, at);
    Engagement e{.ap_mm = c.high - std::min(c.low, c.high),
                 .ae_mm = c.right - c.left,
                 .csa_mm2 = c.amount / step,
                 .removed_mm3 = c.amount,
                 .step_mm = step,
                 .plunge = plunge};
    if (plunge) {
      e.exit_rad = 2.0 * std::numbers::pi;
    } else {
      const double r = profile_.radius_mm;
      const auto angle = [&](double x) { return std::acos(std::clamp(-x / r, -1.0, 1.0)); };
      e.entry_rad = angle(c.left);
      e.exit_rad = angle(c.right);
    }
    e.arc_rad = e.exit_rad - e.entry_rad - c.gap_rad;
    out_.highest_contact_mm = std::max(out_.highest_contact_mm, c.highest);
    push(i, at, c, e);
  }

  void push(std::size_t i, double at, const Contact& c, const Engagement& e) {
    auto& s = out_.sections;
    const bool any = e.removed_mm3 > 0.0;
    s.move.push_back(static_cast<std::uint32_t>(i));
    s.at_mm.push_back(at);
    s.ad_max_mm.push_back(e.ap_mm);
    s.rd_max_mm.push_back(e.ae_mm);
    s.x_max_ofs_mm.push_back(any ? 0.5 * (c.left + c.right) : 0.0);
    s.y_max_ofs_mm.push_back(any ? 0.5 * (c.low + c.high) : 0.0);
    s.csa_mm2.push_back(e.csa_mm2);
    s.x_cg_ofs_mm.push_back(any ? c.moment_x / c.amount : 0.0);
    s.y_cg_ofs_mm.push_back(any ? c.moment_y / c.amount : 0.0);
    s.removed_mm3.push_back(e.removed_mm3);
    out_.engagement.push_back(e);
  }

  const CutterPath& path_;
  const geometry::CutterProfile& profile_;
  stock::PlanarStock& stock_;
  Prober prober_;
  double step_;
  const geometry::CutterProfile* outline_ = nullptr;
  const Way* way_ = nullptr;
  double fall_ = 0.0;
  int halvings_ = 0;  ///< of the step at hand
  bool cuts_ = false;
  Vec2 heading_{0.0, 1.0};
  Measurement out_;
};

/// Whether a cutter that is not flat below does more than plunge into material.
bool mills(const CutterPath& path, const geometry::CutterProfile& profile, const stock::PlanarStock& stock) {
  const Vec2 r{profile.radius_mm, profile.radius_mm};
  for (std::size_t i = 1; i < path.size(); ++i) {
    if (path.kind[i] == MoveKind::kDwell) continue;
    for (const Trail& t : stock::trails_of(path, i, profile.radius_mm, nullptr)) {
      if (t.length_mm <= kTouch) continue;
      const Vec2 reach = r + Vec2{t.arc ? t.length_mm : 0.0, t.arc ? t.length_mm : 0.0};
      const Vec2 lo{std::min(t.a.x, t.b.x), std::min(t.a.y, t.b.y)};
      const Vec2 hi{std::max(t.a.x, t.b.x), std::max(t.a.y, t.b.y)};
      if (stock.highest(lo - reach, hi + reach) > t.lowest_mm + kTouch) return true;
    }
  }
  return false;
}

}  // namespace

Result<Measurement> measure(const CutterPath& path, const model::Cutter& cutter, stock::PlanarStock& stock,
                            const Options& options) {
  if (model::has(cutter.cutter_class, model::CutterTrait::kUndercuts)) {
    return fail("ENG-UNDERCUT", "the cut of " + std::string(model::to_text(cutter.cutter_class)) + " '" +
                                    cutter.id + "' lies under an overhang; it is not measured");
  }
  const geometry::CutterProfile profile = model::profile_of(cutter);
  if (!(profile.radius_mm > 0.0) || !std::isfinite(profile.radius_mm) || profile.pieces.empty())
    return fail("ENG-PROFILE", "cutter '" + cutter.id + "' has no cutting diameter");
  for (std::size_t i = 0; i < path.size(); ++i) {
    if (!std::isfinite(path.x[i]) || !std::isfinite(path.y[i]) || !std::isfinite(path.z[i]) ||
        !std::isfinite(path.cx[i]) || !std::isfinite(path.cy[i])) {
      return fail("ENG-NUMBER", "point " + std::to_string(i) + " of the path is not finite");
    }
  }
  if (!stock.lost().empty()) return fail("ENG-NOT-PLANAR", "the planar stock was lost: " + stock.lost());
  if (head_height(cutter))  // the height map decides whether material is above the head
    return fail("ENG-NOT-PLANAR", "cutter '" + cutter.id + "' is thinner behind its head");
  if (!geometry::is_flat(profile) && mills(path, profile, stock)) {
    return fail("ENG-NOT-PLANAR",
                "cutter '" + cutter.id + "' is not flat below: what it mills is measured on a height map");
  }
  const double step = options.step_mm > 0.0 ? options.step_mm : profile.radius_mm / 20.0;
  return Measurer(path, profile, stock, step).run();
}

}  // namespace capstan::engagement
