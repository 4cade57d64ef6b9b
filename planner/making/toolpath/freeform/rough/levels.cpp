#include "planner/making/toolpath/freeform/rough/levels.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <utility>

#include "planner/ground/base/stopping.h"
#include "planner/making/toolpath/freeform/upright_step.h"

// A place whose lowest height of the tip is h keeps a terrace of z - h, where z is the lowest level above h.
// It is content with any level of [h, h + b], where b is the bound of terraces at its slope. As few levels as
// every place needs are found from below: the upper end of the interval that ends first is a level, and all
// intervals that hold it are content (stabbing of intervals). A level is then lowered to the highest of the
// places that need it.
//
// Cut from above in steps of the axial depth, a level is cleared once in its whole area. The levels between
// two such steps are cut from below: each takes the strip between its own border and that of the level
// beneath. So a group of levels costs the area of its highest, and more where its lowest is small beside
// that; the groups are those that together cost least (dynamic programming).

namespace capstan::toolpath::freeform {
namespace {

constexpr double kSlack = 1e-9;  // mm: steps may exceed the axial depth by so much, by rounding
constexpr double kAbove = 1e-6;  // mm: a level just at a floor is not below it

/// Terraces that any place may keep, in height: so much square to a surface of this slope, or what leaves
/// cusps between two arcs of the cutter's corner that are no higher.
///
///     b = t / cos(s)    and    b = 2 sqrt(t (2 r - t)) sin(s)
///
/// Source  derived: a step of height b on a slope s stands b cos(s) square to it; two circles of radius r
///         whose centres lie b / sin(s) apart along the slope meet t above it.
double step_of(double terrace, double corner, double slope) {
  const double cosine = 1.0 / std::sqrt(1.0 + slope * slope);
  const double t = std::min(terrace, corner);
  return std::max(terrace / cosine, 2.0 * std::sqrt(t * (2.0 * corner - t)) * slope * cosine);
}

/// What passes over level ground leave between them, of a cutter with a corner.
double cusp_of(const FreeformJob& task) {
  const double corner = task.cutter.corner_radius_mm;
  const double beyond =
      std::clamp(0.5 * (task.stepover_mm - task.cutter.cutting_diameter_mm) + corner, 0.0, corner);
  return corner - std::sqrt(corner * corner - beyond * beyond);
}

/// The least steep of the ways from a grid point to its neighbours, along x and y.
double slope_at(const DropGrid& g, int ix, int iy) {
  const double here = g.at(ix, iy);
  const auto least = [&](int dx, int dy) {
    double out = -1.0;
    for (const int side : {-1, 1}) {
      const int x = ix + side * dx, y = iy + side * dy;
      if (x < 0 || y < 0 || x >= g.nx || y >= g.ny) continue;
      const double rise = std::abs(g.at(x, y) - here) / g.step_mm;
      if (std::isfinite(rise) && (out < 0.0 || rise < out)) out = rise;
    }
    return std::max(out, 0.0);
  };
  return std::hypot(least(1, 0), least(0, 1));
}

/// An interval in which a place wants a level.
struct Wish {
  double h = 0.0, most = 0.0;
};

/// Of the grid points, and between each two of them close enough together.
std::vector<Wish> wishes_of(const FreeformJob& task, const DropGrid& reach) {
  constexpr double kPart = 0.1;        // of a terrace, between two wishes; so much less is asked
  constexpr double kLeastShare = 0.3;  // of the terrace, beside cusps; default, unsourced
  const double corner = task.cutter.corner_radius_mm;
  const double terrace = std::max(kLeastShare * task.terrace_mm, task.terrace_mm - cusp_of(task));
  std::vector<Wish> out;
  const auto wish = [&](double h, double step) {
    const double most = h + (1.0 - kPart) * step;
    if (most < task.top_z_mm) out.push_back({h, most});
  };
  for (int iy = 0; iy < reach.ny; ++iy) {
    for (int ix = 0; ix < reach.nx; ++ix) {
      const double h = reach.at(ix, iy);
      if (!(h < task.top_z_mm)) continue;  // not a number: beside the area
      tick();
      const double step = step_of(terrace, corner, slope_at(reach, ix, iy));
      wish(h, step);
      for (const auto& [x, y] : {std::pair{ix + 1, iy}, {ix, iy + 1}}) {
        if (x >= reach.nx || y >= reach.ny || !(reach.at(x, y) < task.top_z_mm)) continue;
        const double rise = reach.at(x, y) - h;
        const double own = std::max(step, step_of(terrace, corner, std::abs(rise) / reach.step_mm));
        const int n = static_cast<int>(std::ceil(std::abs(rise) / (kPart * own)));
        for (int k = 1; k < n; ++k) wish(h + rise * k / n, own);
      }
    }
  }
  std::sort(out.begin(), out.end(),
            [](const Wish& a, const Wish& b) { return std::pair(a.most, a.h) < std::pair(b.most, b.h); });
  return out;
}

/// Adds the levels that the wishes still need, sorted from above.
void add_levels(const std::vector<Wish>& wishes, std::vector<double>& levels) {
  std::sort(levels.begin(), levels.end());
  std::vector<double> own;
  double last = -1e300;  // of `own`: the wishes are in order of their upper ends
  for (std::size_t i = 0; i < wishes.size(); ++i) {
    const Wish& w = wishes[i];
    const auto given = std::lower_bound(levels.begin(), levels.end(), w.h);
    tick();
    if (last >= w.h || (given != levels.end() && *given <= w.most)) continue;
    double highest = w.h;
    for (std::size_t k = i; k < wishes.size(); ++k) {
      if (k % 64 == 0) tick();  // a turn takes a nanosecond
      if (wishes[k].h <= w.most) highest = std::max(highest, wishes[k].h);
    }
    last = std::min(highest + kAbove, w.most);
    own.push_back(last);
  }
  levels.insert(levels.end(), own.begin(), own.end());
  std::sort(levels.begin(), levels.end(), std::greater<>());
}

/// How many places the tip may go down to at each of these levels.
std::vector<double> areas_of(const DropGrid& reach, const std::vector<double>& levels) {
  std::vector<double> h;
  for (const double z : reach.z) {
    if (std::isfinite(z)) h.push_back(z);
  }
  std::sort(h.begin(), h.end());
  std::vector<double> out;
  for (const double z : levels) {
    tick();
    out.push_back(static_cast<double>(std::upper_bound(h.begin(), h.end(), z) - h.begin()));
  }
  return out;
}

/// The levels, given from above, in the order in which they are cut.
std::vector<double> in_groups(const std::vector<double>& levels, const std::vector<double>& areas, double top,
                              double most) {
  /// A pocket that is cut before what lies around it is cut out of the solid, by ramps and slots: where the
  /// lowest level has less than this share of the highest one's area, so much of that is added. Default,
  /// unsourced.
  constexpr double kInSolid = 0.5;
  const std::size_t n = levels.size();
  std::vector<double> cost(n + 1, 1e300);
  std::vector<std::size_t> begin(n + 1, 0);
  cost[0] = 0.0;
  for (std::size_t end = 1; end <= n; ++end) {
    for (std::size_t k = end; k-- > 0;) {
      const double from = k == 0 ? top : levels[k - 1];
      // A level by itself is as deep as it is.
      if (k + 1 < end && from - levels[end - 1] > most + kSlack) break;
      tick();
      // Of equal ones the fewest groups.
      const double solid = areas[end - 1] < kInSolid * areas[k] ? kInSolid * areas[k] : 0.0;
      const double c = cost[k] + areas[k] + solid + 1.0;
      if (c < cost[end]) {
        cost[end] = c;
        begin[end] = k;
      }
    }
  }
  std::vector<double> out;
  for (std::size_t end = n; end > 0; end = begin[end]) {
    // From the back: the group's highest level comes last.
    for (std::size_t k = begin[end]; k < end; ++k) out.push_back(levels[k]);
  }
  std::reverse(out.begin(), out.end());
  return out;
}

/// Puts levels between those that lie farther apart than `most`, evenly.
std::vector<double> split(const std::vector<double>& levels, double top, double most) {
  std::vector<double> out;
  double from = top;
  for (const double to : levels) {
    if (from - to < kNothing) continue;
    const int n = std::max(1, static_cast<int>(std::ceil((from - to - kSlack) / most)));
    for (int k = 1; k < n; ++k) out.push_back(from - (from - to) * k / n);
    out.push_back(to);
    from = to;
  }
  return out;
}

}  // namespace

std::vector<double> feet_of_walls(const DropGrid& reach, const DropCutter& drop, const MillEnd& cutter,
                                  double allowance_mm, double lowest_mm, double top_mm) {
  std::vector<double> out;
  for (int iy = 0; iy < reach.ny; ++iy) {
    for (int ix = 0; ix < reach.nx; ++ix) {
      const double h = reach.at(ix, iy);
      if (!(h >= lowest_mm) || !(h < top_mm)) continue;
      tick();
      const auto wall = [&](int dx, int dy) {
        const int x = ix + dx, y = iy + dy;
        return x >= 0 && y >= 0 && x < reach.nx && y < reach.ny &&
               reach.at(x, y) - h > kSteepTangent * reach.step_mm &&
               has_upright_step(drop, cutter, allowance_mm, reach.place(ix, iy), reach.place(x, y));
      };
      if (wall(1, 0) || wall(-1, 0) || wall(0, 1) || wall(0, -1)) out.push_back(h);
    }
  }
  std::sort(out.begin(), out.end());
  out.erase(std::unique(out.begin(), out.end(), [](double a, double b) { return b - a < kNothing; }),
            out.end());
  return out;
}

Levels levels_of(const FreeformJob& task, const DropGrid& reach, double lowest_mm, double margin_mm,
                 const std::vector<double>& feet_mm) {
  Levels made;
  std::vector<double>& out = made.z_mm;
  const double most = task.axial_depth_mm;
  if (task.floors_z_mm.empty() && feet_mm.empty() && !(task.terrace_mm > 0.0)) {
    const int n = std::max(1, static_cast<int>(std::ceil((task.top_z_mm - lowest_mm) / most - 1e-9)));
    for (int k = 1; k < n; ++k) out.push_back(task.top_z_mm - k * most);
    out.push_back(lowest_mm);
    return made;
  }
  std::vector<double> stops = {lowest_mm};
  for (const double floor : task.floors_z_mm) {
    const double z = floor + task.allowance_mm + margin_mm + kAbove;
    if (z < lowest_mm + kAbove || z > task.top_z_mm - kNothing) continue;
    stops.push_back(z);
    made.floors_mm.push_back(z);
    // Walls first, down to what is left on the floor.
    if (task.left_mm && z + *task.left_mm < task.top_z_mm) stops.push_back(z + *task.left_mm);
  }
  if (task.terrace_mm > 0.0) {
    add_levels(wishes_of(task, reach), stops);
  } else if (!feet_mm.empty()) {
    constexpr double kLeftToBallMm = 1.0;  // default, unsourced
    std::vector<Wish> wishes;
    for (const double h : feet_mm) wishes.push_back({h, h + kLeftToBallMm});
    add_levels(wishes, stops);
  }
  std::sort(stops.begin(), stops.end(), std::greater<>());
  out = split(stops, task.top_z_mm, most);
  if (task.terrace_mm > 0.0) out = in_groups(out, areas_of(reach, out), task.top_z_mm, most);
  return made;
}

}  // namespace capstan::toolpath::freeform
