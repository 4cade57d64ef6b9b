#include "planner/making/toolpath/freeform/rim.h"

#include <algorithm>
#include <cmath>

// The contact is found from the tip's height z(x, y): the outline's normal there has the slope of z, so that
// the contact lies at the axis plus what the outline touches a plane of that slope at, grown by the
// allowance, along z's gradient. Derived.

namespace capstan::toolpath::freeform {
namespace {

using geometry::Vec2;

constexpr double kPerRadius = 32.0;  ///< places looked at; what a rim lacks at most is R / (2 x 32^2)

class Rim {
 public:
  Rim(const DropCutter& drop, const MillEnd& cutter, double allowance_mm)
      : drop_(drop), cutter_(cutter), allowance_(allowance_mm) {}

  /// Whether the cutter, let down there, touches the surface within its rim.
  [[nodiscard]] bool touches_within(Vec2 p) const {
    const double step = 1e-4 * cutter_.radius();
    const double z = at(p), zx = at(p + Vec2{step, 0.0}), zy = at(p + Vec2{0.0, step});
    if (z == DropCutter::kNoContact || zx == DropCutter::kNoContact || zy == DropCutter::kNoContact)
      return false;
    const Vec2 slope = (1.0 / step) * Vec2{zx - z, zy - z};
    const double tangent = norm(slope);
    if (tangent < 1e-9) return within(p);
    const double sine = tangent / std::sqrt(1.0 + tangent * tangent);
    return within(p + ((cutter_.touch_radius(tangent) + allowance_ * sine) / tangent) * slope);
  }

  [[nodiscard]] bool within(Vec2 p) const {
    const double inset = 1e-3 * cutter_.radius();
    const geometry::Box3& b = drop_.bounds();
    return p.x > b.lo.x + inset && p.x < b.hi.x - inset && p.y > b.lo.y + inset && p.y < b.hi.y - inset;
  }

  /// From u on along a line, as long as the cutter touches within; `step` may be negative.
  [[nodiscard]] double drawn_on(const Hatch& h, double v, double u, double step) const {
    double end = u;
    for (int k = 1; k <= static_cast<int>(kPerRadius); ++k) {
      if (!touches_within(h.place(u + k * step, v))) break;
      end = u + k * step;
    }
    return end;
  }

 private:
  [[nodiscard]] double at(Vec2 p) const { return drop_.drop(cutter_, p.x, p.y, allowance_); }

  const DropCutter& drop_;
  const MillEnd& cutter_;
  double allowance_;
};

}  // namespace

Hatch beyond_rim(const Hatch& inside, const DropCutter& drop, const MillEnd& cutter, double allowance_mm) {
  if (inside.stripes.empty() || !(inside.spacing_mm > 0.0)) return inside;
  const Rim rim(drop, cutter, allowance_mm);
  const double step = cutter.radius() / kPerRadius;
  // Lines beside the first or the last one, where the cutter touches within.
  const auto beside = [&](const Stripe& outermost, double lo, double hi, int way, std::vector<Stripe>& out) {
    const int most = static_cast<int>(cutter.radius() / inside.spacing_mm);
    const int places = std::max(1, static_cast<int>(std::ceil((hi - lo) / step)));
    for (int k = 1; k <= most; ++k) {
      const double v = outermost.v + way * k * inside.spacing_mm;
      const std::size_t before = out.size();
      int first = -1;
      for (int i = 0; i <= places + 1; ++i) {
        const bool on = i <= places && rim.touches_within(inside.place(lo + (hi - lo) * i / places, v));
        if (on && first < 0) first = i;
        if (on || first < 0) continue;
        if (i - 1 > first)
          out.push_back({outermost.line + way * k, v, lo + (hi - lo) * first / places,
                         lo + (hi - lo) * (i - 1) / places});
        first = -1;
      }
      if (out.size() == before) return;
    }
  };
  Hatch out = inside;
  double lo = 1e300, hi = -1e300;
  for (Stripe& s : out.stripes) {
    s.lo = rim.drawn_on(inside, s.v, s.lo, -step);
    s.hi = rim.drawn_on(inside, s.v, s.hi, step);
    lo = std::min(lo, s.lo);
    hi = std::max(hi, s.hi);
  }
  std::vector<Stripe> more;
  beside(inside.stripes.front(), lo, hi, -1, more);
  beside(inside.stripes.back(), lo, hi, 1, more);
  out.stripes.insert(out.stripes.end(), more.begin(), more.end());
  std::stable_sort(out.stripes.begin(), out.stripes.end(), [](const Stripe& a, const Stripe& b) {
    return a.line != b.line ? a.line < b.line : a.lo < b.lo;
  });
  return out;
}

}  // namespace capstan::toolpath::freeform
