#include "planner/files/from_cad/rims.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "planner/files/from_cad/drawn.h"

// A transition feature of ISO 14649 says which feature's upper edge it breaks: the whole of it. It is the one
// whose walls the rim ends on: of the rooms that begin at the rim's upper plane the one of which an outline
// runs through the rim's foot. That the outline is broken all along is seen half way up the rim, where
// nothing of the part may stand in a band beside it. Source: derived.

namespace capstan::from_cad {
namespace {

using geometry::Region;

/// The widest bevel and the largest round that the shipped mills make, mm: cutters.yaml's chamfer mill of 20
/// mm with a tip of 3 mm, half a millimetre below the bevel; its largest corner rounding mill.
constexpr double kWidestMm = 8.0, kRoundestMm = 5.0;
/// A chamfer mill's tip runs below the bevel, past the contour: so much deeper the contour is made. Default,
/// unsourced.
constexpr double kTipRoomMm = 1.0;
/// Tips of the chamfer mills of cutters.yaml are 3 mm wide at most; chords of rounds turn less. Default,
/// unsourced.
constexpr double kTipDiameterMm = 3.0, kSharpTurnRad = 30.0 * std::numbers::pi / 180.0;
/// Slopes that one cutter of 90 degrees makes, rad. Default, unsourced: a drawing's half a degree.
constexpr double kSameSlopeRad = 0.5 * std::numbers::pi / 180.0;
/// Of what is free half way up a rim so much is looked at: default, unsourced; the chord of the band's arcs,
/// mm.
constexpr double kOfWidth = 0.8, kArcMm = 0.01;

/// How far the foot of a rim lies off an outline.
double off(const Rim& rim, const Region& outline) {
  double most = 0.0;
  for (const Vec2 p : rim.foot) most = std::max(most, geometry::distance_to_boundary(outline, p));
  return most;
}

/// Whether a cutter may be had that makes it from above. Planes are else faced, each in a set-up of its own.
bool one_cutter_makes(const Rim& rim) {
  if (rim.type == model::TypeId::kEdgeRound) return rim.height_mm() <= kRoundestMm + kLevelMm;
  return rim.width_mm() <= kWidestMm + kLevelMm &&
         std::abs(rim.angle_rad - 0.25 * std::numbers::pi) < kSameSlopeRad;
}

/// Whether nothing of the part stands half way up a rim beside all of an outline. `within`: the material is
/// inside the outline.
bool broken_all_along(const Part& part, const Rim& rim, const Region& outline, bool within) {
  const double chord = 2.0 * part.brep().chord;
  const bool round = rim.type == model::TypeId::kEdgeRound;
  // Half way up a bevel half of its width is free; of a round 1 - sin 60 degrees.
  const double free = kOfWidth * (round ? 1.0 - 0.5 * std::numbers::sqrt3 : 0.5) * rim.width_mm();
  if (free < 2.0 * chord) return false;
  const Region band = within ? geometry::subtract(outline, geometry::offset(outline, -free, kArcMm))
                             : geometry::subtract(geometry::offset(outline, free, kArcMm), outline);
  const Cleared& c = part.cleared(rim.frame, rim.foot_mm + 0.5 * rim.height_mm(), {});
  Region stays = geometry::intersect(band, c.raw);
  for (const Region& r : c.rooms) stays = geometry::subtract(stays, r);
  // The chords of the mesh lie a little beside the outline.
  return geometry::area(geometry::offset(stays, -chord, kArcMm)) < kSpeckMm2;
}

/// Whether the area has walls all round.
bool closed(const Part& part, const Room& room) {
  const Drawn d = drawn(part, room);
  return !d.outer.empty() &&
         std::none_of(d.outer.begin(), d.outer.end(), [](const Piece& p) { return p.open; });
}

/// The loop of a room through which a rim's foot runs, broken all along. Chamfers and rounds are read at the
/// upper edges of what stands in a contour, of an area's islands, and of its walls where these are closed.
std::optional<std::size_t> loop_of(const Part& part, const Rim& rim, const Room& room) {
  const double near = 2.0 * part.brep().chord + kLevelMm;
  Region all = room.contour ? geometry::subtract(room.raw, room.area) : room.area;
  if (!room.stands.empty()) all.loops = room.stands;
  for (std::size_t i = 0; i < all.loops.size(); ++i) {
    geometry::Loop loop = all.loops[i];
    const bool outer = geometry::signed_area(loop) > 0.0;
    if (!outer) std::reverse(loop.begin(), loop.end());
    const Region filled{{loop}};
    if (off(rim, filled) >= near) continue;
    const bool standing = room.contour || !room.stands.empty();
    if (standing ? !outer : outer && !closed(part, room)) continue;
    // What stands in a contour lies within its outline, as islands do; a pocket's wall has it outside.
    const bool within = outer == standing;
    if (broken_all_along(part, rim, filled, within)) return i;
  }
  return std::nullopt;
}

/// Whether an outline has a sharp corner that a mill going round it does not reach.
bool has_sharp_inner_corner(const geometry::Loop& loop) {
  for (std::size_t i = 0, n = loop.size(); i < n; ++i) {
    const Vec2 a = loop[(i + 1) % n] - loop[i], b = loop[(i + 2) % n] - loop[(i + 1) % n];
    if (std::atan2(cross(a, b), dot(a, b)) < -kSharpTurnRad) return true;
  }
  return false;
}

/// Whether outlines stand so near one another that the arc on which a mill comes to one runs over the other:
/// four widths of the bevel, and its tip.
bool too_near(const std::vector<geometry::Loop>& stands, double width_mm) {
  for (std::size_t i = 0; i < stands.size(); ++i) {
    const Region around = geometry::offset({{stands[i]}}, 4.0 * width_mm + kTipDiameterMm, kArcMm);
    for (std::size_t k = i + 1; k < stands.size(); ++k) {
      if (geometry::area(geometry::intersect(around, {{stands[k]}})) > kSpeckMm2) return true;
    }
  }
  return false;
}

/// Below a rim at the raw piece's surface, what stands there, apart: where a slot runs between the halves of
/// a plate, each has an edge that is broken all along. The room around them. Nothing: the rim is at the edge
/// of none.
std::optional<EdgeOf> edge_of_halves(const Part& part, const Rim& rim, const geometry::Box3& raw,
                                     std::vector<Room>& rooms) {
  Room room;
  room.frame = rim.frame;
  room.top_mm = rim.top_mm;
  room.level_mm = std::max(raw.lo.z, rim.foot_mm - kTipRoomMm);
  room.raw = geometry::rectangle(xy(raw.lo), xy(raw.hi));
  const Region cleared = all_of(part.cleared(rim.frame, room.level_mm, {}));
  room.area = room.raw;
  for (const geometry::Loop& loop : geometry::subtract(room.raw, cleared).loops) {
    if (!(geometry::signed_area(loop) > 0.0)) continue;
    room.stands.push_back(loop);
    room.area = geometry::subtract(room.area, {{loop}});
  }
  if (room.stands.empty() || room.area.empty() || too_near(room.stands, rim.width_mm()) ||
      std::any_of(room.stands.begin(), room.stands.end(), has_sharp_inner_corner))
    return std::nullopt;
  const auto loop = loop_of(part, rim, room);
  if (!loop) return std::nullopt;
  for (Room& other : rooms) {
    const bool below = other.frame.z == room.frame.z && other.level_mm < room.level_mm - kLevelMm &&
                       other.top_mm > room.level_mm + kLevelMm && !other.contour;
    if (below && geometry::area(geometry::subtract(other.area, room.area)) < kSpeckMm2)
      other.top_mm = room.level_mm;
  }
  rooms.push_back(std::move(room));
  return EdgeOf{rooms.size() - 1, *loop};
}

}  // namespace

double Rim::width_mm() const {
  return type == model::TypeId::kEdgeRound ? height_mm() : height_mm() / std::tan(angle_rad);
}

Rim rim_of(const Part& part, const recognise::Feature& feature) {
  Rim out;
  out.type = feature.type;
  out.frame = Part::frame_along(feature.access);
  out.faces = feature.faces;
  const auto [lo, hi] = part.span(out.frame, feature.faces);
  out.top_mm = hi;
  out.foot_mm = lo;
  for (const recognise::Parameter& p : feature.parameters) {
    if (p.name == "angle_to_plane") out.angle_rad = p.value;
  }
  const Brep& brep = part.brep();
  for (const std::uint32_t f : feature.faces) {
    for (const exchange::Loop& loop : brep.faces[f].loops) {
      for (const std::uint32_t e : loop.edges) {
        for (const Vec3 at : {brep.edges[e].start, brep.edges[e].middle, brep.edges[e].end}) {
          const Vec3 local = out.frame.to_local(at);
          if (std::abs(local.z - lo) < kLevelMm) out.foot.push_back(xy(local));
        }
      }
    }
  }
  return out;
}

std::optional<EdgeOf> edge_of(const Part& part, const Rim& rim, std::vector<Room>& rooms) {
  if (!one_cutter_makes(rim)) return std::nullopt;
  for (std::size_t i = 0; i < rooms.size(); ++i) {
    const Room& r = rooms[i];
    if (!(r.frame.z == rim.frame.z) || std::abs(r.top_mm - rim.top_mm) > kLevelMm ||
        r.level_mm > rim.foot_mm + kLevelMm || r.slope_rad > 0.0)
      continue;
    if (const auto loop = loop_of(part, rim, r)) return EdgeOf{i, *loop};
  }
  const geometry::Box3 raw = geometry::transformed(part.raw(), geometry::inverse(rim.frame));
  if (std::abs(raw.hi.z - rim.top_mm) > kLevelMm) return std::nullopt;
  Room room;
  room.frame = rim.frame;
  room.top_mm = rim.top_mm;
  room.level_mm = std::max(raw.lo.z, rim.foot_mm - kTipRoomMm);
  room.contour = true;
  room.raw = geometry::rectangle(xy(raw.lo), xy(raw.hi));
  room.area = all_of(part.cleared(rim.frame, raw.lo.z, {}));
  const auto loop = loop_of(part, rim, room);
  if (!loop) return edge_of_halves(part, rim, raw, rooms);
  rooms.push_back(std::move(room));
  return EdgeOf{rooms.size() - 1, *loop};
}

std::vector<recognise::Feature> faces_apart(const Part& part, const recognise::Feature& rim) {
  std::vector<recognise::Feature> out;
  for (const std::uint32_t f : rim.faces) {
    const exchange::Face& face = part.brep().faces[f];
    recognise::Feature one;
    one.type = rim.type;
    one.faces = {f};
    one.access = face.carrier == exchange::Carrier::kPlane ? normal_of(face) : face.axis;
    one.through = rim.type == model::TypeId::kEdgeRound;
    one.reason = "a part of an edge that is not broken alike all along";
    out.push_back(std::move(one));
  }
  return out;
}

AnyRef noun_with(const Part& part, const Room& room, std::size_t loop, AnyRef noun, const model::Model& m) {
  if (room.contour) return noun;
  const std::vector<std::size_t> islands = drawn(part, room).island_loops;
  const auto at = std::find(islands.begin(), islands.end(), loop);
  if (at == islands.end()) return noun;
  const model::RefList<model::Boss>* bosses = nullptr;
  if (const auto* f = m.get<model::PlanarFace>(noun)) bosses = &f->its_boss;
  if (const auto* f = m.get<model::Pocket>(noun)) bosses = &f->its_boss;
  if (const auto* f = m.get<model::Step>(noun)) bosses = &f->its_boss;
  const auto i = static_cast<std::size_t>(at - islands.begin());
  return bosses != nullptr && i < bosses->size() ? AnyRef((*bosses)[i]) : AnyRef();
}

AnyRef noun_of(const Rim& rim, AnyRef edge_of, model::Model& m, Ref<model::Workpiece> piece,
               const std::string& number) {
  Nouns nouns(m);
  const auto begun = [&](auto f, const char* name) {
    f.its_id = name + number;
    f.its_workpiece = piece;
    f.its_operations.given = true;
    f.first_feature = Ref<model::MachiningFeature>(edge_of);
    return f;
  };
  if (rim.type == model::TypeId::kEdgeRound) {
    auto f = begun(model::EdgeRound{}, "ROUND ");
    f.radius = nouns.length(rim.height_mm());
    return m.add(f);
  }
  auto f = begun(model::Chamfer{}, "CHAMFER ");
  f.angle_to_plane = rim.angle_rad;
  f.first_offset_amount = nouns.length(rim.width_mm());
  return m.add(f);
}

}  // namespace capstan::from_cad
