#include "planner/making/toolpath/region/area/rings.h"

#include <algorithm>
#include <cmath>

#include "planner/making/toolpath/region/area/track.h"
#include "planner/making/toolpath/region/area/work_area.h"

namespace capstan::toolpath {

using geometry::Region;
using geometry::Vec2;

namespace {

/// What is left between the ring round `piece` and what comes after it, mm2. Less than this is rounding.
constexpr double kCrumb = 1e-4;

bool leaves_a_ridge(const Region& piece, const Region& next, double cover_mm) {
  const Region open = inset(piece, cover_mm, kInnerChord);
  if (open.empty()) return false;
  return next.empty() ||
         geometry::area(geometry::subtract(open, geometry::offset(next, cover_mm, kInnerChord))) > kCrumb;
}

/// The piece's next inset: the widest of three steps that leaves no ridge.
Region next_inset(const Region& piece, double step_mm, double cover_mm) {
  if (step_mm > cover_mm) {
    for (const double step : {step_mm, 0.5 * (step_mm + cover_mm)}) {
      Region next = inset(piece, step, kInnerChord);
      if (!leaves_a_ridge(piece, next, cover_mm)) return next;
    }
  }
  return inset(piece, std::min(step_mm, cover_mm), kInnerChord);
}

}  // namespace

std::vector<Ring> rings(const Region& centres, double step_mm, double cover_mm) {
  std::vector<Ring> out;
  for (Region& piece : geometry::pieces(centres)) {
    out.push_back({.piece = std::move(piece), .depth = 0, .parent = out.size(), .children = {}});
  }
  for (std::size_t i = 0; i < out.size(); ++i) {  // out grows while it is walked
    for (Region& piece : geometry::pieces(next_inset(out[i].piece, step_mm, cover_mm))) {
      // Crumbs of rounding are no rings.
      if (geometry::area(piece) < 1e-6) continue;
      out[i].children.push_back(out.size());
      out.push_back({.piece = std::move(piece), .depth = out[i].depth + 1, .parent = i, .children = {}});
    }
  }
  return out;
}

std::vector<std::size_t> inside_out(const std::vector<Ring>& all) {
  std::vector<std::size_t> order;
  std::vector<std::size_t> stack;
  for (std::size_t i = 0; i < all.size(); ++i) {
    if (all[i].depth == 0) stack.push_back(i);
  }
  while (!stack.empty()) {  // parents first; turned round at the end
    const std::size_t i = stack.back();
    stack.pop_back();
    order.push_back(i);
    for (const std::size_t c : all[i].children) stack.push_back(c);
  }
  std::reverse(order.begin(), order.end());
  return order;
}

Deepest deepest(const Region& piece) {
  if (piece.empty()) return {};
  const auto box = geometry::bounds(piece);
  double lo = 0.0;
  double hi = 0.5 * std::min(box.hi.x - box.lo.x, box.hi.y - box.lo.y);
  Region best = piece;
  if (Region nearly = inset(piece, hi * 0.999, kInnerChord); !nearly.empty()) {
    best = std::move(nearly);
    lo = hi * 0.999;
  }
  while (hi - lo > 0.01 * hi && hi - lo > 1e-3) {
    const double middle = 0.5 * (lo + hi);
    Region r = inset(piece, middle, kInnerChord);
    if (r.empty()) {
      hi = middle;
    } else {
      lo = middle;
      best = std::move(r);
    }
  }
  const geometry::Loop loop = geometry::pieces(best).front().loops.front();
  Vec2 sum;
  for (const Vec2 p : loop) sum = sum + p;
  Vec2 at = (1.0 / static_cast<double>(loop.size())) * sum;
  if (!geometry::contains(best, at)) at = loop.front();
  return {at, geometry::distance_to_boundary(piece, at)};
}

}  // namespace capstan::toolpath
