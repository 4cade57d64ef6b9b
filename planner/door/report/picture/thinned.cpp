#include "planner/door/report/picture/thinned.h"

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace capstan::report::picture {
namespace {

using geometry::Vec2;

/// The line with the points that a straight line passes within kThinning left out.
///
/// Source  the sleeve of Zhao and Saalfeld (Linear-time sleeve-fitting polyline simplification, 1997): from
///         an anchor each point leaves a range of directions that pass it near enough.
Polyline without_points_between(const Polyline& line) {
  if (line.size() < 3) return line;
  Polyline out = {line.front()};
  Vec2 towards;  // the first direction from the anchor; angles count from it
  double lo = 0.0, hi = 0.0, farthest = 0.0;
  bool open = true;  // no direction is ruled out yet
  const auto begin_at = [&](Vec2 p) {
    out.push_back(p);
    open = true;
    farthest = 0.0;
  };
  for (std::size_t i = 1; i < line.size(); ++i) {
    Vec2 along = line[i] - out.back();
    double length = geometry::norm(along);
    // A line that turns back keeps the point where it turns.
    if (!open && length < farthest) {
      begin_at(line[i - 1]);
      along = line[i] - out.back();
      length = geometry::norm(along);
    }
    if (length <= kThinning) continue;
    const double half = std::asin(kThinning / length);
    if (!open) {
      const double angle = std::atan2(geometry::cross(towards, along), geometry::dot(towards, along));
      if (angle >= lo && angle <= hi) {
        lo = std::max(lo, angle - half);
        hi = std::min(hi, angle + half);
        farthest = length;
        continue;
      }
      begin_at(line[i - 1]);
      along = line[i] - out.back();
      length = geometry::norm(along);
      if (length <= kThinning) continue;
    }
    towards = along;
    hi = std::asin(kThinning / length);
    lo = -hi;
    farthest = length;
    open = false;
  }
  out.push_back(line.back());
  return out;
}

std::size_t points_of(const std::vector<Polyline>& lines) {
  std::size_t n = 0;
  for (const Polyline& l : lines) n += l.size();
  return n;
}

/// The squares of one size that lines have been drawn over.
class Squares {
 public:
  Squares(const std::vector<Polyline>& lines, double side) : side_(side) {
    Vec2 hi{-1e300, -1e300};
    lo_ = {1e300, 1e300};
    for (const Polyline& l : lines) {
      for (const Vec2 p : l) {
        lo_ = {std::min(lo_.x, p.x), std::min(lo_.y, p.y)};
        hi = {std::max(hi.x, p.x), std::max(hi.y, p.y)};
      }
    }
    wide_ = static_cast<std::size_t>((hi.x - lo_.x) / side) + 1;
    seen_.assign(wide_ * (static_cast<std::size_t>((hi.y - lo_.y) / side) + 1), 0);
  }
  /// Whether a straight line meets a square that none has met; it has met them then.
  bool meets_new(Vec2 a, Vec2 b) {
    const auto n = static_cast<std::size_t>(geometry::norm(b - a) / (0.5 * side_)) + 1;
    bool any = false;
    for (std::size_t i = 0; i <= n; ++i) {
      const Vec2 p = a + (static_cast<double>(i) / static_cast<double>(n)) * (b - a) - lo_;
      std::uint8_t& at =
          seen_[static_cast<std::size_t>(p.y / side_) * wide_ + static_cast<std::size_t>(p.x / side_)];
      any = any || at == 0;
      at = 1;
    }
    return any;
  }

 private:
  double side_;
  Vec2 lo_;
  std::size_t wide_ = 0;
  std::vector<std::uint8_t> seen_;
};

/// Without the pieces that lie over squares that are drawn already.
std::vector<Polyline> drawn_once(const std::vector<Polyline>& lines, double side) {
  Squares squares(lines, side);
  std::vector<Polyline> out;
  for (const Polyline& l : lines) {
    bool goes_on = false;
    for (std::size_t i = 1; i < l.size(); ++i) {
      const bool drawn = squares.meets_new(l[i - 1], l[i]);
      if (drawn && !goes_on) out.push_back({l[i - 1]});
      if (drawn) out.back().push_back(l[i]);
      goes_on = drawn;
    }
  }
  return out;
}

}  // namespace

std::vector<Polyline> thinned(const std::vector<Polyline>& lines, std::size_t most) {
  std::vector<Polyline> out;
  for (const Polyline& l : lines) {
    if (l.empty()) continue;
    Polyline less = without_points_between(l);
    if (less.size() > 2 || geometry::norm(less.back() - less.front()) > kThinning)
      out.push_back(std::move(less));
  }
  for (double side = 5.0 * kThinning; points_of(out) > most && side < 1e4; side *= 2.0)
    out = drawn_once(out, side);
  return out;
}

}  // namespace capstan::report::picture
