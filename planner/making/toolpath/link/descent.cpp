#include "planner/making/toolpath/link/descent.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace capstan::toolpath {

using geometry::Vec2;

// Each end is off by half a digit in each axis. In the plane the two ends make a piece shorter by sqrt(2)
// digits together; at an arc of half a turn the radius, which is off by half of that, adds pi times as much
// (derived).
Descent::Descent(double slope_rad, double digit_mm)
    : tan_(std::tan(slope_rad)),
      digit_mm_(digit_mm),
      shorter_mm_(std::numbers::sqrt2 * (1.0 + 0.5 * std::numbers::pi) * digit_mm) {}

double Descent::of(double length_mm) const {
  return std::max(0.0, tan_ * (length_mm - shorter_mm_) - digit_mm_);
}

double Descent::of(const Track& t) const {
  double out = 0.0;
  Vec2 last = t.start;
  for (const Segment& s : t.segments) {
    out += of(toolpath::length_of(last, s));
    last = s.to;
  }
  return out;
}

double Descent::length_for(const Track& t, double drop_mm) const {
  double at = 0.0, left = drop_mm;
  Vec2 last = t.start;
  for (const Segment& s : t.segments) {
    if (!(left > 0.0)) break;
    const double length = toolpath::length_of(last, s);
    if (left < of(length)) return at + (left + digit_mm_) / tan_ + shorter_mm_;
    left -= of(length);
    at += length;
    last = s.to;
  }
  return at;
}

}  // namespace capstan::toolpath
