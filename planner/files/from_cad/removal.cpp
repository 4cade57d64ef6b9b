#include "planner/files/from_cad/removal.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <memory>
#include <optional>
#include <utility>

#include "planner/files/from_cad/reach.h"

namespace capstan::from_cad {
namespace {

/// "a slot", "an open pocket".
std::string one_of(model::TypeId type) {
  const std::string word = word_of(type);
  return (std::string_view("aeiou").find(word.front()) != std::string_view::npos ? "an " : "a ") + word;
}

using recognise::Feature;
using recognise::Recognition;

bool is_hole(const Feature& f) {
  return f.type == model::TypeId::kRoundHole || f.type == model::TypeId::kCounterboreHole ||
         f.type == model::TypeId::kCountersunkHole;
}

/// The sides of the part that lie below the raw piece's: faces to be milled.
std::vector<Feature> sides_to_mill(const Part& part, const Recognition& found) {
  std::vector<Feature> out;
  for (const std::uint32_t f : found.on_raw) {
    const Vec3 normal = normal_of(part.brep().faces[f]);
    const geometry::Placement frame = Part::frame_along(normal);
    if (part.raw_span(frame).second - part.span(frame, {f}).second < kLevelMm) continue;
    const auto same = std::find_if(out.begin(), out.end(), [&](const Feature& o) {
      return recognise::kSameAngleRad > norm(o.access - normal);
    });
    if (same != out.end()) {
      same->faces.push_back(f);
      continue;
    }
    Feature side;
    side.type = model::TypeId::kPlanarFace;
    side.access = normal;
    side.faces = {f};
    side.reason = "a side of the part below that of the raw piece";
    out.push_back(side);
  }
  return out;
}

/// Why a feature is not asked for ways at all; empty: it is.
std::string not_written(const Feature& f) {
  const bool leans =
      std::any_of(f.parameters.begin(), f.parameters.end(), [](const auto& p) { return p.name == "slope"; });
  if (leans && f.type != model::TypeId::kClosedPocket)
    return "its walls lean; walls that lean are planned from CAD files in closed pockets only";
  if (f.type == model::TypeId::kRegionSurfaceList)
    return "it is a surface without walls and floors; such surfaces are planned from STL meshes only";
  return {};
}

/// Finds the outlines whose upper edges the rims are. Those of one outline and size are one.
void put_on_edges(const Part& part, Removal& removal) {
  std::vector<OnEdge> out;
  for (OnEdge& e : removal.on_edges) {
    const auto of = edge_of(part, e.rim, removal.rooms);
    if (!of) {
      removal.on_no_edge.push_back(e.recognised.front());
      continue;
    }
    e.of = *of;
    const auto same = std::find_if(out.begin(), out.end(), [&](const OnEdge& o) {
      return o.of == e.of && o.rim.type == e.rim.type && std::abs(o.rim.foot_mm - e.rim.foot_mm) < kLevelMm;
    });
    if (same == out.end()) {
      out.push_back(std::move(e));
      continue;
    }
    same->rim.faces.insert(same->rim.faces.end(), e.rim.faces.begin(), e.rim.faces.end());
    std::sort(same->rim.faces.begin(), same->rim.faces.end());
    same->recognised.push_back(e.recognised.front());
  }
  removal.on_edges = std::move(out);
}

/// Whether nothing of the part lies below a room without a floor, down to the underside, so that a tool may
/// run out there: through the thin top of a hollow, cut from outside.
bool opens_below(const Part& part, const Room& room) {
  const geometry::Placement below = Part::frame_along(-1.0 * room.frame.z);
  geometry::Region open = all_of(part.cleared(below, -room.level_mm, {}));
  for (geometry::Loop& loop : open.loops) {
    for (Vec2& p : loop) p = xy(room.frame.to_local(below.to_parent({p.x, p.y, 0.0})));
    std::reverse(loop.begin(), loop.end());  // seen from the other side
  }
  return geometry::area(geometry::subtract(room.area, open)) < kSpeckMm2;
}

/// How far a tool reaches below the raw piece's surface to clear rooms.
double reach_of(const Part& part, const std::vector<Room>& rooms) {
  double out = 0.0;
  for (const Room& room : rooms) out = std::max(out, part.raw_span(room.frame).second - room.level_mm);
  return out;
}

/// How deep mills that enter a feature's round corners commonly reach.
double reached_mm(const Feature& f) {
  // Reach tools go to 5 to 10 x D (amgcarbidetool.com, the relationship between end mill diameter and
  // length).
  constexpr double kOfDiameter = 8.0;
  for (const recognise::Parameter& p : f.parameters) {
    if (p.name == "orthogonal_radius") return kOfDiameter * 2.0 * p.value;
  }
  return std::numeric_limits<double>::max();
}

Removal once(const Part& part, const std::vector<Feature>& features) {
  Removal out;
  struct Wanted {
    std::size_t feature = 0;
    std::vector<Way> ways;
  };
  std::vector<Wanted> wanted;
  for (std::size_t i = 0; i < features.size(); ++i) {
    const Feature& f = features[i];
    if (f.rim) {
      out.on_edges.push_back({rim_of(part, f), {i}, {}});
      continue;
    }
    std::string why = not_written(f);
    if (why.empty() && is_hole(f)) {
      if (auto hole = hole_of(part, f, why)) {
        const std::shared_ptr<const Hole> far = hole->far;
        out.holes.push_back(*std::move(hole));
        out.hole_of.push_back(i);
        if (far != nullptr) {
          out.holes.push_back(*far);
          out.hole_of.push_back(i);
        }
        continue;
      }
    }
    // A hole that no drill makes may be a pocket.
    if (why.empty() || is_hole(f)) {
      std::string no_way;
      Wanted w{i, ways_of(part, f, no_way)};
      if (!w.ways.empty()) {
        wanted.push_back(std::move(w));
        continue;
      }
      if (why.empty()) why = no_way;
    }
    out.left.push_back({f.faces, one_of(f.type) + ": " + why});
  }
  // Fewest set-ups: first the directions without which a feature is not reached, then what these reach.
  std::vector<Vec3> used;
  const auto known = [&](Vec3 d) { return std::find(used.begin(), used.end(), d) != used.end(); };
  for (const Hole& h : out.holes) {
    if (!known(h.frame.z)) used.push_back(h.frame.z);
  }
  for (const Wanted& w : wanted) {
    if (w.ways.size() == 1 && !known(w.ways.front().frame.z)) used.push_back(w.ways.front().frame.z);
  }
  std::vector<std::vector<Room>> made;
  const auto along = [&](const Wanted& w, const Way& way) {
    std::vector<Room> rooms = rooms_of(part, features[w.feature], way);
    for (Room& room : rooms) room.recognised = {w.feature};
    return rooms;
  };
  // Walls whose upper edge is broken are made from where that is.
  const auto below_a_rim = [&](const Wanted& w, const geometry::Placement& frame) {
    const double top = part.span(frame, features[w.feature].faces).second;
    return std::any_of(out.on_edges.begin(), out.on_edges.end(), [&](const OnEdge& e) {
      return e.rim.frame.z == frame.z && std::abs(e.rim.foot_mm - top) < kLevelMm;
    });
  };
  for (const Wanted& w : wanted) {
    const auto worth = [&](const Way& x) { return 2 * known(x.frame.z) + below_a_rim(w, x.frame); };
    const Way& way = *std::max_element(w.ways.begin(), w.ways.end(),
                                       [&](const Way& a, const Way& b) { return worth(a) < worth(b); });
    if (!known(way.frame.z)) used.push_back(way.frame.z);
    made.push_back(along(w, way));
    out.rooms.insert(out.rooms.end(), made.back().begin(), made.back().end());
  }
  // Where no mill that enters the corners reaches, or half as deep will do, the direction along which a tool
  // reaches least deep: of those that are there; one more set-up for corners alone.
  constexpr double kMuchLess = 0.5;  // default, unsourced
  for (std::size_t i = 0; i < wanted.size(); ++i) {
    if (!made[i].empty() && below_a_rim(wanted[i], made[i].front().frame)) continue;
    double least = reach_of(part, made[i]) - kLevelMm;
    const double most = reached_mm(features[wanted[i].feature]);
    for (const Way& way : wanted[i].ways) {
      if (made[i].empty() || way.frame.z == made[i].front().frame.z) continue;
      if (!known(way.frame.z) && least <= most) continue;
      std::vector<Room> other = along(wanted[i], way);
      const double reach = reach_of(part, other);
      if (other.empty() || reach >= least || (!known(way.frame.z) && reach > most)) continue;
      if (least <= most && reach > kMuchLess * least) continue;
      if (!known(way.frame.z)) used.push_back(way.frame.z);
      least = reach - kLevelMm;
      made[i] = std::move(other);
    }
  }
  out.rooms.clear();
  for (std::vector<Room>& rooms : made) std::move(rooms.begin(), rooms.end(), std::back_inserter(out.rooms));
  settle(out.rooms);
  for (Room& room : out.rooms) room.through = room.through || (room.no_floor && opens_below(part, room));
  join_contours(part, out.rooms);
  for (Hole& h : out.holes) raise(part, out.rooms, h);
  end(part, out.rooms, out.holes);
  put_on_edges(part, out);
  return out;
}

/// The features, with the faces of some rims as features of their own.
std::vector<Feature> rims_apart(const Part& part, const std::vector<Feature>& features,
                                const std::vector<std::size_t>& rims) {
  std::vector<Feature> out;
  for (std::size_t i = 0; i < features.size(); ++i) {
    if (std::find(rims.begin(), rims.end(), i) == rims.end()) {
      out.push_back(features[i]);
      continue;
    }
    for (Feature& f : faces_apart(part, features[i])) out.push_back(std::move(f));
  }
  return out;
}

}  // namespace

std::string word_of(model::TypeId type) {
  std::string out;
  for (const char c : model::noun_type(type).keyword)
    out += c == '_' ? ' ' : static_cast<char>(c >= 'A' && c <= 'Z' ? c - 'A' + 'a' : c);
  return out;
}

Removal removal_of(const Part& part, const Recognition& found, std::vector<Feature>& features) {
  features = found.features;
  for (Feature& side : sides_to_mill(part, found)) features.push_back(std::move(side));
  Removal out = once(part, features);
  if (!out.on_no_edge.empty()) {
    features = rims_apart(part, features, out.on_no_edge);
    out = once(part, features);
    // With the planes among the rooms another rim may have lost its edge.
    for (const std::size_t i : out.on_no_edge)
      out.left.push_back(
          {features[i].faces, one_of(features[i].type) + ": no feature has walls that end at all of it"});
  }
  for (const recognise::Rest& r : found.unrecognised) out.left.push_back({r.faces, r.reason});
  return out;
}

}  // namespace capstan::from_cad
