#include "planner/physics/engagement/planar/contact.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "planner/physics/engagement/planar/planar.h"

namespace capstan::engagement {
namespace {

using geometry::Vec2;
using stock::Heights;
using stock::Probe;

// Gauss-Legendre, eight points on [-1, 1]; Abramowitz and Stegun, table 25.4.
constexpr std::array<double, 4> kNodes{0.1834346424956498, 0.5255324099163290, 0.7966664774136267,
                                       0.9602898564975363};
constexpr std::array<double, 4> kWeights{0.3626837833783620, 0.3137066458778873, 0.2223810344533745,
                                         0.1012285362903763};
constexpr double kShare = 1e-5;    // of a plunge's advance times radius squared
constexpr double kOfFront = 1e-3;  // on a ramp: of the section ahead of it
constexpr int kUnderTip = 2;       // the same on a ramp, whose floor beneath is strips anyway
// Of the radius squared: panels of a whole disc differ by less, by rounding. Default, unsourced.
constexpr double kUniform = 1e-9;
constexpr int kDeepest = 10;  // halvings of the lines' panels

/// Amounts over a disc, from what f finds on the lines x across it, by panels that are halved until `allowed`
/// is kept: x = R sin t, so that a whole disc comes out exactly. f(x, c) adds to c per length of x.
template <class F>
class Disc {
 public:
  Disc(double radius, double allowed, int deepest, F& f)
      : radius_(radius), allowed_(allowed), deepest_(deepest), f_(f) {}
  Contact all() {
    constexpr double kQuarter = 0.5 * std::numbers::pi;
    Contact out;
    refined(-kQuarter, kQuarter, panel(-kQuarter, kQuarter), 0, out);
    return out;
  }
  /// True if the first halving changed the result by more than rounding: edges then lie within the disc, and
  /// the result is only as good as the panels.
  [[nodiscard]] bool edged() const { return edged_; }
  /// Change of the result in the last halving: the error estimate.
  [[nodiscard]] double unsure() const { return unsure_; }

 private:
  Contact panel(double t0, double t1) {
    Contact sum;
    for (std::size_t i = 0; i < kNodes.size(); ++i) {
      for (const double side : {-1.0, 1.0}) {
        const double t = 0.5 * (t0 + t1) + side * 0.5 * (t1 - t0) * kNodes[i];
        Contact c;
        f_(radius_ * std::sin(t), c);
        sum.add(c, kWeights[i] * 0.5 * (t1 - t0) * radius_ * std::cos(t));
        sum.extend(c);
      }
    }
    return sum;
  }

  void refined(double t0, double t1, const Contact& whole, int depth, Contact& out) {
    const double middle = 0.5 * (t0 + t1);
    const Contact left = panel(t0, middle);
    const Contact right = panel(middle, t1);
    const double apart = std::abs(left.amount + right.amount - whole.amount);
    edged_ = edged_ || (depth == 0 && apart > kUniform * radius_ * radius_);
    if (depth >= deepest_ || apart <= allowed_) {
      unsure_ += apart;
      for (const Contact& c : {left, right}) {
        out.add(c, 1.0);
        out.extend(c);
      }
      return;
    }
    refined(t0, middle, left, depth + 1, out);
    refined(middle, t1, right, depth + 1, out);
  }

  double radius_, allowed_;
  int deepest_;
  F& f_;
  bool edged_ = false;
  double unsure_ = 0.0;
};

template <class F>
Contact over_disc(double radius, double allowed, F&& f) {
  return Disc<F>(radius, allowed, kDeepest, f).all();
}

/// Joins pieces that touch, so that strips of one contact are not taken for slivers. Its height is that above
/// which it is no sliver: on a helix the cutter touches the wall of its own bore along a line, up to the top.
class Run {
 public:
  explicit Run(std::vector<Heights::Piece>& thin) : thin_(thin) {}
  void begin(double x0, double low) {
    x0_ = x1 = x0;
    low_ = high_ = low;
    thin_.clear();
  }
  void add(const Heights::Piece& p, double high) {
    x1 = p.x1;
    if (p.x1 - p.x0 >= kSliver) {
      high_ = std::max(high_, high);
    } else {
      thin_.push_back({p.x0, p.x1, high});
    }
  }
  void into(Contact& c, double radius) {
    if (x1 - x0_ < kSliver) return;
    std::sort(thin_.begin(), thin_.end(), [](const auto& a, const auto& b) { return a.z_mm > b.z_mm; });
    double wide = 0.0;
    for (const Heights::Piece& p : thin_) {
      wide += p.x1 - p.x0;
      if (wide < kSliver) continue;
      high_ = std::max(high_, p.z_mm);
      break;
    }
    const auto angle = [&](double x) { return std::acos(std::clamp(-x / radius, -1.0, 1.0)); };
    if (c.seen()) c.gap_rad += angle(x0_) - angle(c.right);
    c.left = std::min(c.left, x0_);
    c.right = std::max(c.right, x1);
    c.low = std::min(c.low, low_);
    c.high = std::max(c.high, high_);
  }

  double x1 = -1e300;  ///< where it ends; below anything: it has not begun

 private:
  double x0_ = 0.0, low_ = 0.0, high_ = 0.0;
  std::vector<Heights::Piece>& thin_;
};

}  // namespace

void Contact::extend(const Contact& o) {
  if (o.seen()) gap_rad = seen() ? std::min(gap_rad, o.gap_rad) : o.gap_rad;
  left = std::min(left, o.left);
  right = std::max(right, o.right);
  low = std::min(low, o.low);
  high = std::max(high, o.high);
  highest = std::max(highest, o.highest);
  in_strips = in_strips || o.in_strips;
}

void Contact::add(const Contact& o, double times) {
  amount += times * o.amount;
  moment_x += times * o.moment_x;
  moment_y += times * o.moment_y;
}

bool Prober::turn_to(Vec2 lo, Vec2 hi, double z_mm) {
  if (stock_.highest(lo, hi) <= z_mm + stock::kTouch) return true;
  stock_.gather(lo, hi, near_);
  return false;
}

Contact Prober::on_the_way(Vec2 at, Vec2 unit_heading, double z_mm, double fall) {
  Contact c;
  const double base = std::max(0.0, stock_.box().lo.z - z_mm);  // where the piece begins, above the tip
  stock_.heights(Probe::front(at, unit_heading, profile_.radius_mm), near_, z_mm + base + stock::kTouch,
                 heights_);
  c.in_strips = near_.in_strips;
  Run run(thin_);
  for (const Heights::Piece& p : heights_.pieces()) {
    const double h = p.z_mm - z_mm - base;
    if (h <= 2.0 * stock::kTouch) continue;
    const double area = h * (p.x1 - p.x0);
    c.amount += area;
    c.moment_x += area * 0.5 * (p.x0 + p.x1);
    c.moment_y += area * (base + 0.5 * h);
    c.highest = std::max(c.highest, base + h);
    if (p.x0 > run.x1) {
      run.into(c, profile_.radius_mm);
      run.begin(p.x0, base);
    }
    run.add(p, base + h);
  }
  run.into(c, profile_.radius_mm);
  if (fall > 0.0 && base <= 0.0) under_tip(at, unit_heading, z_mm, fall, c);
  return c;
}

void Prober::under_tip(Vec2 at, Vec2 ahead, double z_mm, double fall, Contact& c) {
  const double radius = profile_.radius_mm;
  // No material under the tip, as on a helix in an existing hole or a ramp over a cut area: no lines are
  // needed.
  if (stock_.cleared(near_, at, radius, z_mm + stock::kTouch)) return;
  const Vec2 along{ahead.y, -ahead.x};
  const auto on_line = [&](double x, Contact& line) {
    const double half = std::sqrt(std::max(0.0, (radius - x) * (radius + x)));
    const Probe across = Probe::straight(at + x * along, ahead, -half, half);
    stock_.heights(across, near_, z_mm + stock::kTouch, heights_, z_mm + 3.0 * stock::kTouch);
    double length = 0.0;
    for (const Heights::Piece& p : heights_.pieces()) {
      if (p.z_mm > z_mm + 2.0 * stock::kTouch) length += p.x1 - p.x0;
    }
    if (length < kSliver) return;
    line.amount = length;
    line.moment_x = length * x;
    // The lines stop short of the edge by less than their own distance.
    const double to_edge = std::abs(x) > 0.99 * radius ? std::copysign(radius, x) : x;
    line.left = line.right = to_edge;
    line.low = line.high = 0.0;
  };
  Disc disc(radius, std::max(kShare * radius * radius, kOfFront * c.amount / fall), kUnderTip, on_line);
  const Contact under = disc.all();
  // Edges under the tip come out no better than floors in strips do: no halving of the way makes them even.
  c.in_strips = c.in_strips || disc.edged();
  if (disc.edged()) c.unsure = fall * disc.unsure();
  c.add(under, fall);
  c.extend(under);  // material cut below the tip closes gaps
}

double Prober::reach_at(double height_mm) const {
  if (profile_.height(profile_.radius_mm) <= height_mm) return profile_.radius_mm;
  if (profile_.height(0.0) >= height_mm) return 0.0;
  double inside = 0.0;
  double outside = profile_.radius_mm;
  for (int i = 0; i < 60; ++i) {
    const double middle = 0.5 * (inside + outside);
    (profile_.height(middle) < height_mm ? inside : outside) = middle;
  }
  return inside;
}

Contact Prober::inside(Vec2 at, Vec2 ahead, double z_mm, double advance_mm) {
  const double radius = profile_.radius_mm;
  const double bottom = std::max(0.0, stock_.box().lo.z - z_mm);  // where the piece begins, above the tip
  const double through = bottom > 0.0 ? reach_at(bottom) : 0.0;   // there the outline is past it
  const Vec2 along{ahead.y, -ahead.x};
  double last_height = -1.0;
  double last_reach = 0.0;
  const bool flat = geometry::is_flat(profile_);  // its height is 0 wherever it is asked
  const auto outline = [&](double x, double y) { return flat ? 0.0 : profile_.height(std::hypot(x, y)); };
  const auto on_line = [&](double x, double from, double to, double h, Contact& c) {
    if (!(to - from > stock::kTouch)) return;
    for (std::size_t i = 0; i < kNodes.size(); ++i) {
      for (const double side : {-1.0, 1.0}) {
        const double y = 0.5 * (from + to) + side * 0.5 * (to - from) * kNodes[i];
        const double base = std::max(bottom, outline(x, y));
        const double w = kWeights[i] * 0.5 * (to - from) * (h - base);
        c.amount += w;
        c.moment_x += w * x;
        c.moment_y += w * 0.5 * (h + base);
      }
    }
    double at_rim = 0.0;
    if (!flat) {
      const double far = std::max(std::hypot(x, from), std::hypot(x, to));
      at_rim = profile_.height(far > 0.99 * radius ? radius : far);
    }
    const double low = std::max(bottom, outline(std::min(std::abs(x), radius), 0.0));
    c.high = std::max({c.high, low, std::min(h, at_rim + advance_mm)});
    c.low = std::min(c.low, low);
    const double to_edge = std::abs(x) > 0.99 * radius ? std::copysign(radius, x) : x;
    c.left = std::min(c.left, to_edge);
    c.right = std::max(c.right, to_edge);
  };
  const double allowed = kShare * radius * radius * std::max(advance_mm, kShare * radius);
  Contact out = over_disc(radius, allowed, [&](double x, Contact& c) {
    const double half = std::sqrt(std::max(0.0, (radius - x) * (radius + x)));
    const Probe across = Probe::straight(at + x * along, ahead, -half, half);
    stock_.heights(across, near_, z_mm + bottom + stock::kTouch, heights_);
    for (const Heights::Piece& p : heights_.pieces()) {
      const double h = p.z_mm - z_mm;
      if (h - bottom <= 2.0 * stock::kTouch) continue;
      if (h != last_height) {
        last_height = h;
        last_reach = reach_at(h);
      }
      if (std::abs(x) >= last_reach) continue;
      const double most = std::sqrt((last_reach - x) * (last_reach + x));
      // Between the corners of the outline: its axis, and where it leaves the piece below.
      const double corner =
          std::abs(x) < through ? std::min(most, std::sqrt((through - x) * (through + x))) : 0.0;
      double from = -most;
      for (const double to : {-corner, 0.0, corner, most}) {
        on_line(x, std::max(from, p.x0), std::min(to, p.x1), h, c);
        from = to;
      }
    }
  });
  out.highest = std::max(0.0, out.high);
  return out;
}

}  // namespace capstan::engagement
