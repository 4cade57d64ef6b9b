#include "planner/engagement/planar/contact.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "planner/engagement/planar/planar.h"

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
constexpr int kPanels = 4;  // of eight lines each, over a disc

/// Calls f(x, weight) for the lines across a disc: x = R sin t, so that a whole disc comes out exactly.
template <class F>
void over_disc(double radius, F&& f) {
  for (int panel = 0; panel < kPanels; ++panel) {
    const double half = 0.5 * std::numbers::pi / kPanels;
    const double middle = -0.5 * std::numbers::pi + (2 * panel + 1) * half;
    for (std::size_t i = 0; i < kNodes.size(); ++i) {
      for (const double side : {-1.0, 1.0}) {
        const double t = middle + side * half * kNodes[i];
        f(radius * std::sin(t), kWeights[i] * half * radius * std::cos(t));
      }
    }
  }
}

/// Joins pieces that touch, so that strips of one contact are not taken for slivers.
struct Run {
  double x0 = 0.0, x1 = -1e300, height = 0.0;
  void into(Contact& c) const {
    if (x1 - x0 < kSliver) return;
    c.left = std::min(c.left, x0);
    c.right = std::max(c.right, x1);
    c.low = std::min(c.low, 0.0);
    c.high = std::max(c.high, height);
  }
};

}  // namespace

void Contact::extend(const Contact& o) {
  left = std::min(left, o.left);
  right = std::max(right, o.right);
  low = std::min(low, o.low);
  high = std::max(high, o.high);
  highest = std::max(highest, o.highest);
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
  stock_.heights(Probe::front(at, unit_heading, profile_.radius_mm), near_, z_mm + stock::kTouch, heights_);
  Run run;
  for (const Heights::Piece& p : heights_.pieces()) {
    const double h = p.z_mm - z_mm;
    if (h <= 2.0 * stock::kTouch) continue;
    const double area = h * (p.x1 - p.x0);
    c.amount += area;
    c.moment_x += area * 0.5 * (p.x0 + p.x1);
    c.moment_y += area * 0.5 * h;
    c.highest = std::max(c.highest, h);
    if (p.x0 > run.x1) {
      run.into(c);
      run = {.x0 = p.x0, .x1 = p.x1, .height = h};
    } else {
      run.x1 = p.x1;
      run.height = std::max(run.height, h);
    }
  }
  run.into(c);
  if (fall > 0.0) under_tip(at, unit_heading, z_mm, fall, c);
  return c;
}

void Prober::under_tip(Vec2 at, Vec2 ahead, double z_mm, double fall, Contact& c) {
  const double radius = profile_.radius_mm;
  const Vec2 along{ahead.y, -ahead.x};
  over_disc(radius, [&](double x, double weight) {
    const double half = std::sqrt(std::max(0.0, (radius - x) * (radius + x)));
    stock_.heights(Probe::straight(at + x * along, ahead, -half, half), near_, z_mm + stock::kTouch,
                   heights_);
    double length = 0.0;
    for (const Heights::Piece& p : heights_.pieces()) {
      if (p.z_mm > z_mm + 2.0 * stock::kTouch) length += p.x1 - p.x0;
    }
    if (length < kSliver) return;
    c.amount += fall * weight * length;
    c.moment_x += fall * weight * length * x;
    // The lines stop short of the edge by less than their own distance.
    const double to_edge = std::abs(x) > 0.99 * radius ? std::copysign(radius, x) : x;
    c.left = std::min(c.left, to_edge);
    c.right = std::max(c.right, to_edge);
    c.low = std::min(c.low, 0.0);
    c.high = std::max(c.high, 0.0);
  });
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
  Contact c;
  const double radius = profile_.radius_mm;
  const Vec2 along{ahead.y, -ahead.x};
  double last_height = -1.0;
  double last_reach = 0.0;
  over_disc(radius, [&](double x, double weight) {
    const double half = std::sqrt(std::max(0.0, (radius - x) * (radius + x)));
    stock_.heights(Probe::straight(at + x * along, ahead, -half, half), near_, z_mm + stock::kTouch,
                   heights_);
    for (const Heights::Piece& p : heights_.pieces()) {
      const double h = p.z_mm - z_mm;
      if (h <= 2.0 * stock::kTouch) continue;
      if (h != last_height) {
        last_height = h;
        last_reach = reach_at(h);
      }
      if (std::abs(x) >= last_reach) continue;
      const double most = std::sqrt((last_reach - x) * (last_reach + x));
      // Halves on either side of the axis: an outline may have its tip there.
      for (const auto& [from, to] : {std::pair{std::max(p.x0, -most), std::min({p.x1, most, 0.0})},
                                     std::pair{std::max({p.x0, -most, 0.0}), std::min(p.x1, most)}}) {
        if (!(to - from > stock::kTouch)) continue;
        for (std::size_t i = 0; i < kNodes.size(); ++i) {
          for (const double side : {-1.0, 1.0}) {
            const double y = 0.5 * (from + to) + side * 0.5 * (to - from) * kNodes[i];
            const double base = profile_.height(std::hypot(x, y));
            const double w = weight * kWeights[i] * 0.5 * (to - from);
            c.amount += w * (h - base);
            c.moment_x += w * (h - base) * x;
            c.moment_y += w * (h - base) * 0.5 * (h + base);
          }
        }
        const double far = std::max(std::hypot(x, from), std::hypot(x, to));
        const double rim = far > 0.99 * radius ? radius : far;
        c.high = std::max(c.high, std::min(h, profile_.height(rim) + advance_mm));
        c.low = std::min(c.low, profile_.height(std::min(std::abs(x), radius)));
        const double to_edge = std::abs(x) > 0.99 * radius ? std::copysign(radius, x) : x;
        c.left = std::min(c.left, to_edge);
        c.right = std::max(c.right, to_edge);
      }
    }
  });
  c.highest = std::max(0.0, c.high);
  return c;
}

}  // namespace capstan::engagement
