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
/// Of an area: limbs that are alike but for rounding.
constexpr double kSameArea = 1e-6;

bool leaves_a_ridge(const Region& piece, const Region& next, double cover_mm) {
  const Region open = inset(piece, cover_mm, kInnerChord);
  if (open.empty()) return false;
  return next.empty() ||
         geometry::area(geometry::subtract(open, geometry::offset(next, cover_mm, kInnerChord))) > kCrumb;
}

Region islands_of(const Region& piece) {
  Region out;
  for (const auto& loop : piece.loops) {
    if (geometry::signed_area(loop) < 0.0) out.loops.push_back(loop);
  }
  return out;
}

bool begins_within(double near_mm, const Region& limb, const Region& loops) {
  if (loops.empty()) return false;
  for (const auto& loop : limb.loops) {
    for (const Vec2 p : loop) {
      if (geometry::distance_to_boundary(loops, p) <= near_mm) return true;
    }
  }
  return false;
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

/// The piece with its inner corners rounded by kLeastTurn; as it is where it would fall apart or where what
/// the ring around it does not reach would stay uncut.
Region rounded(const Region& piece, const Region& around, double cover_mm) {
  const Region reached = geometry::intersect(inset(around, cover_mm, kInnerChord),
                                             geometry::offset(piece, cover_mm, kInnerChord));
  for (const double part : {1.0, 0.5}) {
    const double radius = part * kLeastTurn * cover_mm;
    Region out = geometry::offset(inset(piece, radius, kInnerChord), radius, kInnerChord);
    if (out.loops.size() != piece.loops.size()) continue;
    const Region left = geometry::subtract(reached, geometry::offset(out, cover_mm, kInnerChord));
    if (geometry::area(left) <= kCrumb) return out;
  }
  return piece;
}

}  // namespace

std::vector<Ring> rings(const Region& centres, double step_mm, double cover_mm) {
  std::vector<Ring> out;
  for (const Region& piece : geometry::pieces(centres)) {
    out.push_back({.piece = piece, .followed = piece, .depth = 0, .parent = out.size(), .children = {}});
  }
  for (std::size_t i = 0; i < out.size(); ++i) {  // out grows while it is walked
    for (Region& piece : geometry::pieces(next_inset(out[i].piece, step_mm, cover_mm))) {
      // Crumbs of rounding are no rings.
      if (geometry::area(piece) < 1e-6) continue;
      out[i].children.push_back(out.size());
      Region followed = rounded(piece, out[i].piece, cover_mm);
      out.push_back({.piece = std::move(piece),
                     .followed = std::move(followed),
                     .depth = out[i].depth + 1,
                     .parent = i,
                     .children = {}});
    }
  }
  return out;
}

std::vector<Turn> turns(const std::vector<Ring>& all, double near_mm,
                        const std::function<bool(const Ring& limb)>& from_outside) {
  struct Visit {
    Turn turn;
    bool now = false;  // what comes before it is done
  };
  std::vector<Turn> out;
  std::vector<Visit> stack;  // taken from the end
  for (std::size_t i = all.size(); i-- > 0;) {
    if (all[i].depth == 0) stack.push_back({{i}});
  }
  const auto area = [&](std::size_t c) { return geometry::area(all[c].piece); };
  while (!stack.empty()) {
    const Visit v = stack.back();
    stack.pop_back();
    const auto& limbs = all[v.turn.ring].children;
    if (v.now || v.turn.inwards) out.push_back(v.turn);
    if (v.now) continue;
    std::size_t largest = 0;
    for (std::size_t k = 1; k < limbs.size(); ++k) {
      if (area(limbs[k]) > (1.0 + kSameArea) * area(limbs[largest])) largest = k;
    }
    const Region islands = islands_of(all[v.turn.ring].piece);
    std::vector<Visit> before, between, after;
    for (std::size_t k = 0; k < limbs.size(); ++k) {
      const std::size_t c = limbs[k];
      const bool inwards = v.turn.inwards || (k != largest && from_outside(all[c]));
      (!inwards                                                           ? before
       : !v.turn.inwards && begins_within(near_mm, all[c].piece, islands) ? between
                                                                          : after)
          .push_back({{c, inwards}});
    }
    if (!v.turn.inwards) {
      const std::size_t i = v.turn.ring;
      if (between.empty()) {
        before.push_back({{i}, true});
      } else {
        before.push_back({{i, false, Loops::kIslands}, true});
        between.push_back({{i, false, Loops::kOutside}, true});
      }
    }
    for (const auto* part : {&after, &between, &before})
      stack.insert(stack.end(), part->rbegin(), part->rend());
  }
  return out;
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
