#include "planner/making/toolpath/freeform/finish/between.h"

#include <algorithm>
#include <cmath>

// Passes are as far apart as their ridges may be high on a level surface. Where it slopes across them they
// lie farther apart along it: the places of the tip on two neighbouring passes tell how far, for a ball
// touches on both at the same offset from its tip. Where they are too far apart, passes are put between them.

namespace capstan::toolpath::freeform {
namespace {

using geometry::Vec2;
using geometry::Vec3;

struct Place {
  double u = 0.0, z = 0.0;
};

/// A run from above its line: u against z.
std::vector<Place> along(const Run& run, Vec2 u_axis) {
  std::vector<Place> out;
  out.reserve(run.size());
  for (const Vec3& p : run) out.push_back({dot(xy(p), u_axis), p.z});
  return out;
}

/// Heights and slopes of a run at rising places.
class Walk {
 public:
  explicit Walk(const std::vector<Place>& line) : line_(line) {}
  /// The piece that leads on from u. Needs u not below that of the last call, and below the run's end.
  void to(double u) {
    while (i_ + 2 < line_.size() && line_[i_ + 1].u <= u) ++i_;
  }
  [[nodiscard]] double slope() const {
    const double du = line_[i_ + 1].u - line_[i_].u;
    return du > 0.0 ? (line_[i_ + 1].z - line_[i_].z) / du : 0.0;
  }
  [[nodiscard]] double at(double u) const { return line_[i_].z + (u - line_[i_].u) * slope(); }

 private:
  const std::vector<Place>& line_;
  std::size_t i_ = 0;
};

}  // namespace

double ridge_mm(double ball_mm, double apart_mm) {
  const double half = 0.5 * apart_mm;
  return half < ball_mm ? ball_mm - std::sqrt((ball_mm - half) * (ball_mm + half)) : ball_mm;
}

void add_gap(std::vector<Gap>& gaps, const Gap& gap) {
  if (gaps.empty() || gap.lo > gaps.back().hi) {
    gaps.push_back(gap);
    return;
  }
  gaps.back().hi = std::max(gaps.back().hi, gap.hi);
  gaps.back().apart_mm = std::max(gaps.back().apart_mm, gap.apart_mm);
}

std::vector<Gap> wide_gaps(const std::vector<Run>& below, const std::vector<Run>& above, const Hatch& lines,
                           double most_mm) {
  std::vector<Gap> out;
  for (const Run& one : below) {
    const std::vector<Place> p = along(one, lines.u_axis);
    for (const Run& other : above) {
      const std::vector<Place> q = along(other, lines.u_axis);
      const double dv = std::abs(dot(xy(other.front()) - xy(one.front()), lines.v_axis));
      const double lo = std::max(p.front().u, q.front().u), hi = std::min(p.back().u, q.back().u);
      if (!(hi > lo)) continue;
      std::vector<double> at{lo, hi};
      for (const auto* line : {&p, &q}) {
        for (const Place& k : *line) {
          if (k.u > lo && k.u < hi) at.push_back(k.u);
        }
      }
      std::sort(at.begin(), at.end());
      Walk a(p), b(q);
      for (std::size_t i = 0; i + 1 < at.size(); ++i) {
        if (!(at[i + 1] > at[i])) continue;
        a.to(at[i]);
        b.to(at[i]);
        const double slope = std::min(std::abs(a.slope()), std::abs(b.slope()));
        const double dz =
            std::max(std::abs(a.at(at[i]) - b.at(at[i])), std::abs(a.at(at[i + 1]) - b.at(at[i + 1])));
        const double square = dv * dv + dz * dz / (1.0 + slope * slope);
        if (square <= most_mm * most_mm) continue;
        add_gap(out, {at[i], at[i + 1], std::sqrt(square)});
      }
    }
  }
  return out;
}

std::vector<std::pair<double, double>> parts_in(const geometry::Region& area, const Hatch& lines, double v,
                                                const Gap& gap) {
  if (area.empty()) return {{gap.lo, gap.hi}};
  constexpr double kLeastMm = 1e-6;  // as a hatch has it
  std::vector<double> at{gap.lo, gap.hi};
  for (const geometry::Loop& loop : area.loops) {
    for (std::size_t i = 0; i < loop.size(); ++i) {
      const Vec2 a = loop[i], b = loop[(i + 1) % loop.size()];
      const double av = dot(a, lines.v_axis), bv = dot(b, lines.v_axis);
      if ((av <= v) == (bv <= v)) continue;
      const double u = dot(a + ((v - av) / (bv - av)) * (b - a), lines.u_axis);
      if (u > gap.lo && u < gap.hi) at.push_back(u);
    }
  }
  std::sort(at.begin(), at.end());
  std::vector<std::pair<double, double>> out;
  for (std::size_t i = 0; i + 1 < at.size(); ++i) {
    if (at[i + 1] - at[i] > kLeastMm && geometry::contains(area, lines.place(0.5 * (at[i] + at[i + 1]), v)))
      out.emplace_back(at[i], at[i + 1]);
  }
  return out;
}

}  // namespace capstan::toolpath::freeform
