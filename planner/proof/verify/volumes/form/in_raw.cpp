#include "planner/proof/verify/volumes/form/in_raw.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "planner/ground/base/number.h"

// Forms against the piece that they are cut from. What lies above a form's top is asked for by points, over
// its area and at several heights. A point is open outside the piece and where some form takes it away. It
// counts as solid when its neighbours, a hair aside, are solid, too: in corners where two outlines meet
// something always stays. Beside what an outside leaves standing nothing of the part is higher than that:
// above it is raw piece only.

namespace capstan::verify::volumes {

using geometry::Box3;
using geometry::Vec2;
using geometry::Vec3;
using model::ShapeKind;

namespace {

constexpr double kSquare = 1.0 - 1e-9;
constexpr int kAcross = 32;       // points along a side; default, unsourced
constexpr int kUp = 6;            // heights; default, unsourced
constexpr double kAsideMm = 0.2;  // neighbours; default, unsourced
constexpr double kLidMm = 0.02;   // thinner lids are rounding of a file; default, unsourced

Box3 seen(const Box3& box, const geometry::Placement& frame) {
  Box3 out;
  for (int i = 0; i < 8; ++i)
    out.add(frame.to_local({(i & 1) != 0 ? box.hi.x : box.lo.x, (i & 2) != 0 ? box.hi.y : box.lo.y,
                            (i & 4) != 0 ? box.hi.z : box.lo.z}));
  return out;
}

bool tilted(const Form& f) {
  const Vec3 z = f.frame().z;
  return std::max({std::abs(z.x), std::abs(z.y), std::abs(z.z)}) < kSquare;
}

double radius_of(const Form& f, const Bore& b) {
  if (f.kind == ShapeKind::kThread) return std::max(0.5 * b.thread_major_mm, b.top_radius_mm);
  return std::min(b.top_radius_mm, b.bottom_radius_mm);
}

/// A wall on each side of the cutter, and a floor.
bool walled(const Form& f) {
  return f.kind == ShapeKind::kPocket || f.kind == ShapeKind::kSlot || f.kind == ShapeKind::kHole;
}

/// Begins below what others take away from above.
bool lies_below(const Form& f) {
  switch (f.kind) {
    case ShapeKind::kFace:
    case ShapeKind::kChamfer:
    case ShapeKind::kEdgeRound:
    case ShapeKind::kSphericalCap:
    case ShapeKind::kRoundedEnd:
    case ShapeKind::kFreeform:
    case ShapeKind::kToolpath:
      return false;
    default:
      return true;
  }
}

struct Left {
  Vec2 at;
  double top_mm = 0.0;
};

/// How high the faces over a place let the part be there, form's frame.
double under_faces(const Form& f, const std::vector<Form>& others, Vec2 p, double most) {
  for (const Form& o : others) {
    if (o.kind != ShapeKind::kFace || dot(o.frame().z, f.frame().z) < kSquare) continue;
    const Vec3 q = o.frame().to_local(f.frame().to_parent({p.x, p.y, 0.0}));
    if (geometry::contains(o.area, xy(q)))
      most = std::min(most, f.frame().to_local(o.frame().origin).z - o.depth_mm());
  }
  return most;
}

double top_beside(const std::vector<Left>& left, Vec2 p, double cell, double most) {
  double near = 1e300;
  for (const Left& l : left) near = std::min(near, norm(l.at - p));
  for (const Left& l : left) {
    if (norm(l.at - p) <= near + cell) most = std::min(most, l.top_mm);
  }
  return most;
}

}  // namespace

bool Piece::holds(Vec3 p) const {
  if (p.x < box.lo.x || p.x > box.hi.x || p.y < box.lo.y || p.y > box.hi.y || p.z < box.lo.z ||
      p.z > box.hi.z)
    return false;
  const Vec3 middle = 0.5 * (box.lo + box.hi);
  return !round_mm || std::hypot(p.x - middle.x, p.y - middle.y) <= *round_mm;
}

std::string cuts_an_edge(const Form& f, const Piece& raw) {
  const Bore* b = f.bore();
  if (b == nullptr || raw.box.empty() || tilted(f)) return {};
  const double r = radius_of(f, *b);
  const Box3 box = seen(raw.box, f.frame());
  double beyond = std::max({r + box.lo.x, r - box.hi.x, r + box.lo.y, r - box.hi.y});
  if (raw.round_mm && std::abs(f.frame().z.z) >= kSquare) {
    const Vec3 off = f.frame().origin - 0.5 * (raw.box.lo + raw.box.hi);
    beyond = std::max(beyond, std::hypot(off.x, off.y) + r - *raw.round_mm);
  }
  if (beyond <= kBeyondMm) return {};
  return (beyond > r ? "its axis lies " + trimmed(beyond - r, 3) + " mm outside the raw piece"
                     : "its circle of " + trimmed(2.0 * r, 3) + " mm runs " + trimmed(beyond, 3) +
                           " mm out over the edge of the raw piece") +
         ": a drill is pushed aside there and breaks";
}

std::string point_runs_through(const Form& f, const Piece& raw, const Piece& part) {
  const Bore* b = f.bore();
  if (b == nullptr || f.kind != ShapeKind::kHole || !(f.tip_mm > 0.0) || raw.box.empty() || tilted(f))
    return {};
  const double raw_under = -seen(raw.box, f.frame()).lo.z;
  const double part_under = part.box.empty() ? raw_under : -seen(part.box, f.frame()).lo.z;
  const double under = std::min(raw_under, part_under);
  if (!std::isfinite(f.tip_mm)) return "the point of its drill has no end; state a tip_angle in radians";
  const double by = f.depth_mm() + f.tip_mm - under;
  if (by <= kBeyondMm || f.depth_mm() > under + kBeyondMm) return {};
  const double full = 2.0 * std::atan(b->bottom_radius_mm / f.tip_mm) * 180.0 / std::numbers::pi;
  return "the point of its drill (" + trimmed(full, 1) + " degrees, " + trimmed(f.tip_mm, 3) +
         " mm long, below a depth of " + trimmed(f.depth_mm(), 3) +
         " mm) runs through the underside of the " +
         (part_under < raw_under - kBeyondMm ? "finished part" : "raw piece") + " by " + trimmed(by, 3) +
         " mm; give the hole a flat bottom, make it " + trimmed(by, 3) + " mm less deep, or through";
}

std::string floor_below_part(const Form& f, const Piece& raw, const Piece& part) {
  if (!walled(f) || f.solid.through || f.area.empty() || raw.box.empty() || part.box.empty() || tilted(f))
    return {};
  const Box3 finished = seen(part.box, f.frame());
  const double raw_under = -seen(raw.box, f.frame()).lo.z, depth = f.depth_mm();
  const double by = depth + finished.lo.z;
  if (-finished.lo.z >= raw_under - kBeyondMm || by <= kBeyondMm || depth > raw_under + kBeyondMm) return {};
  // What lies beside the part is cut off with all of its floor.
  const auto b = geometry::bounds(f.area);
  if (b.hi.x < finished.lo.x || b.lo.x > finished.hi.x || b.hi.y < finished.lo.y || b.lo.y > finished.hi.y)
    return {};
  return "its floor, " + trimmed(depth, 3) + " mm deep, lies " + trimmed(by, 3) +
         " mm below the underside of the finished part, in what is cut off there: make it through, make it " +
         trimmed(by, 3) + " mm less deep, or state the finished part's true size";
}

std::string buried(const Form& f, const std::vector<Form>& others, const Piece& part, double& above_mm) {
  if (!lies_below(f) || f.area.empty() || part.box.empty() || tilted(f)) return {};
  const Box3 box = seen(part.box, f.frame());
  if (box.hi.z <= kLidMm) return {};
  auto b = geometry::bounds(f.area);
  b.lo = {std::max(b.lo.x, box.lo.x), std::max(b.lo.y, box.lo.y)};
  b.hi = {std::min(b.hi.x, box.hi.x), std::min(b.hi.y, box.hi.y)};
  if (!(b.lo.x < b.hi.x && b.lo.y < b.hi.y)) return {};
  const Vec2 cell = (1.0 / kAcross) * (b.hi - b.lo);
  const auto taken = [&](Vec2 p) {
    const auto own = floor_at(f, p);
    return own && *own <= -kLidMm;
  };
  std::vector<Left> left;
  // A strip along a side has all that it leaves standing beside it: hence a margin around.
  const double margin = 2.0 * std::max(cell.x, cell.y);
  const Vec2 from{std::max(b.lo.x - margin, box.lo.x), std::max(b.lo.y - margin, box.lo.y)};
  const Vec2 to{std::min(b.hi.x + margin, box.hi.x), std::min(b.hi.y + margin, box.hi.y)};
  for (int i = 0; f.kind == ShapeKind::kOutside && i < kAcross * kAcross; ++i) {
    const double u = (i % kAcross + 0.5) / kAcross, v = (i / kAcross + 0.5) / kAcross;
    const Vec2 p{from.x + u * (to.x - from.x), from.y + v * (to.y - from.y)};
    if (!taken(p)) left.push_back({p, under_faces(f, others, p, box.hi.z)});
  }
  const auto solid = [&](double x, double y, double z) {
    const Vec3 p = f.frame().to_parent({x, y, z});
    return part.holds(p) &&
           std::none_of(others.begin(), others.end(), [&](const Form& o) { return takes(o, p); });
  };
  // Wide below a narrower hole on its axis and open at the underside: it is cut from below.
  if (f.bore() != nullptr && (f.solid.through || -f.depth_mm() <= box.lo.z + kLidMm)) {
    bool open = !others.empty();
    const double high = (box.hi.z - kLidMm) / kUp;
    for (int k = 0; k < kUp && open; ++k) open = !solid(0.0, 0.0, kLidMm + (k + 0.5) * high);
    if (open) return {};
  }
  double above = 0.0, volume = 0.0;
  Vec3 at;
  for (int i = 0; i < kAcross * kAcross; ++i) {
    const Vec2 p{b.lo.x + (i % kAcross + 0.5) * cell.x, b.lo.y + (i / kAcross + 0.5) * cell.y};
    if (!taken(p)) continue;
    const double high = (top_beside(left, p, norm(cell), box.hi.z) - kLidMm) / kUp;
    for (int k = 0; high > 0.0 && k < kUp; ++k) {
      const double z = kLidMm + (k + 0.5) * high;
      if (!solid(p.x, p.y, z) || !solid(p.x + kAsideMm, p.y, z) || !solid(p.x - kAsideMm, p.y, z) ||
          !solid(p.x, p.y + kAsideMm, z) || !solid(p.x, p.y - kAsideMm, z))
        continue;
      volume += cell.x * cell.y * high;
      if (z + 0.5 * high <= above) continue;
      above = z + 0.5 * high;
      at = f.frame().to_parent({p.x, p.y, above});
    }
  }
  if (!(above > 0.0)) return {};
  above_mm = above;
  return "up to " + trimmed(above, 3) + " mm of the piece stand above its top, at (" + trimmed(at.x, 2) +
         ", " + trimmed(at.y, 2) + ", " + trimmed(at.z, 2) + ") (about " + trimmed(volume, 0) +
         " mm3), and no feature takes them away; place its top on the surface, or add the feature that opens "
         "it";
}

double unstated_corner_mm(double depth_mm) {
  constexpr double kLeastMm = 3.0, kOfDepth = 1.0 / 6.0;
  return std::max(kLeastMm, kOfDepth * depth_mm);
}

}  // namespace capstan::verify::volumes
