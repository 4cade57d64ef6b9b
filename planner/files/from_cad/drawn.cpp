#include "planner/files/from_cad/drawn.h"

#include <algorithm>
#include <utility>

namespace capstan::from_cad {
namespace {

using geometry::Loop;
using geometry::Region;

Region shifted(const Region& r, Vec2 by) {
  Region out = r;
  for (Loop& loop : out.loops) {
    for (Vec2& p : loop) p = p + by;
  }
  return out;
}

/// Beside which loops of the area the fillets of its floor stand.
void find_feet(const Part& part, const Room& room, Drawn& d) {
  if (room.blends.empty()) return;
  std::vector<Region> outlines;
  for (const Loop& loop : d.area.loops) outlines.push_back({{loop}});
  for (const std::uint32_t f : room.blends) {
    for (const Part::Spot& s : part.spots(f)) {
      const Vec3 at = d.at.to_local(s.at);
      const double up = at.z + d.depth_mm;
      if (up < -kLevelMm || up > room.blend_radius_mm + kLevelMm) continue;
      double least = room.blend_radius_mm + d.chord_mm;
      const Region* nearest = nullptr;
      for (const Region& outline : outlines) {
        const double mm = geometry::distance_to_boundary(outline, xy(at));
        if (mm > least) continue;
        least = mm;
        nearest = &outline;
      }
      if (nearest == nullptr) continue;
      (geometry::signed_area(nearest->loops.front()) > 0.0 ? d.wall_feet : d.island_feet) = true;
    }
  }
}

}  // namespace

Drawn drawn(const Part& part, const Room& room) {
  Drawn out;
  const geometry::Box2 box = geometry::bounds(room.area.empty() ? room.raw : room.area);
  const Vec2 middle = 0.5 * (box.lo + box.hi);
  out.at = room.frame;
  out.at.origin = room.frame.to_parent({middle.x, middle.y, room.top_mm});
  out.depth_mm = room.top_mm - room.level_mm;
  out.raw = shifted(room.raw, -1.0 * middle);
  const geometry::Box3 piece = geometry::transformed(part.raw(), geometry::inverse(out.at));
  out.around = {xy(piece.lo), xy(piece.hi)};
  out.area = shifted(room.area, -1.0 * middle);
  for (const RoundWall& w : part.round_walls(room.frame))
    out.walls.push_back({w.centre - middle, w.radius_mm});
  for (const FlatWall& w : part.flat_walls(room.frame)) out.flats.push_back({w.from - middle, w.to - middle});
  // The mesh keeps its chord; where two meshes of a circle cross, corners lie a little beside it.
  out.chord_mm = 2.0 * part.brep().chord;
  for (std::size_t i = 0; i < room.stands.size(); ++i) {
    Region outline = shifted({{room.stands[i]}}, -1.0 * middle);
    std::reverse(outline.loops.front().begin(), outline.loops.front().end());
    auto pieces = pieces_of(outline.loops.front(), {}, out.walls, out.chord_mm, out.flats);
    if (pieces.empty()) continue;
    for (Piece& p : pieces) p.open = false;
    out.islands.push_back(std::move(pieces));
    out.island_loops.push_back(i);
  }
  for (std::size_t i = 0; room.stands.empty() && i < out.area.loops.size(); ++i) {
    auto pieces = pieces_of(out.area.loops[i], out.raw, out.walls, out.chord_mm, out.flats);
    if (pieces.empty()) continue;
    if (geometry::signed_area(out.area.loops[i]) > 0.0) {
      out.outer = std::move(pieces);
    } else {
      for (Piece& p : pieces) p.open = false;
      out.islands.push_back(std::move(pieces));
      out.island_loops.push_back(i);
    }
  }
  find_feet(part, room, out);
  return out;
}

}  // namespace capstan::from_cad
