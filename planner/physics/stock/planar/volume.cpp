#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "planner/physics/stock/planar/planar_stock.h"

namespace capstan::stock {
namespace {

using geometry::Vec2;

// Gauss-Legendre, eight points on [-1, 1]; Abramowitz and Stegun, table 25.4.
constexpr std::array<double, 4> kNodes{0.1834346424956498, 0.5255324099163290, 0.7966664774136267,
                                       0.9602898564975363};
constexpr std::array<double, 4> kWeights{0.3626837833783620, 0.3137066458778873, 0.2223810344533745,
                                         0.1012285362903763};

/// Area of the sections along x, integrated over y between two of its corners: y runs by a cosine, so that
/// what begins or ends like a root there is smooth.
class Rows {
 public:
  Rows(const PlanarStock& stock, PlanarStock::Nearby& near) : stock_(stock), near_(near) {}

  double between(double y0, double y1, double tolerance) {
    y0_ = y0;
    y1_ = y1;
    return refined(0.0, std::numbers::pi, gauss(0.0, std::numbers::pi), tolerance, 0);
  }

 private:
  double section(double y) {
    const auto& box = stock_.box();
    const double middle = 0.5 * (box.lo.x + box.hi.x);
    const double half = 0.5 * (box.hi.x - box.lo.x);
    stock_.heights(Probe::straight({middle, y}, {1.0, 0.0}, -half, half), near_, box.lo.z, heights_);
    double area = 0.0;
    for (const auto& p : heights_.pieces()) area += (p.z_mm - box.lo.z) * (p.x1 - p.x0);
    return area;
  }

  double gauss(double t0, double t1) {
    const double middle = 0.5 * (t0 + t1);
    const double half = 0.5 * (t1 - t0);
    double sum = 0.0;
    for (std::size_t i = 0; i < kNodes.size(); ++i) {
      for (const double side : {-1.0, 1.0}) {
        const double t = middle + side * half * kNodes[i];
        const double y = y0_ + (y1_ - y0_) * 0.5 * (1.0 - std::cos(t));
        sum += kWeights[i] * half * section(y) * 0.5 * (y1_ - y0_) * std::sin(t);
      }
    }
    return sum;
  }

  double refined(double t0, double t1, double whole, double tolerance, int depth) {
    constexpr int kDeepest = 14;
    const double middle = 0.5 * (t0 + t1);
    const double left = gauss(t0, middle);
    const double right = gauss(middle, t1);
    if (depth >= kDeepest || std::abs(left + right - whole) <= tolerance) return left + right;
    return refined(t0, middle, left, 0.5 * tolerance, depth + 1) +
           refined(middle, t1, right, 0.5 * tolerance, depth + 1);
  }

  const PlanarStock& stock_;
  PlanarStock::Nearby& near_;
  Heights heights_;
  double y0_ = 0.0, y1_ = 0.0;
};

}  // namespace

double PlanarStock::volume(double relative) const {
  Nearby near;
  const Vec2 lo = xy(box_.lo);
  const Vec2 hi = xy(box_.hi);
  const geometry::Vec3 size = box_.size();
  const double allowed = relative * size.x * size.y * size.z;
  double sum = 0.0;
  for (int row = 0; row < ny_; ++row) {
    const double from = lo.y + row * tile_mm_;
    const double to = std::min(hi.y, from + tile_mm_);
    if (!(to > from)) continue;
    gather({lo.x, from + 1e-3 * tile_mm_}, {hi.x, to - 1e-3 * tile_mm_}, near);
    std::vector<double> corners{from, to};
    const auto corner = [&](double y) {
      if (y > from && y < to) corners.push_back(y);
    };
    for (const std::uint32_t id : near.trails) {
      const Trail& t = trails_[id];
      for (const double end : {t.a.y, t.b.y}) {
        corner(end - t.radius_mm);
        corner(end + t.radius_mm);
        if (t.arc) continue;
        corner(end - t.along.x * t.radius_mm);
        corner(end + t.along.x * t.radius_mm);
      }
      if (!t.arc) continue;
      for (const double r : {t.path_radius_mm + t.radius_mm, std::abs(t.path_radius_mm - t.radius_mm)}) {
        corner(t.centre.y - r);
        corner(t.centre.y + r);
      }
    }
    std::sort(corners.begin(), corners.end());
    Rows rows(*this, near);
    for (std::size_t i = 0; i + 1 < corners.size(); ++i) {
      if (corners[i + 1] - corners[i] > kTouch)
        sum +=
            rows.between(corners[i], corners[i + 1], allowed / (ny_ * static_cast<double>(corners.size())));
    }
  }
  return sum;
}

}  // namespace capstan::stock
