#include "planner/model/features/in_piece.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "planner/ground/base/number.h"
#include "planner/ground/base/stopping.h"
#include "planner/model/features/resolve.h"
#include "planner/model/features/shape/build.h"
#include "planner/model/nouns/feature.h"

// Features against the piece that they are cut from.
//
// What is buried is found by points: over the feature's area, at heights between its top and the top of the
// piece, a point is open when it lies outside the piece or within what some feature takes away; a face takes
// away all that stands above it. A point counts as buried when its neighbours, a hair aside, are so too: what
// stays in corners, where two outlines meet, is no lid. Over an outside a point is open, too, when it is
// higher than the faces of the nearest place that the outside leaves standing.

namespace capstan::model {
namespace {

using geometry::Box3;
using geometry::Vec2;
using geometry::Vec3;

constexpr double kUpright = 1.0 - 1e-9;
constexpr int kAcross = 32;       // points along a side of the feature's box; default, unsourced
constexpr int kUp = 6;            // heights; default, unsourced
constexpr double kAsideMm = 0.2;  // neighbours; default, unsourced
constexpr double kSharpRad = 20.0 / 180.0 * std::numbers::pi;  // arcs are drawn by smaller turns
constexpr double kLidMm = 0.02;  // thinner lids are rounding of a file; default, unsourced

Box3 seen_from(const Box3& box, const geometry::Placement& frame) {
  Box3 out;
  for (const double x : {box.lo.x, box.hi.x}) {
    for (const double y : {box.lo.y, box.hi.y}) {
      for (const double z : {box.lo.z, box.hi.z}) out.add(frame.to_local({x, y, z}));
    }
  }
  return out;
}

bool tilted(const FeatureShape& s) {
  return std::max({std::abs(s.frame.z.x), std::abs(s.frame.z.y), std::abs(s.frame.z.z)}) < kUpright;
}

double radius_of(const FeatureShape& s) {
  if (s.kind == ShapeKind::kThread) return 0.5 * std::max(s.thread_major_mm, s.diameter.nominal_mm);
  return 0.5 * std::min(s.diameter.nominal_mm, s.bottom_diameter_mm);
}

bool in_piece(Vec3 p, const PieceForm& piece) {
  if (p.x < piece.box.lo.x || p.x > piece.box.hi.x || p.y < piece.box.lo.y || p.y > piece.box.hi.y ||
      p.z < piece.box.lo.z || p.z > piece.box.hi.z)
    return false;
  if (!piece.round_mm) return true;
  const Vec3 middle = 0.5 * (piece.box.lo + piece.box.hi);
  return std::hypot(p.x - middle.x, p.y - middle.y) <= *piece.round_mm;
}

/// A place that an outside leaves standing, and how high the part is there by its faces.
struct Standing {
  Vec2 at;
  double top_mm = 0.0;
};

/// How high the faces over a place of the outside's frame let the part be there.
double face_over(const FeatureShape& s, const std::vector<FeatureShape>& features, Vec2 p, double most) {
  double top = most;
  for (const FeatureShape& o : features) {
    if (o.kind != ShapeKind::kFace || dot(o.frame.z, s.frame.z) < kUpright) continue;
    const Vec3 q = o.frame.to_local(s.frame.to_parent({p.x, p.y, 0.0}));
    if (geometry::contains(o.area, {q.x, q.y}))
      top = std::min(top, s.frame.to_local(o.frame.origin).z - o.depth_mm);
  }
  return top;
}

/// Beside an outside nothing of the part is higher than what stands next to it: above that is raw piece only.
double top_beside(const std::vector<Standing>& standing, Vec2 p, double cell, double most) {
  double nearest = 1e300;
  for (const Standing& k : standing) nearest = std::min(nearest, norm(k.at - p));
  double top = most;
  for (const Standing& k : standing) {
    if (norm(k.at - p) <= nearest + cell) top = std::min(top, k.top_mm);
  }
  return top;
}

}  // namespace

bool takes(const FeatureShape& s, Vec3 p) {
  if (s.area.empty()) return false;
  const Vec3 q = s.frame.to_local(p);
  if (s.kind != ShapeKind::kFace && q.z > kLidMm) return false;
  const auto floor = floor_at(s, {q.x, q.y});
  return floor && (q.z >= *floor - kLidMm || (s.through && *floor <= -s.depth_mm + kLidMm));
}

double beyond_sides(const FeatureShape& s, const PieceForm& raw) {
  if (!has(s.kind, ShapeTrait::kRound) || raw.box.empty() || tilted(s)) return 0.0;
  const double r = radius_of(s);
  const Box3 box = seen_from(raw.box, s.frame);
  double out = std::max({r + box.lo.x, r - box.hi.x, r + box.lo.y, r - box.hi.y});
  if (raw.round_mm && std::abs(s.frame.z.z) >= kUpright) {
    const Vec3 middle = 0.5 * (raw.box.lo + raw.box.hi);
    out = std::max(out,
                   std::hypot(s.frame.origin.x - middle.x, s.frame.origin.y - middle.y) + r - *raw.round_mm);
  }
  return out > kBeyondPieceMm ? out : 0.0;
}

std::string cuts_an_edge(const FeatureShape& s, const PieceForm& raw) {
  const double beyond = beyond_sides(s, raw);
  if (!(beyond > 0.0)) return {};
  const double r = radius_of(s);
  return (beyond > r ? "its axis lies " + trimmed(beyond - r, 3) + " mm outside the raw piece"
                     : "its circle of " + trimmed(2.0 * r, 3) + " mm runs " + trimmed(beyond, 3) +
                           " mm out over the edge of the raw piece") +
         ": a drill is pushed aside there and breaks";
}

std::string point_runs_through(const FeatureShape& s, const PieceForm& raw, const PieceForm& part) {
  if (s.kind != ShapeKind::kHole || s.bottom != HoleBottom::kConical || s.through || raw.box.empty() ||
      tilted(s))
    return {};
  const double raw_under = -seen_from(raw.box, s.frame).lo.z;
  const double part_under = part.box.empty() ? raw_under : -seen_from(part.box, s.frame).lo.z;
  const double under = std::min(raw_under, part_under);
  const bool finished = part_under < raw_under - kBeyondPieceMm;
  const double tip = 0.5 * s.bottom_diameter_mm * std::tan(s.bottom_angle_rad);
  const double by = s.depth_mm + tip - under;
  if (by <= kBeyondPieceMm || s.depth_mm > under + kBeyondPieceMm) return {};
  const double full = 180.0 - 2.0 * s.bottom_angle_rad * 180.0 / std::numbers::pi;
  return "the point of its drill (" + trimmed(full, 1) + " degrees, " + trimmed(tip, 3) +
         " mm long, below a depth of " + trimmed(s.depth_mm, 3) + " mm) runs through the underside of the " +
         (finished ? "finished part" : "raw piece") + " by " + trimmed(by, 3) +
         " mm; give the hole a flat bottom, make it " + trimmed(by, 3) + " mm less deep, or through";
}

std::string floor_below_part(const FeatureShape& s, const PieceForm& raw, const PieceForm& part) {
  if (!has(s.kind, ShapeTrait::kWalled) || s.through || s.area.empty() || raw.box.empty() ||
      part.box.empty() || tilted(s))
    return {};
  const Box3 finished = seen_from(part.box, s.frame);
  const double raw_under = -seen_from(raw.box, s.frame).lo.z, part_under = -finished.lo.z;
  const double by = s.depth_mm - part_under;
  if (part_under >= raw_under - kBeyondPieceMm || by <= kBeyondPieceMm ||
      s.depth_mm > raw_under + kBeyondPieceMm)
    return {};
  // What lies beside the part is cut off with all of its floor.
  const auto b = geometry::bounds(s.area);
  if (b.hi.x < finished.lo.x || b.lo.x > finished.hi.x || b.hi.y < finished.lo.y || b.lo.y > finished.hi.y)
    return {};
  return "its floor, " + trimmed(s.depth_mm, 3) + " mm deep, lies " + trimmed(by, 3) +
         " mm below the underside of the finished part, in what is cut off there: make it through, make it " +
         trimmed(by, 3) + " mm less deep, or state the finished part's true size";
}

std::optional<Buried> buried(const FeatureShape& s, const std::vector<FeatureShape>& features,
                             const PieceForm& part) {
  if (!has(s.kind, ShapeTrait::kBelowTop) || s.area.empty() || part.box.empty() || tilted(s))
    return std::nullopt;
  Box3 box = seen_from(part.box, s.frame);
  if (box.hi.z <= kLidMm) return std::nullopt;
  auto b = geometry::bounds(s.area);
  b.lo = {std::max(b.lo.x, box.lo.x), std::max(b.lo.y, box.lo.y)};
  b.hi = {std::min(b.hi.x, box.hi.x), std::min(b.hi.y, box.hi.y)};
  if (!(b.lo.x < b.hi.x && b.lo.y < b.hi.y)) return std::nullopt;
  const Vec2 cell = (1.0 / kAcross) * (b.hi - b.lo);
  const auto place = [&](int ix, int iy) {
    return Vec2{b.lo.x + (ix + 0.5) * cell.x, b.lo.y + (iy + 0.5) * cell.y};
  };
  const auto taken = [&](Vec2 p) {
    tick(4);
    const auto own = floor_at(s, p);
    return own && *own <= -kLidMm;
  };
  std::vector<Standing> standing;
  // An outside that is a strip along a side has all that it leaves standing beside it: hence a margin around.
  const double margin = 2.0 * std::max(cell.x, cell.y);
  const Vec2 from{std::max(b.lo.x - margin, box.lo.x), std::max(b.lo.y - margin, box.lo.y)};
  const Vec2 to{std::min(b.hi.x + margin, box.hi.x), std::min(b.hi.y + margin, box.hi.y)};
  for (int i = 0; s.kind == ShapeKind::kOutside && i < kAcross * kAcross; ++i) {
    const double u = (i % kAcross + 0.5) / kAcross, v = (i / kAcross + 0.5) / kAcross;
    const Vec2 p{from.x + u * (to.x - from.x), from.y + v * (to.y - from.y)};
    if (!taken(p)) standing.push_back({p, face_over(s, features, p, box.hi.z)});
  }
  const auto lid = [&](double x, double y, double z) {
    tick(4);
    const Vec3 p = s.frame.to_parent({x, y, z});
    return in_piece(p, part) &&
           std::none_of(features.begin(), features.end(), [&](const FeatureShape& o) { return takes(o, p); });
  };
  // A far end: wide below a narrower hole on its axis and open at the underside, it is cut from below.
  if (has(s.kind, ShapeTrait::kRound) && (s.through || -s.depth_mm <= box.lo.z + kLidMm)) {
    bool open = !features.empty();
    const double high = (box.hi.z - kLidMm) / kUp;
    for (int k = 0; k < kUp && open; ++k) open = !lid(0.0, 0.0, kLidMm + (k + 0.5) * high);
    if (open) return std::nullopt;
  }
  std::optional<Buried> out;
  for (int iy = 0; iy < kAcross; ++iy) {
    for (int ix = 0; ix < kAcross; ++ix) {
      const Vec2 p = place(ix, iy);
      if (!taken(p)) continue;
      const double high = (top_beside(standing, p, norm(cell), box.hi.z) - kLidMm) / kUp;
      if (high <= 0.0) continue;
      for (int k = 0; k < kUp; ++k) {
        const double z = kLidMm + (k + 0.5) * high;
        if (!lid(p.x, p.y, z)) continue;
        const bool corner = !lid(p.x + kAsideMm, p.y, z) || !lid(p.x - kAsideMm, p.y, z) ||
                            !lid(p.x, p.y + kAsideMm, z) || !lid(p.x, p.y - kAsideMm, z);
        if (corner) continue;
        if (!out) out = Buried{};
        out->volume_mm3 += cell.x * cell.y * high;
        if (z + 0.5 * high <= out->above_mm) continue;
        out->above_mm = z + 0.5 * high;
        out->at = s.frame.to_parent({p.x, p.y, out->above_mm});
      }
    }
  }
  return out;
}

std::string to_text(const Buried& b) {
  return "up to " + trimmed(b.above_mm, 3) + " mm of the piece stand above its top, at (" +
         trimmed(b.at.x, 2) + ", " + trimmed(b.at.y, 2) + ", " + trimmed(b.at.z, 2) + ") (about " +
         trimmed(b.volume_mm3, 0) +
         " mm3), and no feature takes them away; place its top on the surface, or add the feature that opens "
         "it";
}

namespace {

/// A woodruff end rises to the top along the circle of a disc-shaped cutter, within what its radius and the
/// depth give on either side of the course's end; it is of no matter where that is air.
std::string woodruff_end(const Model& m, const FeatureShape& s, const WoodruffSlotEndType& end, Vec2 at,
                         Vec2 out, const PieceForm& part) {
  const auto radius = length(m, end.radius);
  const double r = radius ? radius->nominal_mm : 0.0;
  const double d = s.depth_mm;
  const double rise = r > d ? std::sqrt(d * (2.0 * r - d)) : r;
  const double far = std::max(rise, 0.5 * s.width.nominal_mm);
  bool solid = part.box.empty();
  for (int i = 0; i <= kAcross && !solid; ++i) {
    const double along = far * (2.0 * i / kAcross - 1.0);
    for (const double side : {-0.5, 0.0, 0.5}) {
      const double across = side * s.width.nominal_mm;
      const Vec3 p = s.frame.to_parent(
          {at.x + along * out.x - across * out.y, at.y + along * out.y + across * out.x, -kLidMm});
      solid = solid || in_piece(p, part);
    }
  }
  if (!solid) return {};
  const Vec3 p = s.frame.to_parent({at.x, at.y, 0.0});
  const std::string size = radius ? "of radius " + trimmed(r, 3) + " mm" : "whose radius is not stated";
  return "its woodruff end at (" + trimmed(p.x, 2) + ", " + trimmed(p.y, 2) + ", " + trimmed(p.z, 2) +
         ") rises to the top along a circle " + size +
         ": a woodruff cutter or side mill of that radius makes it, its axis across the slot, which is not "
         "planned; give the path, or end the slot with a radius";
}

}  // namespace

std::vector<SharpCorner> sharp_corners(const FeatureShape& s, const std::vector<FeatureShape>& features,
                                       const PieceForm& part) {
  std::vector<SharpCorner> out;
  if (s.area.empty() || part.box.empty() || s.slope_rad > 0.0 || tilted(s)) return out;
  geometry::Region area = s.area;
  for (const Island& i : s.islands) area = geometry::subtract(area, i.area);
  const auto solid = [&](Vec2 q, double of_depth) {
    const Vec3 p = s.frame.to_parent({q.x, q.y, -of_depth * s.depth_mm});
    return in_piece(p, part) &&
           std::none_of(features.begin(), features.end(), [&](const FeatureShape& o) { return takes(o, p); });
  };
  for (const geometry::Loop& loop : area.loops) {
    const std::size_t n = loop.size();
    for (std::size_t i = 0; i < n; ++i) {
      const Vec2 a = loop[(i + n - 1) % n], b = loop[i], c = loop[(i + 1) % n];
      if (norm(b - a) < 1e-6 || norm(c - b) < 1e-6) continue;
      const Vec2 in = (1.0 / norm(b - a)) * (b - a), on = (1.0 / norm(c - b)) * (c - b);
      if (std::atan2(cross(in, on), dot(in, on)) < kSharpRad) continue;
      // What is taken away lies on the left of the loop.
      const double back = std::min(kAsideMm, 0.5 * norm(b - a)),
                   ahead = std::min(kAsideMm, 0.5 * norm(c - b));
      const Vec2 beside = b - back * in + kAsideMm * Vec2{in.y, -in.x};
      const Vec2 after = b + ahead * on + kAsideMm * Vec2{on.y, -on.x};
      const Vec2 beyond = b + (kAsideMm / norm(in - on)) * (in - on);
      const auto at = [&](double h) { return solid(beside, h) && solid(after, h) && solid(beyond, h); };
      if (!at(0.05) && !at(0.5) && !at(0.95)) continue;
      const bool open = s.kind == ShapeKind::kPocket &&
                        (geometry::contains(s.reach, beside) || geometry::contains(s.reach, after));
      out.push_back({s.frame.to_parent({b.x, b.y, 0.0}), open});
    }
  }
  return out;
}

bool stops_at_walls(const FeatureShape& face) {
  constexpr double kBesideMm = 0.2,
                   kSomeArea = 0.01;  // mm2: less is rounding of outlines; default, unsourced
  if (face.kind != ShapeKind::kFace || !face.open || face.area.empty() || face.reach.empty()) return false;
  geometry::Region free = face.reach;
  for (const Island& i : face.islands) free = geometry::unite(free, i.area);
  return geometry::area(geometry::subtract(geometry::offset_sharp(face.area, kBesideMm), free)) > kSomeArea;
}

double unstated_corner_mm(double depth_mm) {
  constexpr double kLeastMm = 3.0, kOfDepth = 1.0 / 6.0;
  return std::max(kLeastMm, kOfDepth * depth_mm);
}
double unstated_corner_mm(const FeatureShape& s) {
  constexpr double kOfSide = 0.35;
  if (s.kind != ShapeKind::kPocket || !s.open) return unstated_corner_mm(s.depth_mm);
  const auto box = geometry::bounds(s.area);
  return kOfSide * std::min(box.hi.x - box.lo.x, box.hi.y - box.lo.y);
}

namespace {

/// An end of a slot as square_corner and drawn_square see it: at most one of them is not empty.
struct SlotEnd {
  std::string no_mill_makes;  ///< nor leaves anything like it
  std::string square;         ///< a mill leaves its corners round
};

constexpr const char* kWhatToDo = "; state the radius that may stay, or have the corners broached or eroded";

/// `stated_only`: as square_corner.
SlotEnd slot_end(const Model& m, const FeatureShape& s, const std::vector<FeatureShape>& features,
                 const PieceForm& part, bool stated_only, bool first) {
  const double half = 0.5 * s.width.nominal_mm - kAsideMm;
  const AnyRef noun = s.made_of.empty() ? s.feature : s.made_of.back();
  const auto* slot = m.get<Slot>(noun);
  const auto solid = [&](Vec2 q) {
    const Vec3 p = s.frame.to_parent({q.x, q.y, -0.5 * s.depth_mm});
    return in_piece(p, part) &&
           std::none_of(features.begin(), features.end(), [&](const FeatureShape& o) { return takes(o, p); });
  };
  const std::size_t n = s.spine.size();
  const Vec2 end = first ? s.spine.front() : s.spine.back();
  const Vec2 before = first ? s.spine[1] : s.spine[n - 2];
  const Vec2 out = (1.0 / norm(end - before)) * (end - before);
  const std::size_t number = first ? 0 : 1;
  const bool stated = slot != nullptr && number < slot->end_conditions.size();
  if (const auto* round = stated ? m.get<WoodruffSlotEndType>(slot->end_conditions[number]) : nullptr)
    return {woodruff_end(m, s, *round, end, out, part), {}};
  if (part.box.empty()) return {};
  const Vec2 beyond = end + kAsideMm * out;
  if (geometry::contains(s.area, beyond)) return {};  // rounded
  const bool open = geometry::contains(s.reach, beyond);
  const auto* flat = stated ? m.get<FlatSlotEndType>(slot->end_conditions[number]) : nullptr;
  const auto corners = flat != nullptr ? shape::corners_of(m, *flat, noun) : shape::FlatCorners{};
  if (corners && corners->same() && corners->first > kLidMm) return {};
  for (const double side : {-half, 0.0, half}) {
    if (!solid({beyond.x - side * out.y, beyond.y + side * out.x})) continue;
    const Vec3 at = s.frame.to_parent({end.x, end.y, 0.0});
    const std::string where =
        "(" + trimmed(at.x, 2) + ", " + trimmed(at.y, 2) + ", " + trimmed(at.z, 2) + ")";
    if (corners && !corners->same()) {
      return {"its flat end at " + where + " states corners of radius " + trimmed(corners->first, 3) +
                  " and " + trimmed(corners->second, 3) +
                  " mm, and nothing says which stands on which side: draw the slot as a pocket, or state "
                  "one radius",
              {}};
    }
    if (stated_only) return {};
    if (open) {
      return {"its open end at " + where +
                  " is square, solid stands beyond it, and a mill leaves its corners round: end it with a "
                  "radius, let it run out of the piece" +
                  kWhatToDo,
              {}};
    }
    return {{}, "its flat end at " + where + " is square, and solid stands beyond it"};
  }
  return {};
}

bool has_ends(const FeatureShape& s) {
  return s.kind == ShapeKind::kSlot && s.spine.size() >= 2 && norm(s.spine.front() - s.spine.back()) >= 1e-6;
}

}  // namespace

std::string square_corner(const Model& m, const FeatureShape& s, const std::vector<FeatureShape>& features,
                          const PieceForm& part, bool stated_only) {
  if (m.holds<Pocket>(s.made_of.empty() ? s.feature : s.made_of.back())) {
    if (stated_only) return {};
    for (const SharpCorner& c : s.open ? sharp_corners(s, features, part) : std::vector<SharpCorner>()) {
      if (!c.open) continue;
      return "its open side ends at (" + trimmed(c.at.x, 2) + ", " + trimmed(c.at.y, 2) + ", " +
             trimmed(c.at.z, 2) +
             ") within the piece, solid stands beyond it, and a mill leaves its corners round: let it run "
             "out of the piece, or draw a closed pocket" +
             kWhatToDo;
    }
    return {};
  }
  if (!has_ends(s)) return {};
  for (const bool first : {true, false}) {
    auto why = slot_end(m, s, features, part, stated_only, first).no_mill_makes;
    if (!why.empty()) return why;
  }
  return {};
}

std::string drawn_square(const Model& m, const FeatureShape& s, const std::vector<FeatureShape>& features,
                         const PieceForm& part) {
  if (const auto* p = m.get<Pocket>(s.made_of.empty() ? s.feature : s.made_of.back())) {
    if (!p->orthogonal_radius.set() || s.corner_radius_mm > kLidMm) return {};
    if (s.slope_rad == 0.0 && sharp_corners(s, features, part).empty()) return {};  // round, or none in solid
    return "it states inside corners of radius " + trimmed(s.corner_radius_mm, 4);
  }
  if (!has_ends(s)) return {};
  for (const bool first : {true, false}) {
    auto square = slot_end(m, s, features, part, false, first).square;
    if (!square.empty()) return square;
  }
  return {};
}

}  // namespace capstan::model
