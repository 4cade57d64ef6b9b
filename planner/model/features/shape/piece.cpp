#include <algorithm>
#include <array>
#include <cmath>

#include "planner/model/features/raw_piece.h"
#include "planner/model/features/shape/build.h"

// The piece as the reading of placements asks for it: the raw piece where the file states one, else what the
// plain features span.

namespace capstan::model::shape {

using geometry::Box3;
using geometry::Vec3;

namespace {

constexpr double kBeyond = 0.01;    // mm over the piece's edge that count as on it; default, unsourced
constexpr double kParallel = 1e-6;  // sine of the angle below which a line runs along a side

}  // namespace

Vec3 middle(const FeatureShape& s, double z) {
  if (s.area.empty()) return s.frame.to_parent({0.0, 0.0, z});
  const auto b = geometry::bounds(s.area);
  return s.frame.to_parent({0.5 * (b.lo.x + b.hi.x), 0.5 * (b.lo.y + b.hi.y), z});
}

geometry::Box2 in_plan(const Box3& box, const geometry::Placement& frame) {
  const geometry::Placement in = inverse(frame);
  geometry::Box2 out;
  for (const double x : {box.lo.x, box.hi.x}) {
    for (const double y : {box.lo.y, box.hi.y}) {
      for (const double z : {box.lo.z, box.hi.z}) {
        const geometry::Vec2 p = xy(in.to_parent({x, y, z}));
        out.lo = {std::min(out.lo.x, p.x), std::min(out.lo.y, p.y)};
        out.hi = {std::max(out.hi.x, p.x), std::max(out.hi.y, p.y)};
      }
    }
  }
  return out;
}

void Piece::find() {
  if (known_) return;
  known_ = true;
  if (const auto raw = stated_raw(m_)) {
    box_ = *raw;
    stated_ = true;
    return;
  }
  // What the plain features span; steps and outside profiles may be drawn far beyond the piece.
  for (const AnyRef f : m_.all_below(TypeId::kTwo5dManufacturingFeature)) {
    if (m_.holds<CompoundFeature>(f) || m_.holds<ReplicateFeature>(f) || m_.holds<Thread>(f)) continue;
    if (m_.holds<Boss>(f) || !holders(m_, f).empty()) continue;
    const auto shapes = any(m_, f, Within{{}, {}, 0, false, this});
    if (!shapes) continue;
    for (const FeatureShape& s : *shapes) {
      if (s.area.empty() || model::has(s.kind, ShapeTrait::kOutwards)) continue;
      const auto b = geometry::bounds(s.area);
      for (const double x : {b.lo.x, b.hi.x}) {
        for (const double y : {b.lo.y, b.hi.y}) {
          for (const double z : {0.0, -s.depth_mm}) box_.add(s.frame.to_parent({x, y, z}));
        }
      }
    }
  }
}

bool Piece::has(Vec3 p) {
  find();
  if (box_.empty()) return true;
  const bool across = p.x > box_.lo.x - kBeyond && p.x < box_.hi.x + kBeyond && p.y > box_.lo.y - kBeyond &&
                      p.y < box_.hi.y + kBeyond;
  return across && (!stated_ || (p.z > box_.lo.z - kBeyond && p.z < box_.hi.z + kBeyond));
}

bool Piece::meets(const FeatureShape& s, bool top_too) {
  find();
  if (box_.empty()) return true;
  // The axis from top to bottom, clipped to the box (Liang and Barsky). Where no raw piece is stated nobody
  // knows how thick it is: then the whole line counts.
  const Vec3 a = middle(s, 0.0);
  const Vec3 d = middle(s, -1.0) - a;
  if (top_too && stated_ && !has(a)) return false;
  double from = stated_ ? 0.0 : -1e9;
  double to = stated_ ? std::max(s.depth_mm, kBeyond) : 1e9;
  for (const auto& [start, along, lo, hi] :
       {std::array{a.x, d.x, box_.lo.x, box_.hi.x}, std::array{a.y, d.y, box_.lo.y, box_.hi.y},
        std::array{a.z, d.z, box_.lo.z, box_.hi.z}}) {
    if (std::abs(along) < kParallel) {
      if (start < lo - kBeyond || start > hi + kBeyond) return false;
      continue;
    }
    const double t0 = (lo - start) / along;
    const double t1 = (hi - start) / along;
    from = std::max(from, std::min(t0, t1));
    to = std::min(to, std::max(t0, t1));
  }
  return from < to - kParallel;
}

bool Piece::holds(const FeatureShape& s) {
  find();
  if (!meets(s, true)) return false;
  if (box_.empty() || s.area.empty() || s.open) return true;
  const auto b = geometry::bounds(s.area);
  Box3 there;
  for (const double x : {b.lo.x, b.hi.x}) {
    for (const double y : {b.lo.y, b.hi.y}) there.add(s.frame.to_parent({x, y, 0.0}));
  }
  // Across the axis only: this function does not judge the depth.
  const Vec3 z = s.frame.z;
  const auto within = [](double along, double lo, double hi, double least, double most) {
    return std::abs(along) > 0.5 || (lo > least - kBeyond && hi < most + kBeyond);
  };
  return within(z.x, there.lo.x, there.hi.x, box_.lo.x, box_.hi.x) &&
         within(z.y, there.lo.y, there.hi.y, box_.lo.y, box_.hi.y) &&
         within(z.z, there.lo.z, there.hi.z, box_.lo.z, box_.hi.z);
}

}  // namespace capstan::model::shape
