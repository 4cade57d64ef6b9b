#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "planner/ground/base/stopping.h"
#include "planner/making/toolpath/section/section.h"

namespace capstan::toolpath {

using geometry::Vec2;

namespace {

constexpr double kTouches = 1e-4;   ///< mm; nearer than this the cutter is at the point
constexpr double kReached = 0.002;  ///< mm; what stays farther from every pass is out of reach
constexpr int kPlaces = 1500;

/// Points of the finished surface, from the middle outwards and up.
std::vector<Vec2> surface_points(const Section& s) {
  double length = 0.0;
  for (std::size_t i = 1; i < s.wall.size(); ++i) length += norm(s.wall[i] - s.wall[i - 1]);
  const double step = length / kPlaces;
  std::vector<Vec2> out;
  const std::size_t first = s.floor ? 0 : s.wall.size() - 2;  // an open bottom has no surface
  for (std::size_t i = first; i + 1 < s.wall.size(); ++i) {
    const Vec2 d = s.wall[i + 1] - s.wall[i];
    const int n = std::max(1, static_cast<int>(std::ceil(norm(d) / step)));
    for (int k = 0; k < n; ++k) out.push_back(s.wall[i] + (static_cast<double>(k) / n) * d);
  }
  out.push_back(s.wall.back());
  return out;
}

/// Lowest places of the cutter, from outside to the middle.
std::vector<SectionPass> lowest_places(const Section& s, const Tip& tip) {
  std::vector<double> us{0.0};
  const double most = s.half_width_mm();
  for (int i = 1; i <= kPlaces; ++i) us.push_back(most * i / kPlaces);
  for (const Vec2 p : s.wall) us.push_back(p.x - tip.radius_mm);  // beside upright walls
  std::erase_if(us, [](double u) { return u < 0.0 || (u > 0.0 && u < kLeastU); });
  std::sort(us.begin(), us.end(), std::greater<>());
  std::vector<SectionPass> out;
  for (const double u : us) {
    tick(4);
    out.push_back({u, drop(s, tip, u)});
  }
  return out;
}

class Finisher {
 public:
  Finisher(const Section& s, const Tip& tip, double scallop)
      : section_(s),
        tip_(tip),
        scallop_(scallop),
        points_(surface_points(s)),
        places_(lowest_places(s, tip)) {
    best_.assign(points_.size(), 1e300);
    for (const SectionPass& p : places_) {
      tick(16);  // some 1,500 points
      std::size_t at = 0;
      double nearest = 1e300;
      for (std::size_t k = 0; k < points_.size(); ++k) {
        const double g = gap_to(tip_, p, points_[k]);
        best_[k] = std::min(best_[k], g);
        if (g < nearest) {
          nearest = g;
          at = k;
        }
      }
      contact_.push_back(at);
    }
  }

  Finishing run(double down) {
    Finishing out;
    std::size_t i = first();
    const SectionPass top = places_[i];
    if (down > 0.0) {
      for (double h = section_.depth_mm - down; h > top.height_mm + 1e-6; h -= down)
        out.passes.push_back({top.u_mm, h});
    }
    out.passes.push_back(top);
    while (i + 1 < places_.size() && !covered(i, i, 0)) {
      std::size_t j = i + 1;
      while (j + 1 < places_.size() && near_enough(i, j + 1, down)) ++j;
      out.passes.push_back(places_[j]);
      i = j;
    }
    for (const double b : best_) out.rest_mm = std::max(out.rest_mm, b);
    return out;
  }

 private:
  /// The innermost place from which the cutter still reaches the upper edge.
  [[nodiscard]] std::size_t first() const {
    std::size_t at = 0;
    for (std::size_t i = 0; i < places_.size(); ++i) {
      tick();
      if (gap_to(tip_, places_[i], section_.wall.back()) <= kTouches) at = i;
    }
    return at;
  }

  [[nodiscard]] bool near_enough(std::size_t i, std::size_t j, double down) const {
    if (down > 0.0 && places_[i].height_mm - places_[j].height_mm > down) return false;
    return covered(i, j, contact_[j]);
  }

  /// True if passes i and j leave at most the scallop between i's contact and the given point.
  [[nodiscard]] bool covered(std::size_t i, std::size_t j, std::size_t to) const {
    tick(16);  // some 1,500 points at most
    const std::size_t lo = std::min(to, contact_[i]);
    const std::size_t hi = std::max(to, contact_[i]);
    for (std::size_t k = lo; k <= hi; ++k) {
      if (best_[k] > kReached) continue;
      if (std::min(gap_to(tip_, places_[i], points_[k]), gap_to(tip_, places_[j], points_[k])) > scallop_)
        return false;
    }
    return true;
  }

  const Section& section_;
  Tip tip_;
  double scallop_;
  std::vector<Vec2> points_;
  std::vector<SectionPass> places_;
  std::vector<double> best_;          // of each point over all places
  std::vector<std::size_t> contact_;  // of each place
};

}  // namespace

Finishing finishing(const Section& s, const Tip& tip, double scallop_mm, double down_mm) {
  if (!(tip.corner_mm > 0.0)) throw std::logic_error("finishing passes need a rounded cutter");
  return Finisher(s, tip, std::max(scallop_mm, kReached)).run(down_mm);
}

}  // namespace capstan::toolpath
